// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/class_file.h"

#include <gtest/gtest.h>

#include "sslcd/config/config.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

constexpr char kTram[] =
    "Tram: {length_m: 27, width_m: 2.4, height_m: 3.4, length_sigma_m: 5, width_sigma_m: 0.1,\n"
    "       height_sigma_m: 0.3, overhang: 0.1, roof: 0.9}\n";

std::string Text(std::map<std::string, ClassPrior> classes) {
  return DumpConfig(
      [&](FieldVisitor& visitor) {
        for (auto& [label, prior] : classes) visitor.Nested(label.c_str(), prior, "");
      },
      false);
}

TEST(LoadClasses, TheInstalledFileHasTheBuiltInOnes) {
  EXPECT_EQ(Text(LoadClasses(std::string(SSLCD_SOURCE_DIR) + "/config/classes.yaml")),
            Text(UsualClasses()));
}

TEST(LoadClasses, OnlyThoseOfTheFile) {
  const TempFolder folder;
  const auto classes = LoadClasses(folder.Write("classes.yaml", kTram));
  ASSERT_EQ(classes.size(), 1u);
  EXPECT_EQ(classes.at("Tram").length_m, 27);
  EXPECT_EQ(classes.at("Tram").roof, 0.9);
}

TEST(LoadClasses, ClassesThatLackKeysAreNamedAllAtOnce) {
  const TempFolder folder;
  const std::string path =
      folder.Write("classes.yaml",
                   std::string(kTram) + "Tree:\nCar: {length_m: 4, width_m: 1.8, height_m: 1.5}\n");
  ExpectError([&] { LoadClasses(path); },
              {path + ":3:1: class 'Tree' lacks length_m, width_m,",
               path + ":4:1: class 'Car' lacks length_sigma_m, width_sigma_m, height_sigma_m, "
                      "overhang, roof"});
}

TEST(LoadClasses, WrongKeysAndValues) {
  const TempFolder folder;
  const std::string path =
      folder.Write("classes.yaml", "Car: {lenght_m: 4, roof: 2, width_m: wide}\n");
  ExpectError([&] { LoadClasses(path); },
              {path + ":1:7: unknown key 'lenght_m' in 'Car' - did you mean 'length_m'?",
               path + ":1:26: 'roof' is 2, must be in [0, 1]", "'width_m' is 'wide'"});
}

TEST(LoadClasses, FilesWithoutClasses) {
  const TempFolder folder;
  ExpectError([&] { LoadClasses(folder.path() + "/none.yaml"); }, {"none.yaml"});
  ExpectError([&] { LoadClasses(folder.Write("empty.yaml", "# nothing\n")); },
              {"empty.yaml: names no class", "config/classes.yaml"});
  ExpectError([&] { LoadClasses(folder.Write("list.yaml", "- Car\n")); }, {"list.yaml:1:1"});
  ExpectError([&] { LoadClasses(folder.Write("broken.yaml", "Car: {\n")); }, {"broken.yaml:"});
  ExpectError([&] { LoadClasses(folder.Write("twice.yaml", std::string(kTram) + kTram)); },
              {"twice.yaml:3:1: duplicate key 'Tram'"});
}

}  // namespace
}  // namespace sslcd
