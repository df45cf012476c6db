// SPDX-License-Identifier: BSD-3-Clause
#include "formats/json.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

class Json : public ::testing::Test {
 protected:
  JsonValue Read(const std::string& text) const { return ReadJson(folder_.Write("f.json", text)); }
  void Refuse(const std::string& text, const std::vector<std::string>& parts) const {
    ExpectError([&] { Read(text); }, parts);
  }
  TempFolder folder_;
};

TEST_F(Json, ValuesOfEveryKind) {
  const JsonValue root = Read(
      "{\"list\": [1, -2.5e-3, true, null],\n \"text\": \"a\\u0001\\u00e9\\ud83d\\ude97\\\"\"}");
  EXPECT_EQ(root.keys, (std::vector<std::string>{"list", "text"}));
  const std::vector<JsonValue>& list = root.Child("list").List();
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0].Integer(), 1);
  EXPECT_EQ(list[1].Number(), -2.5e-3);
  EXPECT_EQ(list[2].kind, JsonValue::Kind::kBool);
  EXPECT_EQ(list[2].number, 1);
  EXPECT_EQ(list[3].kind, JsonValue::Kind::kNull);
  EXPECT_EQ(root.Child("text").Text(), "a\x01\xC3\xA9\xF0\x9F\x9A\x97\"");
  EXPECT_EQ(root.Find("none"), nullptr);
  EXPECT_EQ(list[0].Find("none"), nullptr);
  EXPECT_EQ(Read("[0, 0.5, 3]").Numbers(3), (std::vector<double>{0, 0.5, 3}));
}

TEST_F(Json, EveryValueKnowsItsLine) {
  const JsonValue root = Read("{\n\"a\": 1\n,\"b\": [\n2,\n\"x\"\n],\n\n\"c\": {\"d\": true}}\n");
  EXPECT_EQ(root.line, 1);
  EXPECT_EQ(root.Child("a").line, 2);
  EXPECT_EQ(root.Child("b").line, 3);
  EXPECT_EQ(root.Child("b").items[0].line, 4);
  EXPECT_EQ(root.Child("b").items[1].line, 5);
  EXPECT_EQ(root.Child("c").line, 8);
  EXPECT_EQ(root.Child("c").Child("d").line, 8);
  EXPECT_EQ(Read("\n\n7").line, 3);
}

TEST_F(Json, WrongKindsAreNamedWithFileAndLine) {
  const JsonValue root = Read("{\"n\": 1.5,\n\"t\": \"x\",\n\"l\": [1, \"2\"]}");
  ExpectError([&] { root.Child("m"); }, {"f.json:1: key 'm' is missing"});
  ExpectError([&] { root.Child("t").Child("m"); }, {"f.json:2: expected an object with key 'm'"});
  ExpectError([&] { root.Child("t").Number(); }, {"f.json:2: expected a number"});
  ExpectError([&] { root.Child("n").Integer(); }, {"f.json:1: expected a whole number"});
  ExpectError([&] { Read("3e9").Integer(); }, {"f.json:1: expected a whole number"});
  ExpectError([&] { root.Child("n").Text(); }, {"f.json:1: expected a text"});
  ExpectError([&] { root.Child("n").List(); }, {"f.json:1: expected a list"});
  ExpectError([&] { root.Child("l").Numbers(3); }, {"f.json:3: expected a list of 3 numbers"});
  ExpectError([&] { root.Child("l").Numbers(2); }, {"f.json:3: expected a number"});
}

TEST_F(Json, WhatIsNotJsonIsRefused) {
  Refuse("", {"f.json:1:1: not JSON", "unexpected end of input"});
  Refuse("[1,\n2,\n", {"f.json:3:1: not JSON", "unexpected end of input"});
  Refuse("[1,\n nan]", {"f.json:2:3: not JSON", "invalid literal"});
  Refuse("[1] [2]", {"f.json:1:5: not JSON", "expected end of input"});
  Refuse("{'a': 1}", {"f.json:1:2: not JSON"});
  Refuse("[\"a\nb\"]", {"f.json:1:4: not JSON", "control character"});
  Refuse("[\"\xFF\"]", {"f.json:1:3: not JSON", "UTF-8"});
  Refuse("[1e999]", {"f.json:1:", "number overflow"});
  Refuse("{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", {"f.json:3: key 'a' is a duplicate"});
  ExpectError([&] { ReadJson(folder_.path() + "/none.json"); }, {"none.json", "cannot be read"});
}

TEST_F(Json, DeepNestingIsRefused) {
  EXPECT_EQ(Read(std::string(100, '[') + std::string(100, ']')).items.size(), 1u);
  Refuse(std::string(1'000'000, '['), {"f.json:1:101: ", "nested deeper than 100"});
}

}  // namespace
}  // namespace sslcd
