// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

namespace sslcd::fuzz {

/// What takes bytes from outside. It throws nothing but Error, whatever the bytes are, and takes
/// less than a second of CPU time (calls of the mapper: five) and 1 GB of memory.
using Target = std::function<void(const std::string& bytes)>;
using Targets = std::map<std::string, Target>;

Targets Readers();   ///< of a file each
Targets Folders();   ///< of the files of a folder (input_file.h)
Targets Maps();      ///< of maps in files; none without sslcd::store
Targets Models();    ///< of networks
Targets Programs();  ///< calls of the library, in any order

/// All of these by name.
Targets AllTargets();

/// Calls a target. An Error is what it may throw.
void Run(const Target& target, const std::string& bytes);

/// Calls what may not fail, since it reads what the library has written. Throws std::logic_error if
/// it throws Error.
void MustSucceed(const char* what, const std::function<void()>& call);

}  // namespace sslcd::fuzz
