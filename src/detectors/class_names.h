// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace sslcd {

/// Reads names of classes as ultralytics stores them in ONNX files: {0: 'person', 1: "car"}. Leaves
/// out what it cannot read, and numbers from 100 000 on.
std::map<int, std::string> ReadClassNames(const std::string& text);

/// Labels for a model's vehicles, and what was assumed for that.
struct ClassLabels {
  std::map<int, std::string> labels;
  std::string assumption;
};

/// The vehicles among the classes (car, van, truck, bus) by their names; without names, those of
/// COCO where there are 80 classes. Otherwise all classes by their names, or class 0 as a car.
ClassLabels ChooseLabels(const std::map<int, std::string>& names, int class_count);

}  // namespace sslcd
