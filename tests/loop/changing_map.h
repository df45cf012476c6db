// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include "layout_cases.h"

namespace sslcd {

/// A map that changes at random, as somebody keeps it who has no index.
struct ChangingMap {
  ChangingMap(int count, double side_m) : side(side_m), random(static_cast<unsigned>(count)) {
    for (int i = 0; i < count; ++i) objects[i] = Somewhere(i);
    next_id = count;
  }

  double Uniform(double from, double to) {
    return from + (to - from) * (random() % 1000001) * 1e-6;
  }

  LayoutObject Somewhere(int id) {
    LayoutObject object =
        ObjectAt({Uniform(-side / 2, side / 2), Uniform(-side / 2, side / 2), Uniform(0, 2)},
                 static_cast<int>(random() % 3));
    object.id = id;
    object.yaw = Uniform(-3, 3);
    object.symmetry = random() % 2 == 0 ? Symmetry::kPi : Symmetry::kNone;
    return object;
  }

  LayoutObject Any() {
    return std::next(objects.begin(), static_cast<std::ptrdiff_t>(random() % objects.size()))
        ->second;
  }

  std::vector<LayoutObject> All() const {
    std::vector<LayoutObject> all;
    for (const auto& [id, object] : objects) all.push_back(object);
    return all;
  }

  // Objects that come, move and turn; no id twice.
  std::vector<LayoutObject> Change() {
    std::vector<LayoutObject> changed;
    for (int i = static_cast<int>(random() % 12); i > 0; --i)
      changed.push_back(Somewhere(next_id++));
    for (int i = 0; i < 3; ++i) {
      LayoutObject moved = Any(), turned = Any();
      moved.position += Vec3(Uniform(-3, 3), Uniform(-3, 3), Uniform(-1, 1));
      turned.yaw += 1;
      for (const LayoutObject& object : {moved, turned})
        if (!Holds(changed, object.id)) changed.push_back(object);
    }
    for (const LayoutObject& object : changed) objects[object.id] = object;
    return changed;
  }

  // Ids of objects that go, and one that never was there.
  std::vector<int> Remove(const std::vector<LayoutObject>& changed) {
    std::vector<int> removed = {-7};
    for (int i = static_cast<int>(random() % 12); i > 0; --i) {
      const int id = Any().id;
      if (Holds(changed, id)) continue;
      removed.push_back(id);
      objects.erase(id);
    }
    return removed;
  }

  // Nine objects on one spot, and one whose position is lost.
  void AddHeap(std::vector<LayoutObject>& changed) {
    for (int i = 0; i < 9; ++i) {
      changed.push_back(objects.at(changed[0].id));
      changed.back().id = next_id++;
      objects[changed.back().id] = changed.back();
    }
    changed.push_back(Any());
    changed.back().position.x() = NAN;
    objects.erase(changed.back().id);
  }

  static bool Holds(const std::vector<LayoutObject>& list, int id) {
    return std::any_of(list.begin(), list.end(),
                       [&](const LayoutObject& object) { return object.id == id; });
  }

  double side;
  std::mt19937 random;
  std::map<int, LayoutObject> objects;
  int next_id = 0;
};

}  // namespace sslcd
