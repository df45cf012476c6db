// SPDX-License-Identifier: BSD-3-Clause
#include "detectors/class_names.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace sslcd {
namespace {

constexpr int kMostClasses = 100'000;  // as class_count of a description allows

const std::map<std::string, std::string> kVehicles = {
    {"car", "Car"}, {"van", "Van"}, {"truck", "Truck"}, {"bus", "Bus"}};

std::string LowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A name as one word, as labels are.
std::string OneWord(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name.empty() ? "_" : name;
}

}  // namespace

std::map<int, std::string> ReadClassNames(const std::string& text) {
  std::map<int, std::string> names;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t colon = text.find(':', at), open = text.find_first_of("'\"", colon);
    if (open == std::string::npos) break;
    const std::size_t close = text.find(text[open], open + 1);
    if (close == std::string::npos) break;
    const std::size_t first = std::min(text.find_first_of("0123456789", at), colon);
    int number = -1;
    const auto read = std::from_chars(text.data() + first, text.data() + colon, number);
    if (read.ec == std::errc() && number < kMostClasses)
      names[number] = text.substr(open + 1, close - open - 1);
    at = close + 1;
  }
  return names;
}

ClassLabels ChooseLabels(const std::map<int, std::string>& names, int class_count) {
  ClassLabels chosen;
  for (const auto& [number, name] : names) {
    const auto vehicle = kVehicles.find(LowerCase(name));
    if (number < class_count && vehicle != kVehicles.end()) chosen.labels[number] = vehicle->second;
  }
  if (!chosen.labels.empty()) {
    chosen.assumption = "labels: the vehicles among the classes that the file names";
    return chosen;
  }
  for (const auto& [number, name] : names)
    if (number < class_count) chosen.labels[number] = OneWord(name);
  if (!chosen.labels.empty()) {
    chosen.assumption =
        "labels: all classes that the file names; sizes of other objects than vehicles and people "
        "are needed in a file of classes (vision.lift.classes)";
  } else if (class_count == 80) {
    chosen.labels = {{2, "Car"}, {5, "Bus"}, {7, "Truck"}};
    chosen.assumption = "labels: 80 classes are taken for COCO's";
  } else {
    chosen.labels = {{0, "Car"}};
    chosen.assumption = "labels: the file does not name its " + std::to_string(class_count) +
                        " classes; class 0 is taken for cars";
  }
  return chosen;
}

}  // namespace sslcd
