// SPDX-License-Identifier: BSD-3-Clause
#include "store/session_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sslcd {
namespace {

SessionInfo Session(int id, const std::string& name, int first, int last) {
  SessionInfo session;
  session.id = id;
  session.name = name;
  session.frame_offset = first;
  session.last_frame = last;
  return session;
}

LoopClosure Loop(int query, int match, LoopDecision decision) {
  LoopClosure loop;
  loop.newest_frame = loop.query_frame = query;
  loop.match_frame = match;
  loop.decision = decision;
  return loop;
}

// Frames 0 to 9, 10 to 19, 20 to 29.
struct ThreeSessions {
  MapInfo info;
  MapResults map;

  ThreeSessions() {
    info.sessions = {Session(1, "a", 0, 9), Session(2, "b", 10, 19), Session(3, "c", 20, 29)};
    map.paths = {{1, {0, 9}, {}, {}}, {2, {10, 19}, {}, {}}, {3, {20, 29}, {}, {}}};
    map.loops = {Loop(9, 0, LoopDecision::kAccepted), Loop(19, 10, LoopDecision::kNone),
                 Loop(19, 9, LoopDecision::kAccepted), Loop(18, 9, LoopDecision::kAmbiguous)};
    map.objects.resize(2);
    map.objects[0].observations = {{9, 1}, {10, 2}};
    map.objects[1].observations = {{5, 3}};
    for (const int frame : {0, 9, 10, 19}) map.graph.vertices.push_back({frame, {}, frame == 0});
    const auto edge = [&](int from, int to) {
      PoseGraph::Edge one;
      one.from = from;
      one.to = to;
      map.graph.edges.push_back(one);
    };
    edge(0, 9);
    edge(9, 10);
    edge(10, 19);
    map.parts = {{0, 0, 0}, {10, 1, 1}, {15, 1, 0}, {20, 2, 3}};
  }
};

TEST(SessionView, ASessionHasTheNumbersOfItsDrive) {
  const ThreeSessions three;
  const MapResults second = ResultsOfSession(three.map, three.info.sessions[1]);
  ASSERT_EQ(second.paths.size(), 1u);
  EXPECT_THAT(second.paths[0].frames, testing::ElementsAre(0, 9));
  ASSERT_EQ(second.loops.size(), 1u);
  EXPECT_EQ(second.loops[0].query_frame, 9);
  EXPECT_EQ(second.loops[0].match_frame, 0);
  ASSERT_EQ(second.objects.size(), 1u);
  ASSERT_EQ(second.objects[0].observations.size(), 1u);
  EXPECT_EQ(second.objects[0].observations[0].frame, 0);
  EXPECT_EQ(second.objects[0].observations[0].detection_row, 2);
  ASSERT_EQ(second.graph.vertices.size(), 2u);
  EXPECT_TRUE(second.graph.vertices[0].fixed);
  ASSERT_EQ(second.graph.edges.size(), 1u);
  EXPECT_EQ(second.graph.edges[0].to, 9);
}

TEST(SessionView, LoopsToEarlierSessionsAreThoseAccepted) {
  const ThreeSessions three;
  EXPECT_EQ(LoopsToEarlierSessions(three.map, three.info.sessions[0]), 0);
  EXPECT_EQ(LoopsToEarlierSessions(three.map, three.info.sessions[1]), 1);
  EXPECT_EQ(LoopsToEarlierSessions(three.map, three.info.sessions[2]), 0);
}

TEST(SessionView, APartThatIsJoinedJoinsItsSession) {
  const ThreeSessions three;
  const auto joined = [&](int i) {
    return JoinedSessions(three.info, three.map, three.info.sessions[i]);
  };
  EXPECT_THAT(joined(0), testing::ElementsAre("b"));
  EXPECT_THAT(joined(1), testing::ElementsAre("a"));
  EXPECT_THAT(joined(2), testing::IsEmpty());
}

}  // namespace
}  // namespace sslcd
