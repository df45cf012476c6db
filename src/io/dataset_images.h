// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/dataset_layout.h"
#include "sslcd/io/sequence_yaml.h"

namespace sslcd {

/// As many frames as it takes to reach the last image of the folder: one that is missing before it does not make the
/// others later. Throws Error(kBadInput) for a name that is no frame's number.
int FramesOfImages(const std::string& folder);

/// Names the images of the dataset's frames, and gives its cameras the size of the first one: of a PNG file, else as
/// `info` has it. Where no odometry says otherwise the sequence ends with the last image; a warning says so.
void AddImages(const DatasetLayout& layout, const SequenceInfo& info, Dataset& dataset);

}  // namespace sslcd
