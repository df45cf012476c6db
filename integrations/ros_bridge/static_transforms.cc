// SPDX-License-Identifier: BSD-3-Clause
#include "ros_bridge/static_transforms.h"

namespace sslcd::ros_bridge {

std::string FrameName(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

// `frame` itself and those above it, each with T_ancestor_frame.
std::vector<std::pair<std::string, Pose>> StaticTransforms::Ancestors(
    const std::string& frame) const {
  std::vector<std::pair<std::string, Pose>> found{{frame, Pose()}};
  for (auto at = parents_.find(frame); at != parents_.end(); at = parents_.find(at->second.first))
    found.emplace_back(at->second.first, at->second.second * found.back().second);
  return found;
}

bool StaticTransforms::Add(const std::string& parent, const std::string& child,
                           const Pose& T_parent_child) {
  const std::string above = FrameName(parent), below = FrameName(child);
  if (above.empty() || below.empty()) return false;
  for (const auto& [name, unused] : Ancestors(above))
    if (name == below) return false;
  parents_[below] = {above, T_parent_child};
  return true;
}

std::optional<Pose> StaticTransforms::Find(const std::string& a, const std::string& b) const {
  const auto above_a = Ancestors(FrameName(a)), above_b = Ancestors(FrameName(b));
  for (const auto& [name_a, T_common_a] : above_a)
    for (const auto& [name_b, T_common_b] : above_b)
      if (name_a == name_b) return T_common_a.inverse() * T_common_b;
  return {};
}

}  // namespace sslcd::ros_bridge
