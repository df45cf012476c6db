// SPDX-License-Identifier: BSD-3-Clause
#include "map_export/map_diff.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "../change/parked_row.h"
#include "change/explain.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

MapInfo Sessions(const std::vector<std::string>& names) {
  MapInfo info;
  for (const std::string& name : names) {
    info.sessions.emplace_back();
    info.sessions.back().name = name;
  }
  return info;
}

ParkedRow ChangedRow() {
  ParkedRow row = StandingRow(3);
  row.objects[4].there = {5, 0, 0};
  row.objects[5].there = {0, 6, 6};
  row.objects[7].there = {8, 10, 10};
  row.objects[8].there = {9, 9, 0};
  return row;
}

TEST(MapDiff, ListsChanges) {
  const MapHistory history = ChangedRow().History();
  const MapInfo info = Sessions({"mo", "tu", "we"});
  const MapDiff diff = CompareSessions(info, history, "mo", "tu");
  ASSERT_EQ(diff.changes.size(), 3u);
  EXPECT_EQ(diff.changes[0].kind, ChangeKind::kDeparted);
  EXPECT_EQ(diff.changes[1].kind, ChangeKind::kArrived);
  EXPECT_EQ(diff.changes[2].kind, ChangeKind::kReplaced);
  EXPECT_EQ(diff.stayed, 9);
  EXPECT_EQ(diff.unknown + diff.unseen, 0);
  EXPECT_EQ(CompareSessions(info, history, "mo", "we").changes.size(), 4u);
}

TEST(MapDiff, ComparesTheLastSessionsOfItself) {
  const MapHistory history = ChangedRow().History();
  const MapDiff diff = CompareSessions(Sessions({"mo", "tu", "we"}), history, "", "");
  EXPECT_EQ(diff.from, 1);
  EXPECT_EQ(diff.to, 2);
  ASSERT_EQ(diff.changes.size(), 1u);
  EXPECT_EQ(diff.changes[0].kind, ChangeKind::kDeparted);
  EXPECT_EQ(CompareSessions(Sessions({"mo", "tu", "we"}), history, "", "tu").from, 0);
  EXPECT_EQ(CompareSessions(Sessions({"mo", "tu", "we"}), history, "mo", "").to, 2);
}

TEST(MapDiff, LeavesOutASessionElsewhere) {
  ParkedRow row = ChangedRow();
  row.map[1] = 1;
  row.own_landmarks = true;
  const MapDiff diff = CompareSessions(Sessions({"mo", "tu", "we"}), row.History(), "", "");
  EXPECT_EQ(diff.from, 0);
  EXPECT_EQ(diff.to, 2);
  row.map[2] = 2;
  EXPECT_THROW(CompareSessions(Sessions({"mo", "tu", "we"}), row.History(), "", ""), Error);
}

TEST(MapDiff, SaysWhatIsNotInView) {
  ParkedRow row = StandingRow(2);
  row.length_m[1] = 30;
  const MapDiff diff = CompareSessions(Sessions({"a", "b"}), row.History(), "", "");
  EXPECT_GT(diff.unseen, 2);
  EXPECT_EQ(diff.stayed + diff.unknown + diff.unseen, 12);
}

void ExpectUsage(const std::vector<std::string>& names, const std::string& from,
                 const std::string& to, const std::string& says) {
  const MapHistory history = StandingRow(static_cast<int>(names.size())).History();
  try {
    CompareSessions(Sessions(names), history, from, to);
    FAIL() << says;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(MapDiff, WrongNames) {
  ExpectUsage({"mo", "tu"}, "su", "tu", "no session 'su'; it has 'mo', 'tu'");
  ExpectUsage({"mo", "tu"}, "tu", "mo", "is not before");
  ExpectUsage({"mo", "tu"}, "tu", "tu", "is not before");
  ExpectUsage({"mo"}, "", "", "one session only");
}

TEST(MapDiff, NothingIsBeforeTheFirst) {
  const MapHistory history = StandingRow(2).History();
  EXPECT_THROW(CompareSessions(Sessions({"mo", "tu"}), history, "", "mo"), Error);
  EXPECT_THROW(CompareSessions(Sessions({"mo", "tu"}), history, "tu", ""), Error);
}

TEST(MapDiff, WritesCsv) {
  const MapHistory history = ChangedRow().History();
  const MapInfo info = Sessions({"mo", "tu", "we"});
  const std::string csv = DiffCsv(CompareSessions(info, history, "mo", "tu"), history);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_EQ(csv.rfind("change,probability,label,landmark,x,y,z,seen_from,", 0), 0u);
  EXPECT_NE(csv.find("\ndeparted,0.9"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",Car,5,"), std::string::npos) << csv;
}

}  // namespace
}  // namespace sslcd
