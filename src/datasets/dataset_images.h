// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "datasets/dataset_layout.h"
#include "datasets/sequence_yaml.h"

namespace sslcd {

/// As many frames as it takes to reach the last image of the folder: one that is missing before it
/// does not make the others later. Throws Error(kBadInput) for a name that is no frame's number.
int FramesOfImages(const std::string& folder);

/// How many left images follow after so many frames, without a gap.
int ImagesAfter(const DatasetLayout& layout, std::size_t frames);

/// Names the images of the dataset's frames, and gives its cameras the size that the first few
/// have; where there are none, that of `info`. Throws Error(kBadInput) if these two differ. Where
/// no odometry says otherwise the sequence ends with the last image; a warning says so.
void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset);

}  // namespace sslcd
