// SPDX-License-Identifier: BSD-3-Clause
#include "formats/json_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/number_text.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

/// nlohmann's writer prints either one line or a line per number, writes 1 as 1.0, and does not
/// always find the shortest digits.
class JsonWriter {
 public:
  explicit JsonWriter(const Json& rows) : rows_(rows) {}

  void Write(const Json& value) {
    if (value.is_structured())
      WriteContainer(value);
    else if (value.is_number_float() && std::isfinite(value.get<double>()))
      text_ += ShortestNumber(value.get<double>());
    else
      text_ += value.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  const std::string& text() const { return text_; }

 private:
  void WriteContainer(const Json& value) {
    const bool by_line = &value == &rows_, is_object = value.is_object();
    text_ += is_object ? '{' : '[';
    for (auto item = value.begin(); item != value.end(); ++item) {
      if (item != value.begin()) text_ += ',';
      if (by_line) text_ += '\n';
      if (is_object) {
        Write(item.key());
        text_ += ':';
      }
      Write(*item);
    }
    if (by_line) text_ += '\n';
    text_ += is_object ? '}' : ']';
  }

  const Json& rows_;
  std::string text_;
};

}  // namespace

std::string JsonText(const Json& root, const Json& rows) {
  JsonWriter writer(rows);
  writer.Write(root);
  return writer.text() + "\n";
}

}  // namespace sslcd
