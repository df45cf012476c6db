// SPDX-License-Identifier: BSD-3-Clause
#include "formats/loops_csv.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sslcd
