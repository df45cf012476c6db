// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"

namespace SSLCD_EXPORT sslcd {

/// Describes the fields of the root options struct, e.g. `[&](FieldVisitor& v) { DescribeFields(v,
/// options); }`.
using Describe = std::function<void(FieldVisitor&)>;

/// Loads YAML into the described fields. Fields without a key keep their value. Reports unknown
/// keys (with a suggestion), duplicate keys, wrong types and values out of range, all in one
/// Error(kBadConfig), one per line as `file:line:column: message`; then no field changes. Throws
/// Error(kBadInput) if the file is missing.
void LoadConfigFile(const std::string& path, const Describe& describe);

/// The same for a text. `name` replaces the file name in messages.
void LoadConfigText(const std::string& text, const std::string& name, const Describe& describe);

/// Applies settings of the form `section.key=value`. Reports the problems of all settings in one
/// Error(kBadConfig), one per line as `--set section.key=value: message`.
void ApplySettings(const std::vector<std::string>& settings, const Describe& describe);

/// Throws one Error(kBadConfig) with all problems; does nothing if there are none. Each problem
/// names the place of its key: the last of `settings` that sets it, otherwise its line in the file
/// `path` (empty: no file), otherwise the key alone.
void ThrowProblems(const std::vector<FieldProblem>& problems, const std::string& path,
                   const std::vector<std::string>& settings);

/// Returns YAML that loads back to identical values. `with_comments` adds the meaning of each key,
/// `everyday_only` keeps only the fields marked by FieldVisitor::Everyday.
std::string DumpConfig(const Describe& describe, bool with_comments, bool everyday_only = false);

/// Returns the body of docs/configuration.md: a table of the everyday fields, if there are any,
/// then one table per section.
std::string ConfigReference(const Describe& describe);

}  // namespace sslcd
