// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "sslcd/config/config.h"
#include "sslcd/pipeline/options.h"

namespace sslcd::python {

/// The options of `section.key=value` settings over the defaults of their `mode`. Throws
/// Error(kBadConfig) with all problems, one per line as `section.key=value: message`.
Options OptionsFrom(const std::vector<std::string>& settings);

/// The YAML of all options: config.yaml of a run folder.
std::string ConfigText(const std::vector<std::string>& settings);

/// ApplySettings with these messages.
void Apply(const std::vector<std::string>& settings, const Describe& describe);

/// Nested dicts of the fields.
pybind11::dict DictOf(const Describe& describe);

}  // namespace sslcd::python
