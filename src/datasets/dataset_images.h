// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "datasets/dataset_layout.h"
#include "datasets/image_folder.h"
#include "datasets/sequence_yaml.h"

namespace sslcd {

struct SequenceImages {
  ImageFolder left, right;
};

/// Finds the left image of a frame. Images named by stamps belong to frames in order where they are
/// as many, otherwise by stamp, to half a step.
class ImageOfFrame {
 public:
  ImageOfFrame(const ImageFolder& left, std::size_t frames);
  /// Null: there is none. The entry is that of the folder, which has to outlive it.
  const ImageFolder::Entry* operator()(int frame, double stamp) const;

 private:
  const ImageFolder& left_;
  bool in_order_ = false;
  double half_step_ = 0;
};

/// The stamps of a sequence that has left images only [s]: those of their names, or one per frame
/// up to the last image, missing ones included. Throws Error(kBadInput) if more than ten thousand
/// are missing: then the names are no frame numbers.
std::vector<double> StampsOfImages(const ImageFolder& left, double frame_step_s);

/// The stamps of images named by stamps for poses without stamps. Throws Error(kBadInput) unless
/// there are as many.
std::vector<double> StampsOfPoses(const ImageFolder& left, std::size_t poses,
                                  const std::string& odometry);

/// The number of left images that follow the last frame without a gap, or are later than it.
int ImagesAfter(const ImageFolder& left, std::size_t frames, double last_stamp);

/// Sets the image paths of the dataset's frames and the image size of its cameras, from the first
/// few images or, without images, from `info`. Left and right images named by stamps belong
/// together to 5 ms. Throws Error(kBadInput) if the two sizes differ. Without odometry the sequence
/// ends with the last image, with a warning. `frames_in_file`: before max_frames.
void AddImages(const DatasetLayout& layout, const SequenceImages& images, const SequenceInfo& info,
               std::size_t frames_in_file, Dataset& dataset);

}  // namespace sslcd
