// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace sslcd {

/// A value of a JSON file, with its line for messages. The accessors throw Error(kBadInput) with
/// file and line if the value has another kind.
struct JsonValue {
  enum class Kind { kNull, kBool, kNumber, kString, kList, kObject };

  Kind kind = Kind::kNull;
  double number = 0;              ///< 1 for true
  std::string text;               ///< of a string
  std::vector<std::string> keys;  ///< of an object, in the order of the file
  std::vector<JsonValue> items;   ///< of a list, or an object's values in the order of `keys`
  int line = 0;
  std::shared_ptr<const std::string> path;  ///< of the file

  bool IsList() const { return kind == Kind::kList; }
  bool IsObject() const { return kind == Kind::kObject; }

  const JsonValue* Find(const std::string& key) const;  ///< null: none, or not an object
  const JsonValue& Child(const std::string& key) const;
  double Number() const;
  int Integer() const;
  const std::string& Text() const;
  const std::vector<JsonValue>& List() const;
  /// A list of `size` numbers.
  std::vector<double> Numbers(std::size_t size) const;

  [[noreturn]] void Fail(const std::string& message) const;  ///< throws "file:line: message"
};

/// Reads a JSON file (RFC 8259). Throws Error(kBadInput) with file, line and column if it is not
/// JSON, has a duplicate key or is nested deeper than 100.
JsonValue ReadJson(const std::string& path);

}  // namespace sslcd
