// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/export.h"

namespace SSLCD_EXPORT sslcd {

/// Visits the fields of an options struct. Each struct has a function `void
/// DescribeFields(FieldVisitor&, XOptions&)` that lists every field once. Loading from YAML,
/// `--set`, dumping, range checks and docs/configuration.md are visitors of this table.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  /// Marks the next field as an everyday one. `effect` describes the effect of changing it. Use as
  /// `visitor.Everyday("...").Real(...)`.
  FieldVisitor& Everyday(const char* effect) {
    effect_ = effect;
    return *this;
  }

  /// Inclusive range [low, high]; the unit is the key's suffix (_m, _s, _rad, _px).
  virtual void Real(const char* key, double& value, double low, double high,
                    const char* meaning) = 0;
  virtual void Integer(const char* key, int& value, int low, int high, const char* meaning) = 0;
  virtual void Flag(const char* key, bool& value, const char* meaning) = 0;
  virtual void Text(const char* key, std::string& value, const char* meaning) = 0;

  /// `value` is an index into `names`. Use the Enum() helper below for enum types.
  virtual void Choice(const char* key, int& value, const std::vector<const char*>& names,
                      const char* meaning) = 0;

  /// A list of numbers, each in [low, high]. The default does nothing.
  virtual void Numbers(const char* /*key*/, std::vector<double>& /*values*/, double /*low*/,
                       double /*high*/, const char* /*meaning*/) {}

  /// Names by number >= 0, e.g. `{2: Car, 7: Truck}`. The default does nothing.
  virtual void Names(const char* /*key*/, std::map<int, std::string>& /*names*/,
                     const char* /*meaning*/) {}

  /// A nested section; `describe` visits its fields with the same visitor.
  virtual void Section(const char* key, const char* meaning,
                       const std::function<void(FieldVisitor&)>& describe) = 0;

  /// An enum whose enumerators are 0, 1, 2, ... in the order of `names`.
  template <class E>
  void Enum(const char* key, E& value, const std::vector<const char*>& names, const char* meaning) {
    int index = static_cast<int>(value);
    Choice(key, index, names, meaning);
    value = static_cast<E>(index);
  }

  /// A nested options struct with its own DescribeFields.
  template <class Options>
  void Nested(const char* key, Options& options, const char* meaning) {
    Section(key, meaning, [&options](FieldVisitor& visitor) { DescribeFields(visitor, options); });
  }

 protected:
  /// Returns the effect given to Everyday for the current field; null if it is not an everyday
  /// field. Call it once per field.
  const char* TakeEffect() { return std::exchange(effect_, nullptr); }

 private:
  const char* effect_ = nullptr;
};

/// A problem of one option, or of several that do not fit together.
struct FieldProblem {
  std::vector<std::string> keys;  ///< keys with sections, e.g. `loop.layout.local_m`; at least one
  std::string message;            ///< the problem and a remedy
};

/// Finds numbers outside of their field's range; NaN is outside of every range.
std::vector<FieldProblem> CheckRanges(const std::function<void(FieldVisitor&)>& describe);

/// One problem per line, for people.
std::string ToString(const std::vector<FieldProblem>& problems);

}  // namespace sslcd
