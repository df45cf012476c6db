// SPDX-License-Identifier: BSD-3-Clause
// The fixed transforms of a robot.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::ros_bridge {

/// The tree of /tf_static. Names lose a leading slash, as in tf2.
class StaticTransforms {
 public:
  /// Sets or replaces T_parent_child. False: a name is empty, or the tree would have a cycle;
  /// nothing changes then.
  bool Add(const std::string& parent, const std::string& child, const Pose& T_parent_child);
  /// T_a_b, the identity if both are the same. None: nothing joins them. O(depth of the tree).
  std::optional<Pose> Find(const std::string& a, const std::string& b) const;

 private:
  std::vector<std::pair<std::string, Pose>> Ancestors(const std::string& frame) const;

  std::map<std::string, std::pair<std::string, Pose>> parents_;  // child -> parent, T_parent_child
};

/// Without the leading slash that names had before tf2.
std::string FrameName(const std::string& name);

}  // namespace sslcd::ros_bridge
