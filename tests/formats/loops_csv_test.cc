// SPDX-License-Identifier: BSD-3-Clause
#include "formats/loops_csv.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(LoopsCsv, ARowForEachAttempt) {
  LoopClosure loop;
  loop.query_frame = 90;
  loop.match_frame = 7;
  loop.decision = LoopDecision::kAccepted;
  loop.reason = "near, but not \"here\"";
  loop.score = 13.25;
  loop.probability = 0.99999824;
  loop.second_score = -13.25;
  loop.viewpoint_change_rad = 3.141592653589793;
  loop.T_match_query = Pose::Trans(1, -2, 0.5);
  loop.pairs = {{{4}, {2}}, {{5}, {5}}};
  EXPECT_EQ(LoopsCsv({loop, {}}),
            "query_frame,match_frame,decision,reason,score,probability,second_score,matches,"
            "viewpoint_change_deg,tx,ty,tz,qx,qy,qz,qw,pairs\n"
            "90,7,accepted,\"near, but not \"\"here\"\"\",13.250,0.999998,-13.250,2,180.00,"
            "1.000000000,-2.000000000,0.500000000,0.000000000,0.000000000,0.000000000,1.000000000,"
            "4:2;5:5\n"
            "0,0,none,,0.000,,0.000,0,0.00,0.000000000,0.000000000,0.000000000,0.000000000,"
            "0.000000000,0.000000000,1.000000000,\n");
}

TEST(LoopsCsv, ReadsWhatItWrites) {
  LoopClosure loop;
  loop.query_frame = 90;
  loop.decision = LoopDecision::kAmbiguous;
  loop.reason = "near, but not \"here\"\nnor there";
  loop.score = -3.5;
  loop.probability = 0.25;
  loop.viewpoint_change_rad = 1.5707963267948966;
  loop.T_match_query = Pose(lie::SO3<double>::Exp(Vec3(0, 0.5, 0)), Vec3(1, -2, 0.5));
  loop.pairs = {{{4}, {2}}, {{5}, {5}}};
  const std::string text = LoopsCsv({loop, {}});
  const TempFolder folder;
  const auto read = ReadLoopsCsv(folder.Write("loops.csv", text));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(LoopsCsv(read), text);
  EXPECT_EQ(read[0].pairs, loop.pairs);
  EXPECT_FALSE(read[1].probability);
}

TEST(LoopsCsv, RefusesWhatIsNone) {
  const TempFolder folder;
  const std::string good = LoopsCsv({{}});
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return folder.Write("loops.csv", text);
  };
  EXPECT_EQ(ReadLoopsCsv(folder.Write("loops.csv", good)).size(), 1u);
  for (const auto& [from, to] :
       {std::pair{"score", "scores"}, std::pair{"0,0,none", "0,0.5,none"},
        std::pair{"0,0,none", "0,0,maybe"}, std::pair{"0,0,none", "x,0,none"},
        std::pair{"0,0,none", "0,none"}, std::pair{",,0.000", ",\",0.000"},
        std::pair{"1.000000000,\n", "1.000000000,3-4\n"},
        std::pair{"1.000000000,\n", "0.000000000,\n"}})
    EXPECT_THROW(ReadLoopsCsv(changed(from, to)), Error) << from << " " << to;
  EXPECT_THROW(ReadLoopsCsv(folder.Write("loops.csv", "")), Error);
}

}  // namespace
}  // namespace sslcd
