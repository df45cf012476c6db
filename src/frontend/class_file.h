// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "sslcd/lifting/lift.h"

namespace sslcd {

/// Reads the classes for LiftOptions::classes, e.g. config/classes.yaml:
///
///   Car: {length_m: 3.93, width_m: 1.63, height_m: 1.53, length_sigma_m: 0.44, ...}
///   Tram: ...
/// A class must have all keys of ClassPrior. Throws one Error with file:line:column for all
/// problems: a file without classes, a class that lacks a key, unknown or duplicate keys, and
/// values that are wrong or out of range.
std::map<std::string, ClassPrior> LoadClasses(const std::string& path);

}  // namespace sslcd
