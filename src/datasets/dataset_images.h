// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "datasets/dataset_layout.h"
#include "datasets/sequence_yaml.h"

namespace sslcd {

/// The number of frames up to the last image of the folder; missing images before it count. Throws
/// Error(kBadInput) if more than ten thousand are missing: then the names are no frame numbers.
int FramesOfImages(const std::string& folder);

/// The number of left images that follow frame `frames` - 1 without a gap.
int ImagesAfter(const DatasetLayout& layout, std::size_t frames);

/// Sets the image paths of the dataset's frames and the image size of its cameras, from the first
/// few images or, without images, from `info`. Throws Error(kBadInput) if these two differ. Without
/// odometry the sequence ends with the last image, with a warning.
void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset);

}  // namespace sslcd
