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

/// Throws one Error(kBadConfig) with all problems, each with the place of a key that it concerns:
/// the last of `settings` that gives it, else its line in the file at `path` (empty: there is
/// none), else the key alone, whose default is to blame. No problems: does nothing.
void ThrowProblems(const std::vector<FieldProblem>& problems, const std::string& path,
                   const std::vector<std::string>& settings);

/// YAML that loads back to identical values; with the meaning of each key as a comment if wanted.
/// `everyday_only`: only the fields marked as such (FieldVisitor::Everyday).
std::string DumpConfig(const Describe& describe, bool with_comments, bool everyday_only = false);

/// Body of docs/configuration.md: a table of the everyday fields, if there are any, then one table
/// per section.
std::string ConfigReference(const Describe& describe);

}  // namespace sslcd
