// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/store/map_session.h"

#include <gtest/gtest.h>

#include <limits>

#include "store_drive.h"

namespace sslcd {
namespace {

TEST(MapSession, OneSessionIsAPlainRun) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const std::string path = MakeMap(folder, drive);
  Mapper mapper({}, drive.Context());
  for (const Frame& frame : drive.frames) mapper.AddFrame(frame);
  mapper.Refine();
  const MapStore store(path);
  EXPECT_TRUE(store.Verify().empty());
  const MapResults results = store.Results();
  EXPECT_EQ(TextOf(results, drive.world.gravity.up), TextOf(mapper));
  EXPECT_EQ(results.scale, mapper.scale());
  EXPECT_EQ(results.inputs, static_cast<int>(drive.frames.size()) + 2);
  ASSERT_EQ(results.paths.size(), 1u);
  for (std::size_t i = 0; i < drive.frames.size(); ++i)
    EXPECT_EQ(results.paths[0].odometry.poses[i].matrix(), drive.frames[i].T_odom_cam.matrix());
}

TEST(MapSession, TheMapTellsWhereItComesFrom) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const MapInfo info = MapStore(MakeMap(folder, drive)).Describe();
  EXPECT_EQ(info.up_axis, drive.world.gravity.up);
  EXPECT_EQ(info.camera->fx, drive.world.camera.fx);
  EXPECT_EQ(info.labels["Pole"].symmetry, drive.world.labels["Pole"].symmetry);
  EXPECT_EQ(info.vector_length[Cue::kEmbedding], 2);
  EXPECT_EQ(info.vector_length[Cue::kColour], 0);
  ASSERT_EQ(info.sessions.size(), 1u);
  EXPECT_EQ(info.sessions[0].name, "one");
  EXPECT_TRUE(info.sessions[0].ended);
  EXPECT_EQ(info.sessions[0].frames, 60);
  EXPECT_EQ(info.sessions[0].last_frame, 59);
  EXPECT_EQ(info.sessions[0].dataset, "a drive");
  EXPECT_EQ(info.sessions[0].checksum.size(), 32u);
}

// Sessions that are left without a word keep what stored_frames() counts, and end alike.
TEST(MapSession, AnInterruptedSessionGoesOn) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const std::string whole = TextOf(MapStore(MakeMap(folder, drive)).Results(), Vec3(0, -1, 0));
  const std::string path = folder.In("parts.db");
  for (const std::size_t end : {0, 7, 23, 24, 58}) {
    int stored = 0;
    {
      MapSession session =
          end == 0 ? BeginSession(path, "one", drive) : MapSession::Resume(path, drive.Context());
      for (std::size_t i = 0; i < end; ++i)
        if (!session.IsStored(drive.frames[i])) session.AddFrame(drive.frames[i]);
      stored = session.stored_frames();
    }
    const MapInfo info = MapStore(path).Describe();
    EXPECT_EQ(info.sessions[0].frames, stored);
    EXPECT_LE(static_cast<int>(end) - stored, 30);
    EXPECT_FALSE(info.sessions[0].ended);
    EXPECT_TRUE(MapStore(path).Verify().empty());
  }
  MapSession session = MapSession::Resume(path, drive.Context());
  Finish(drive, session);
  EXPECT_EQ(TextOf(MapStore(path).Results(), Vec3(0, -1, 0)), whole);
  EXPECT_TRUE(MapStore(path).Verify().empty());
}

TEST(MapSession, ASecondSessionIsAddedToTheFirst) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const std::string path = MakeMap(folder, drive);
  Mapper mapper({}, drive.Context());
  for (const Frame& frame : drive.frames) mapper.AddFrame(frame);
  mapper.Refine();
  mapper.StartSequence();
  FilterReport filter;
  for (Frame frame : drive.frames) {
    frame.index += 60;
    filter += mapper.AddFrame(frame).filter;
  }
  mapper.Refine();
  {
    MapSession session = BeginSession(path, "two", drive);
    EXPECT_EQ(session.info().frame_offset, 60);
    Finish(drive, session);
    EXPECT_EQ(session.filter().kept, filter.kept);
  }
  const MapResults results = MapStore(path).Results();
  ASSERT_EQ(results.paths.size(), 2u);
  EXPECT_EQ(results.paths[1].session, 2);
  EXPECT_EQ(results.paths[1].frames.front(), 60);
  EXPECT_EQ(results.parts, mapper.Parts());
  EXPECT_EQ(results.parts.size(), 2u);
  EXPECT_EQ(TextOf(results, drive.world.gravity.up), TextOf(mapper));
}

// A second session with a restart of its odometry and a refinement on the way, interrupted twice.
TEST(MapSession, AnInterruptedSecondSessionGoesOn) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  const std::string path = MakeMap(folder, drive);
  Mapper mapper({}, drive.Context());
  for (const Frame& frame : drive.frames) mapper.AddFrame(frame);
  mapper.Refine();
  mapper.StartSequence();
  for (Frame frame : drive.frames) {
    if (frame.index == 20) mapper.StartSequence();
    if (frame.index == 40) mapper.Refine(Refinement::kOnTheWay);
    frame.index += 60;
    mapper.AddFrame(frame);
  }
  for (const int end : {15, 45, 60}) {
    MapSession session =
        end == 15 ? BeginSession(path, "two", drive) : MapSession::Resume(path, drive.Context());
    for (const Frame& frame : drive.frames) {
      if (frame.index >= end || session.IsStored(frame)) continue;
      if (frame.index == 20) session.StartSequence();
      if (frame.index == 40) session.Refine(Refinement::kOnTheWay);
      session.AddFrame(frame);
    }
    if (end == 60)
      session.End();
    else
      session.Save();
  }
  EXPECT_EQ(TextOf(MapStore(path).Results(), drive.world.gravity.up), TextOf(mapper));
  EXPECT_EQ(mapper.Parts().size(), 3u);
  EXPECT_TRUE(MapStore(path).Verify().empty());
}

