// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/tracklets.h"

#include <cmath>

#include "temp_folder.h"

namespace sslcd {
namespace {

std::string Item(const std::string& label, const std::string& h, int first_frame,
                 const std::string& tx) {
  const std::string pose =
      "<item><tx>" + tx +
      "</tx><ty>2</ty><tz>-1.7</tz><rx>0</rx><ry>0</ry><rz>1.5707963267948966</rz></item>";
  return "<item version=\"1\">\n<objectType>" + label + "</objectType><h>" + h +
         "</h><w>1.8</w><l>4.2</l><first_frame>" + std::to_string(first_frame) +
         "</first_frame>\n<poses><count>2</count>" + pose + pose + "</poses></item>\n";
}
std::string Document(const std::string& items) {
  return "<?xml version=\"1.0\"?>\n<!DOCTYPE boost_serialization>\n<!-- <item> "
         "-->\n<boost_serialization "
         "version=\"9\">\n"
         "<tracklets><count>1</count><empty/>\n" +
         items + "</tracklets>\n</boost_serialization>\n";
}

TEST(Tracklets, ReadsCentresInTheLidarFrame) {
  const TempFolder folder;
  const auto tracklets =
      ReadTracklets(folder.Write("t.xml", Document(Item("Car", "1.5", 3, "10"))));
  ASSERT_EQ(tracklets.size(), 1u);
  EXPECT_EQ(tracklets[0].label, "Car");
  EXPECT_EQ(tracklets[0].dims, Vec3(4.2, 1.8, 1.5));
  EXPECT_EQ(tracklets[0].first_frame, 3);
  ASSERT_EQ(tracklets[0].T_velo_object.size(), 2u);
  EXPECT_LT((tracklets[0].T_velo_object[0].translation() - Vec3(10, 2, -0.95)).norm(), 1e-12);
  EXPECT_LT((tracklets[0].T_velo_object[0].so3() * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-12);
}

TEST(Tracklets, BecomeDetectionsInFrameOrder) {
  Tracklet late{"Car", Vec3(4, 2, 1), 1, std::vector<Pose>(2)},
      early{"Van", Vec3(5, 2, 2), 0, std::vector<Pose>(2)};
  const auto by_frame = TrackletDetections({late, early}, Pose::Trans(0, 0, 7));
  ASSERT_EQ(by_frame.size(), 3u);
  EXPECT_EQ(by_frame.at(0)[0].label, "Van");
  EXPECT_EQ(by_frame.at(0)[0].row, 0);
  EXPECT_EQ(by_frame.at(1)[0].label, "Car");
  EXPECT_EQ(by_frame.at(1)[1].row, 2);
  EXPECT_EQ(by_frame.at(2)[0].row, 3);
  EXPECT_EQ(by_frame.at(2)[0].T_cam_object.translation(), Vec3(0, 0, 7));
}

TEST(Tracklets, RefusesBrokenFiles) {
  const TempFolder folder;
  const auto refuse = [&](const std::string& text, const std::vector<std::string>& parts) {
    ExpectError([&] { ReadTracklets(folder.Write("t.xml", text)); }, parts);
  };
  const std::string good = Document(Item("Car", "1.5", 0, "10"));
  refuse("", {"t.xml:1", "not a KITTI tracklet file"});
  refuse("<html></html>", {"t.xml:1", "not a KITTI tracklet file"});
  refuse(good.substr(0, good.find("</poses>")), {"t.xml:8", "the file is truncated"});
  refuse(good.substr(0, good.find("</poses>") + 3), {"t.xml:8", "the file is truncated"});
  refuse("<boost_serialization></tracklets>", {"t.xml:1", "tags mismatch at '</tracklets>'"});
  refuse("<boost_serialization>\n<a>\n</b>\n</boost_serialization>", {"t.xml:3", "at '</b>'"});
  refuse("<boost_serialization></boost_serialization>", {"has no <tracklets>"});
  refuse(Document("<item><h>1</h></item>"), {"t.xml:6", "<item> has no <objectType>"});
  refuse(Document(Item("Car", "1.5x", 0, "10")),
         {"t.xml:7", "<h>: expected a number, found '1.5x'"});
  refuse(Document(Item("Car", "0", 0, "10")), {"t.xml:6", "must be positive"});
  refuse(Document(Item("Car", "1.5", -1, "10")), {"t.xml:6", "first frame"});
  refuse(Document(Item("Car", "1.5", 0, "nan")), {"t.xml:8", "<tx>"});
}

TEST(Tracklets, NestingAndEntitiesDoNoHarm) {
  const TempFolder folder;
  constexpr int kDepth = 1'000'000;
  std::string deep;
  for (int i = 0; i < kDepth; ++i) deep += "<a>";
  for (int i = 0; i < kDepth; ++i) deep += "</a>";
  ExpectError([&] { ReadTracklets(folder.Write("t.xml", deep)); }, {"no <boost_serialization>"});
  deep.resize(deep.size() / 2);
  ExpectError([&] { ReadTracklets(folder.Write("t.xml", deep)); }, {"the file is truncated"});

  std::string text = Document(Item("&lol2; &amp; co", "1.5", 0, "10"));
  const std::string doctype = "<!DOCTYPE boost_serialization";
  text.replace(text.find(doctype), doctype.size(),
               doctype + " [<!ENTITY lol \"ha\"><!ENTITY lol2 \"&lol;&lol;\">]");
  const auto tracklets = ReadTracklets(folder.Write("t.xml", text));
  ASSERT_EQ(tracklets.size(), 1u);
  EXPECT_EQ(tracklets[0].label, "&lol2; & co") << "entities of the file's own are not expanded";
}

TEST(Tracklets, ReadsARealDrive) {
  SSLCD_REAL_DATA(folder, "kitti-raw-0001-tracklets");
  const auto tracklets = ReadTracklets(folder + "/tracklet_labels.xml");
  ASSERT_EQ(tracklets.size(), 15u);
  EXPECT_EQ(tracklets[0].label, "Car");
  EXPECT_EQ(tracklets[0].T_velo_object.size(), 14u);
  EXPECT_NEAR(tracklets[0].T_velo_object[0].translation().z(), -1.79216 + 2.16723 / 2, 1e-4);
  int cars = 0;
  for (const Tracklet& tracklet : tracklets) cars += tracklet.label == "Car";
  EXPECT_EQ(cars, 12);
}

}  // namespace
}  // namespace sslcd
