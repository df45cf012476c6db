// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/sequence_yaml.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(SequenceYaml, ReadsUpAxisSizeAndLabels) {
  const TempFolder folder;
  const SequenceInfo info = ReadSequenceYaml(
      folder.Write("s.yaml",
                   "up_axis: [0, 0, 2]\nimage_size_px: [640, 480]\n"
                   "labels: {Tree: {symmetry: full}, Box: {symmetry: pi}, Car: {}}\n"));
  EXPECT_EQ(info.image_width, 640);
  EXPECT_EQ(info.image_height, 480);
  EXPECT_EQ(info.up_axis.value(), Vec3(0, 0, 1));
  EXPECT_EQ(info.labels["Tree"].symmetry, Symmetry::kFull);
  EXPECT_EQ(info.labels["Box"].symmetry, Symmetry::kPi);
  EXPECT_EQ(info.labels["Car"].symmetry, Symmetry::kNone);
  EXPECT_EQ(info.labels.entries().size(), 3u);
}

TEST(SequenceYaml, EverythingIsOptional) {
  const TempFolder folder;
  const SequenceInfo info = ReadSequenceYaml(folder.Write("s.yaml", "# nothing\n"));
  EXPECT_FALSE(info.up_axis.has_value());
  EXPECT_EQ(info.image_width, 0);
  EXPECT_TRUE(info.labels.entries().empty());
}

TEST(SequenceYaml, ErrorsNameTheirPlace) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadSequenceYaml(folder.Write("s.yaml", text)); }, parts);
  };
  refuse("up_axis: [0, 0, 1]\nupaxis: 3\n", {"s.yaml:2:1: unknown key 'upaxis'", "up_axis"});
  refuse("up_axis: [0, 0, 1]\nup_axis: [0, 0, 1]\n", {"s.yaml:2:1: duplicate key 'up_axis'"});
  refuse("up_axis: [0, 1]\n", {"s.yaml:1:10: ", "three numbers"});
  refuse("up_axis: [0, 1, x]\n", {"s.yaml:1:17: ", "expected a number"});
  refuse("up_axis: [0, 0, 0]\n", {"s.yaml:1:10: ", "direction"});
  refuse("up_axis: [0, nan, 0]\n", {"s.yaml:1:10: ", "direction"});
  refuse("up_axis: [1e200, -1, 0]\n", {"s.yaml:1:10: ", "direction"});  // its square is infinite
  refuse("image_size_px: [640]\n", {"s.yaml:1:16: ", "width and height"});
  refuse("image_size_px: [640, x]\n", {"s.yaml:1:22: ", "expected a number"});
  for (const char* wrong : {"0, 480", "-1, 480", "640.5, 480", "nan, 480", "1e9, 480"})
    refuse(std::string("image_size_px: [") + wrong + "]\n", {"s.yaml:1:16: ", "whole numbers"});
  refuse("labels:\n  Car: {symetry: none}\n", {"s.yaml:2:9: unknown key 'symetry'", "symmetry"});
  refuse("labels:\n  Car: {symmetry: some}\n", {"s.yaml:2:19: ", "none, pi or full"});
  refuse("labels: {Car: {}, Car: {}}\n", {"duplicate key 'Car'"});
  refuse("labels: [Car]\n", {"s.yaml:1:9: expected a mapping"});
  refuse("labels: {Car: none}\n", {"s.yaml:1:15: expected a mapping"});
  refuse("- 1\n", {"s.yaml:1:1: expected a mapping"});
  refuse("labels: {Car\n", {"s.yaml:"});
}

TEST(SequenceYaml, LabelsComeBackAsWritten) {
  const std::vector<std::string> labels = {"Car", "light_2", "yes", "No", "null", "1", "-", "a: b",
                                           "a #b", "{x}", "\"q\"", "'", "~", "B\\n", "two words",
                                           " x ", "line\nbreak", "Stra\u00dfe", "",
                                           // longer than an implicit key may be
                                           std::string(1100, 'x'), std::string(600, '\n') + ": y",
                                           // Latin-1, and no text
                                           "Stra\337e", "Stra\344e", "\233\234 \"\\\n\177"};
  SequenceInfo info;
  for (const std::string& label : labels) info.labels.Set(label, {Symmetry::kPi});
  const TempFolder folder;
  const std::string text = SequenceYamlText(info);
  const SequenceInfo read = ReadSequenceYaml(folder.Write("s.yaml", text));
  EXPECT_EQ(read.labels.entries().size(), labels.size());
  for (const std::string& label : labels)
    EXPECT_EQ(read.labels.entries().count(label), 1u) << label;
}

TEST(SequenceYaml, QuotesLabelsThatOtherReadersTakeForValues) {
  SequenceInfo info;
  info.labels.Set("Car", {});
  info.labels.Set("Yes", {});
  info.labels.Set("1", {});
  EXPECT_EQ(SequenceYamlText(info),
            "labels:\n  \"1\": {symmetry: none}\n  Car: {symmetry: none}\n"
            "  \"Yes\": {symmetry: none}\n");
}

}  // namespace
}  // namespace sslcd