TEST(MapSession, TheAnswersOfAViewAlignerAreStored) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet();
  MapperContext context = drive.Context();
  int asked = 0;
  context.view_aligner = OneByOne([&](const ViewPair& pair) {
    ++asked;
    return std::optional<RelativePose>({pair.T_a_b_guess, Pose::Matrix6::Identity() * 1e-4});
  });
  const std::string path = folder.In("site.db");
  Options options;  // cameras of one stretch of road see the same ground
  options.loop.views.gap_m = 5;
  options.loop.views.apart_m = 20;
  std::string before;
  {
    MapSession session = MapSession::Begin(path, {"one"}, context, options);
    Finish(drive, session);
    before = TextOf(session.mapper());
  }
  EXPECT_GT(asked, 0);
  const int first = asked;
  MapSession session = MapSession::Begin(path, {"two"}, drive.Context(), std::nullopt);
  EXPECT_EQ(TextOf(session.mapper()), before) << "without the images";
  EXPECT_EQ(asked, first);
}

TEST(MapSession, WhatDoesNotBelongToTheMapIsRefused) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(30);
  const std::string path = MakeMap(folder, drive);
  const auto begin = [&](const MapperContext& context, std::optional<Options> options) {
    return [=] { MapSession::Begin(path, {"two"}, context, options); };
  };
  MapperContext context = drive.Context();
  context.gravity = GravityFrame::FromUp(Vec3(0, 0, 1));
  ExpectError(begin(context, {}), {"another site", "(0 -1 0)", "(0 0 1)"});
  context = drive.Context();
  context.labels.Set("Pole", {Symmetry::kNone});
  ExpectError(begin(context, {}),
              {"another site", "'Pole'", "'full' there", "'none' in this drive"});
  context = drive.Context();
  context.place_matcher = [](const PlaceQuery&) { return std::nullopt; };
  ExpectError(begin(context, {}), {"place matcher"});
  Options options;
  options.window.keyframes = 5;
  ExpectError(begin(drive.Context(), options), {"other options", "keyframes: 8", "keyframes: 5"});
  ExpectError([&] { BeginSession(path, "one", drive); }, {"session 'one' already", "--session"});
  ExpectError([&] { MapSession::Resume(path, drive.Context()); }, {"no session to go on with"});
  EXPECT_EQ(MapStore(path).Describe().sessions.size(), 1u);
  begin(drive.Context(), Options())();
  ExpectError([&] { BeginSession(path, "three", drive); },
              {"'two' has not been ended", "--resume"});
}

TEST(MapSession, NoSessionFollowsTheLargestFrameNumber) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(2);
  const std::string path = folder.In("site.db");
  {
    MapSession session = BeginSession(path, "one", drive);
    Frame last = drive.frames[0];
    last.index = std::numeric_limits<int>::max();
    session.AddFrame(last);
    session.End();
  }
  ExpectError([&] { BeginSession(path, "two", drive); }, {path, "'one'", "largest number"});
}

TEST(MapSession, VectorsOfAnotherModelAreRefused) {
  const TempFolder folder;
  StoreDrive drive = ShortStreet(30);
  const std::string path = MakeMap(folder, drive);
  MapSession session = BeginSession(path, "two", drive);
  for (Frame& frame : drive.frames)
    for (Detection& detection : frame.detections) detection.appearance[Cue::kEmbedding] = {1, 0, 0};
  ExpectError([&] { Finish(drive, session); }, {"embedding of 3 numbers", "have 2"});
  session.Save();
  EXPECT_TRUE(MapStore(path).Verify().empty());
}

TEST(MapSession, AChangedDriveIsNotGoneOnWith) {
  const TempFolder folder;
  StoreDrive drive = ShortStreet(40);
  const std::string path = folder.In("site.db");
  {
    MapSession session = BeginSession(path, "one", drive);
    for (const Frame& frame : drive.frames) session.AddFrame(frame);
  }
  drive.frames[5].T_odom_cam.translation().x() += 1e-9;
  const MapSession session = MapSession::Resume(path, drive.Context());
  EXPECT_TRUE(session.IsStored(drive.frames[4]));
  ExpectError([&] { session.IsStored(drive.frames[5]); }, {"frame 5", "session 'one'", "map end"});
  Frame next = drive.frames.back();
  ++next.index;
  EXPECT_FALSE(session.IsStored(next));
}

TEST(MapSession, AnotherCameraMeansNoBoxes) {
  const TempFolder folder;
  const StoreDrive drive = ShortStreet(40);
  const std::string path = MakeMap(folder, drive);
  MapperContext context = drive.Context();
  context.camera->fx += 1;
  {
    MapSession session = MapSession::Begin(path, {"two"}, context, std::nullopt);
    for (const Frame& frame : drive.frames) session.AddFrame(frame);
    session.Save();
  }
  MapSession session = MapSession::Resume(path, context);
  EXPECT_TRUE(session.IsStored(drive.frames[3])) << "compared without boxes";
}

}  // namespace
}  // namespace sslcd
