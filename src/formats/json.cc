// SPDX-License-Identifier: BSD-3-Clause
#include "formats/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>

#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr std::size_t kMaxDepth = 100;  // values are destroyed recursively

/// Handles the events of nlohmann's parser. The parser reports lines only for syntax errors, so the
/// line of each value comes from the position in the stream.
class JsonBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonBuilder(const std::string& path, const std::string& bytes)
      : path_(std::make_shared<const std::string>(path)), bytes_(bytes), stream_(bytes) {}

  JsonValue Build() {
    nlohmann::json::sax_parse(stream_, this);
    return std::move(root_);
  }

  bool null() override { return Add(JsonValue::Kind::kNull); }
  bool boolean(bool value) override { return Add(JsonValue::Kind::kBool, value ? 1 : 0); }
  bool number_integer(number_integer_t value) override { return AddNumber(double(value)); }
  bool number_unsigned(number_unsigned_t value) override { return AddNumber(double(value)); }
  bool number_float(number_float_t value, const string_t&) override { return AddNumber(value); }
  bool string(string_t& value) override {
    return Add(JsonValue::Kind::kString, 0, std::move(value));
  }
  bool binary(binary_t&) override { return false; }  // never in a JSON text
  bool start_object(std::size_t) override { return Open(JsonValue::Kind::kObject); }
  bool start_array(std::size_t) override { return Open(JsonValue::Kind::kList); }
  bool end_object() override {
    CheckKeys(*open_.back());
    return Close();
  }
  bool end_array() override { return Close(); }
  bool key(string_t& name) override {
    open_.back()->keys.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& problem) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
    const std::string text = problem.what();
    const std::size_t colon = text.find(": ");
    Fail(position, "not JSON: " + (colon == std::string::npos ? text : text.substr(colon + 2)));
  }

 private:
  std::size_t Position() {  // bytes that the parser has read
    return static_cast<std::size_t>(
        stream_.rdbuf()->pubseekoff(0, std::ios_base::cur, std::ios_base::in));
  }

  [[noreturn]] void Fail(std::size_t position, const std::string& message) const {
    const std::string before = bytes_.substr(0, position == 0 ? 0 : position - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n') == std::string::npos ? 0 : before.rfind('\n') + 1;
    throw Error(ErrorKind::kBadInput,
                {*path_, static_cast<int>(line), static_cast<int>(before.size() - start) + 1},
                message);
  }

  static void CheckKeys(const JsonValue& object) {
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < object.keys.size(); ++i) {
      if (!seen.insert(object.keys[i]).second)
        object.items[i].Fail("key '" + object.keys[i] + "' is a duplicate");
    }
  }

  bool AddNumber(double value) { return Add(JsonValue::Kind::kNumber, value); }

  bool Add(JsonValue::Kind kind, double number = 0, std::string text = "") {
    // The parser has read one more character when it reports a number.
    const std::size_t end = std::max<std::size_t>(Position(), 1) - 1;
    lines_ += static_cast<int>(std::count(bytes_.begin() + std::ptrdiff_t(counted_),
                                          bytes_.begin() + std::ptrdiff_t(end), '\n'));
    counted_ = end;
    JsonValue& value = open_.empty() ? root_ : open_.back()->items.emplace_back();
    value.kind = kind;
    value.number = number;
    value.text = std::move(text);
    value.line = 1 + lines_;
    value.path = path_;
    return true;
  }

  bool Open(JsonValue::Kind kind) {
    if (open_.size() == kMaxDepth)
      Fail(Position(), "lists and objects are nested deeper than " + std::to_string(kMaxDepth));
    Add(kind);
    open_.push_back(open_.empty() ? &root_ : &open_.back()->items.back());
    return true;
  }

  bool Close() {
    open_.pop_back();
    return true;
  }

  std::shared_ptr<const std::string> path_;
  const std::string& bytes_;
  std::istringstream stream_;
  std::size_t counted_ = 0;  // bytes whose line ends are counted in lines_
  int lines_ = 0;
  JsonValue root_;
  std::vector<JsonValue*> open_;  // stay valid: only the innermost value gets items
};

}  // namespace

const JsonValue* JsonValue::Find(const std::string& key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

const JsonValue& JsonValue::Child(const std::string& key) const {
  if (!IsObject()) Fail("expected an object with key '" + key + "'");
  const JsonValue* child = Find(key);
  if (child == nullptr) Fail("key '" + key + "' is missing");
  return *child;
}

double JsonValue::Number() const {
  if (kind != Kind::kNumber) Fail("expected a number");
  return number;
}

int JsonValue::Integer() const {
  const double value = Number();
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
    Fail("expected a whole number");
  return static_cast<int>(value);
}

const std::string& JsonValue::Text() const {
  if (kind != Kind::kString) Fail("expected a text in quotes");
  return text;
}

const std::vector<JsonValue>& JsonValue::List() const {
  if (!IsList()) Fail("expected a list");
  return items;
}

std::vector<double> JsonValue::Numbers(std::size_t size) const {
  if (!IsList() || items.size() != size)
    Fail("expected a list of " + std::to_string(size) + " numbers");
  std::vector<double> numbers;
  for (const JsonValue& item : items) numbers.push_back(item.Number());
  return numbers;
}

void JsonValue::Fail(const std::string& message) const {
  throw Error(ErrorKind::kBadInput, {*path, line}, message);
}

JsonValue ReadJson(const std::string& path) {
  const std::string bytes = ReadFileBytes(path);
  return JsonBuilder(path, bytes).Build();
}

}  // namespace sslcd
