// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/fields.h"

namespace sslcd {

/// Visits the root options struct, e.g. `[&](FieldVisitor& v) { DescribeFields(v, options); }`.
using Describe = std::function<void(FieldVisitor&)>;

/// Loads YAML into the described fields; keys that are not there keep their value. Strict: unknown
/// keys (with a suggestion), duplicate keys, wrong types and values out of range are all reported
/// at once, one per line as `file:line:column: message`, in one Error(kBadConfig); nothing is
/// changed then. A missing file is kBadInput.
void LoadConfigFile(const std::string& path, const Describe& describe);

/// The same for text that was read elsewhere; `name` stands for the file in messages.
void LoadConfigText(const std::string& text, const std::string& name, const Describe& describe);

/// Settings of the form `section.key=value`; all problems of all settings at once, each as `--set
/// section.key=value: message`.
void ApplySettings(const std::vector<std::string>& settings, const Describe& describe);

/// YAML that loads back to identical values; with the meaning of each key as a comment if wanted.
std::string DumpConfig(const Describe& describe, bool with_comments);

/// Body of docs/configuration.md: one table per section.
std::string ConfigReference(const Describe& describe);

}  // namespace sslcd
