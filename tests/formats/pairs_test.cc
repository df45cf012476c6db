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
  refuse(File(kPair, rows) + "X 1 2 3\n", {"p.txt:6: ", "PAIR, L or G", "'X'"});
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

}  // namespace
}  // namespace sslcd
