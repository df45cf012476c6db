// SPDX-License-Identifier: BSD-3-Clause
#include "formats/pairs.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

const char kPair[] = "PAIR 4 street/n0.1 2 1 0.5 1 2 3\n";
const char kLocal[] = "L 7 2 1.5 2.5 3.5\n";
const char kGlobal[] = "G -1 0 -1 -2 -3\n";

std::string File(const std::string& pair, const std::string& rows) {
  return "# comment\n" + pair + rows;
}

TEST(PairsReader, ReadsPairs) {
  const TempFolder folder;
  const std::string text =
      File(kPair, std::string(kLocal) + kGlobal + kLocal) + "\nPAIR 0 empty 0 0 0 0 0 0\n";
  const std::vector<LayoutPair> pairs = ReadLayoutPairs(folder.Write("p.txt", text));
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].id, 4);
  EXPECT_EQ(pairs[0].scene, "street/n0.1");
  EXPECT_EQ(pairs[0].truth.yaw, 0.5);
  EXPECT_EQ(pairs[0].truth.t, Vec3(1, 2, 3));
  ASSERT_EQ(pairs[0].local.size(), 2u);
  ASSERT_EQ(pairs[0].global.size(), 1u);
  EXPECT_EQ(pairs[0].local[1].id, 1) << "the true identity must not leak into the matching";
  EXPECT_EQ(pairs[0].local[0].label, 2);
  EXPECT_EQ(pairs[0].local[0].position, Vec3(1.5, 2.5, 3.5));
  EXPECT_TRUE(std::isnan(pairs[0].local[0].yaw));
  EXPECT_TRUE(pairs[1].local.empty());
}

TEST(PairsReader, NamesFileAndLineOfWhatIsWrong) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadLayoutPairs(folder.Write("p.txt", text)); }, parts);
  };
  const std::string rows = std::string(kLocal) + kLocal + kGlobal;
  refuse("", {"p.txt: holds no pair"});
  refuse("# nothing\n", {"p.txt: holds no pair"});
  refuse(kLocal, {"p.txt:1: an object before the first 'PAIR' row"});
  refuse(File(kPair, rows) + "X 1 2 3\n", {"p.txt:6: ", "MAP, PAIR, L or G", "'X'"});
  refuse(File(kPair, std::string(kLocal) + kGlobal),
         {"p.txt:2: pair 4 announces 2 L rows, but has 1"});
  refuse(File(kPair, rows + kGlobal), {"p.txt:2: ", "1 G rows, but has 2"});
  refuse(File(kPair, rows) + File(kPair, rows), {"p.txt:7: pair 4 comes twice"});
  refuse(File("PAIR 4 street 2 1 0.5 1 2\n", rows), {"p.txt:2: found 8 columns"});
  refuse(File("PAIR 4 street 2 1 nan 1 2 3\n", rows), {"p.txt:2: column 6 is 'nan'"});
  refuse(File("PAIR 4 street -2 1 0 1 2 3\n", rows), {"p.txt:2: a negative number"});
  refuse(File(kPair, "L 7 2 1.5 nan 3.5\n" + rows), {"p.txt:3: column 5 is 'nan'"});
  refuse(File(kPair, "L 7 2 1.5 inf 3.5\n" + rows), {"p.txt:3: column 5 is 'inf'"});
  refuse(File(kPair, "L 7 car 1.5 2 3.5\n" + rows), {"p.txt:3: column 3", "'car'"});
  refuse(File(kPair, "L 7 -2 1.5 2 3.5\n" + rows), {"p.txt:3: label -2"});
  refuse(File(kPair, "L 7 2 1.5 2\n" + rows), {"p.txt:3: found 5 columns"});
  ExpectError([&] { ReadLayoutPairs(folder.path() + "/none.txt"); }, {"none.txt", "No such file"});
}

TEST(PairsReader, ReadsOneMapForAllPairs) {
  const TempFolder folder;
  const std::string query = "PAIR 4 street 1 0 0.5 1 2 3\n" + std::string(kLocal);
  const std::string text =
      "# comment\nMAP 2\n" + std::string(kGlobal) + kGlobal + query + "PAIR 5 s 0 0 0 0 0 0\n";
  const LayoutPairFile file = ReadLayoutPairFile(folder.Write("p.txt", text));
  ASSERT_TRUE(file.map.has_value());
  ASSERT_EQ(file.map->size(), 2u);
  EXPECT_EQ((*file.map)[1].id, 1);
  EXPECT_EQ((*file.map)[1].position, Vec3(-1, -2, -3));
  ASSERT_EQ(file.pairs.size(), 2u);
  EXPECT_EQ(file.pairs[0].local.size(), 1u);
  EXPECT_TRUE(file.pairs[0].global.empty());
  EXPECT_FALSE(ReadLayoutPairFile(folder.Write("q.txt", query)).map.has_value());
  EXPECT_TRUE(ReadLayoutPairFile(folder.Write("q.txt", "MAP 0\n" + query)).map->empty());
  ExpectError([&] { ReadLayoutPairs(folder.path() + "/p.txt"); }, {"p.txt: has one map for all"});
}

TEST(PairsReader, NamesFileAndLineOfAWrongMap) {
  const TempFolder folder;
  const std::string query = "PAIR 4 street 1 0 0.5 1 2 3\n" + std::string(kLocal), g = kGlobal;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadLayoutPairFile(folder.Write("p.txt", text)); }, parts);
  };
  refuse("MAP 2\n" + g + query, {"p.txt:1: the map announces 2 G rows, but has 1"});
  refuse("MAP 1\n" + g + g + query, {"p.txt:1: ", "1 G rows, but has 2"});
  refuse("MAP 1\n" + g, {"p.txt: holds no pair"});
  refuse("MAP 1\n" + g + "MAP 1\n" + g + query, {"p.txt:3: 'MAP' is not the first row"});
  refuse(query + "MAP 1\n" + g, {"p.txt:3: 'MAP' is not the first row"});
  refuse("MAP 1\n" + g + query + g, {"p.txt:3: pair 4 announces 0 G rows, but has 1"});
  refuse("MAP 1\n" + g + kPair, {"p.txt:3: a map of its own"});
  refuse("MAP -1\n" + query, {"p.txt:1: a negative number"});
  refuse("MAP\n" + g + query, {"p.txt:1: found 1 columns", "MAP n_global"});
  refuse("MAP x\n" + g + query, {"p.txt:1: column 2", "'x'"});
  refuse("MAP 1\n" + std::string(kLocal) + query, {"p.txt:2: an object before the first"});
}

}  // namespace
}  // namespace sslcd
