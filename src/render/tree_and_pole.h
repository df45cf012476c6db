// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "render/mesh.h"

namespace sslcd::render {

enum TreePart { kTrunk, kLeaf };

/// A tree of many leaves, or a lamp post, that fills the box `dims` (width, depth, height) on the
/// ground.
Mesh MakeTreeMesh(const Vec3f& dims, std::uint32_t seed);
Mesh MakePoleMesh(const Vec3f& dims);

}  // namespace sslcd::render
