// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/retrieval/site_index.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <thread>

#include "../support/temp_folder.h"
#include "random_sites.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

class SiteIndexTest : public testing::Test {
 protected:
  static std::vector<Site> Sites(int count = 30) {
    std::vector<Site> sites;
    for (int i = 0; i < count; ++i)
      sites.push_back(RandomSite("site " + std::to_string(i), static_cast<unsigned>(i), 200 + i));
    return sites;
  }

  std::string Path(const std::string& name = "all.sites") const { return folder_.In(name); }

  static std::string Bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  TempFolder folder_;
};

TEST_F(SiteIndexTest, AStretchIsFoundWithItsPose) {
  const std::vector<Site> sites = Sites();
  SiteIndex::Build(sites, Path());
  const SiteIndex index(Path());
  for (const int truth : {0, 7, 29}) {
    const std::vector<SiteObject> stretch = StretchOfSite(sites[truth], 2.5, 0.4);
    const std::vector<SiteCandidate> found = index.Find(stretch);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found[0].site, truth);
    EXPECT_EQ(found[0].name, sites[truth].name);
    EXPECT_GT(found[0].score, 20);
    EXPECT_GT(found[0].matches, static_cast<int>(stretch.size()) / 2);
    const double c = std::cos(found[0].yaw), s = std::sin(found[0].yaw);  // of the point (7, -3)
    EXPECT_NEAR(c * 7 + s * 3 + found[0].x, 40, 0.5);
    EXPECT_NEAR(s * 7 - c * 3 + found[0].y, 40, 0.5);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].score, found[i - 1].score);
  }
}

TEST_F(SiteIndexTest, MissingAndFalseObjectsAndWrongLabels) {
  const std::vector<Site> sites = Sites();
  SiteIndex::Build(sites, Path());
  std::vector<SiteObject> stretch = StretchOfSite(sites[4], -1, 0.3), some;
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    if (i % 7 == 3) continue;
    some.push_back(stretch[i]);
    if (i % 11 == 5) some.back().label = "Pole";
    if (i % 9 == 1) some.push_back({"Car", stretch[i].x + 6, stretch[i].y - 5});
  }
  const std::vector<SiteCandidate> found = SiteIndex(Path()).Find(some, 3);
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), 3u);
  EXPECT_EQ(found[0].site, 4);
}

TEST_F(SiteIndexTest, TheMirrorImageIsAnotherSite) {
  const std::vector<Site> sites = Sites();
  SiteIndex::Build(sites, Path());
  const SiteIndex index(Path());
  const double right = index.Find(StretchOfSite(sites[2], 1, 0))[0].score;
  for (const SiteCandidate& one : index.Find(StretchOfSite(sites[2], 1, 0, true)))
    EXPECT_LT(one.score, right / 3);
}

TEST_F(SiteIndexTest, NothingAgreesWithAnotherPlace) {
  SiteIndex::Build(Sites(), Path());
  const SiteIndex index(Path());
  const double right = index.Find(StretchOfSite(Sites()[3], 1, 0.3))[0].score;
  for (const SiteCandidate& one : index.Find(StretchOfSite(RandomSite("", 777, 220), 0, 0)))
    EXPECT_LT(one.score, right / 2);
}

TEST_F(SiteIndexTest, AnObjectFarAwayDoesNotMatter) {
  SiteIndex::Build(Sites(7), Path());
  const SiteIndex index(Path());
  std::vector<SiteObject> stretch = StretchOfSite(Sites(7)[6], 1, 0.3);
  const SiteCandidate alone = index.Find(stretch)[0];
  // as the mean, the middle would be so far away that single precision has no tenths of a metre
  stretch.push_back({"Car", 9e7, 0});
  const SiteCandidate found = index.Find(stretch)[0];
  EXPECT_EQ(found.site, 6);
  EXPECT_EQ(found.matches, alone.matches);
  EXPECT_NEAR(found.score, alone.score, 5) << "it is one object without a match";
}

TEST_F(SiteIndexTest, StretchesThatTellNothing) {
  SiteIndex::Build(Sites(3), Path());
  const SiteIndex index(Path());
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(index.Find({}).empty());
  EXPECT_TRUE(index.Find({{"Car", 1, 2}}).empty());
  EXPECT_TRUE(index.Find({{"Car", 1, 2}, {"Car", 5, 2}, {"Car", 9, 9}, {"Car", 1, 9}}).empty());
  EXPECT_TRUE(index.Find(std::vector<SiteObject>(50, {"Car", 1, 2})).empty());
  EXPECT_TRUE(index.Find(std::vector<SiteObject>(50, {"Car", kNaN, 2})).empty());
  std::vector<SiteObject> strange = StretchOfSite(Sites(3)[1], 0, 0);
  EXPECT_TRUE(index.Find(strange, 0).empty());
  EXPECT_TRUE(index.Find(strange, -1).empty());
  strange.push_back({"Car", 1e9, -1e9});
  EXPECT_NO_THROW(index.Find(strange));
  strange.back() = {"Car", 1e300, kNaN};
  EXPECT_EQ(index.Find(strange)[0].site, 1);
  for (SiteObject& object : strange) object.label = "House";
  EXPECT_TRUE(index.Find(strange).empty());
}

TEST_F(SiteIndexTest, EmptySitesAndIndices) {
  SiteIndex::Build({}, Path());
  const SiteIndex none(Path());
  EXPECT_EQ(none.size(), 0);
  EXPECT_TRUE(none.Find(StretchOfSite(RandomSite("", 1, 200), 0, 0)).empty());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SiteIndex::Build({{"nothing", {}}, RandomSite("one", 1, 200), {"far", {{"Car", kInfinity, 0}}}},
                   Path());
  const SiteIndex some(Path());
  EXPECT_EQ(some.size(), 3);
  EXPECT_EQ(some.objects(), 200);
  EXPECT_TRUE(some.ReadSite(0).objects.empty());
  EXPECT_EQ(some.name(2), "far");
  EXPECT_EQ(some.Find(StretchOfSite(RandomSite("one", 1, 200), 0, 0))[0].site, 1);
}

TEST_F(SiteIndexTest, SitesKeepTheirPlaceAndLabels) {
  Site site = RandomSite("utm", 3, 100);
  for (SiteObject& object : site.objects) object.x += 4.5e5, object.y += 5.4e6;
  SiteIndex::Build({site}, Path());
  const Site read = SiteIndex(Path()).ReadSite(0);
  ASSERT_EQ(read.objects.size(), 100u);
  for (const SiteObject& object : read.objects)
    EXPECT_TRUE(std::any_of(site.objects.begin(), site.objects.end(), [&](const SiteObject& o) {
      return o.label == object.label && std::hypot(o.x - object.x, o.y - object.y) < 1e-3;
    }));
}

TEST_F(SiteIndexTest, TheSameSitesGiveTheSameBytes) {
  std::vector<Site> sites = Sites(6);
  for (SiteObject& object : sites[1].objects) object.x += 4.5e5, object.y += 5.4e6;
  SiteIndex::Build(sites, Path());
  SiteIndex::Build({sites[0], sites[1]}, Path("first"));
  SiteIndexBuilder builder;
  builder.Add(SiteIndex(Path("first")));
  for (std::size_t i = 2; i < sites.size(); ++i) builder.Add(sites[i]);
  builder.Write(Path("extended"));
  EXPECT_EQ(Bytes(Path()), Bytes(Path("extended")));
  EXPECT_LT(static_cast<double>(SiteIndex(Path()).file_bytes()) /
                static_cast<double>(SiteIndex(Path()).objects()),
            300);
}

TEST_F(SiteIndexTest, SearchesAtOneTimeAgree) {
  const std::vector<Site> sites = Sites(10);
  SiteIndex::Build(sites, Path());
  const SiteIndex index(Path());
  std::vector<double> scores(4);
  std::vector<std::thread> threads;
  for (double& score : scores)
    threads.emplace_back([&] { score = index.Find(StretchOfSite(sites[5], 1, 0.3))[0].score; });
  for (std::thread& thread : threads) thread.join();
  for (const double score : scores) EXPECT_EQ(score, scores[0]);
}

TEST_F(SiteIndexTest, RefusedSites) {
  SiteIndexBuilder builder;
  builder.Add(RandomSite("a", 1, 50));
  EXPECT_THROW(builder.Add(RandomSite("a", 2, 50)), Error);
  EXPECT_THROW(builder.Add({"wide", {{"Car", 0, 0}, {"Car", 61e3, 0}}}), Error);
  Site many{"labels", {}};
  for (int i = 0; i < 65536; ++i) many.objects.push_back({std::to_string(i), 0, 0});
  EXPECT_THROW(builder.Add(many), Error);
  SiteIndex::Build({RandomSite("b", 3, 50), {"c", {{"Tree", 1, 2}}}, RandomSite("a", 4, 50)},
                   Path("other"));
  EXPECT_THROW(builder.Add(SiteIndex(Path("other"))), Error);
  builder.Write(Path());
  EXPECT_EQ(SiteIndex(Path()).size(), 1);
  SiteIndex::Build({RandomSite("a", 1, 50)}, Path("one"));
  EXPECT_EQ(Bytes(Path()), Bytes(Path("one"))) << "what is refused leaves nothing";
  EXPECT_THROW(builder.Write(Path("no/folder")), Error);
}

TEST_F(SiteIndexTest, ObjectsOfMaps) {
  ReferenceMap map;
  map.label_names = {"Car"};
  map.objects.resize(1);
  map.objects[0].position = Vec3(1, 2, 3);
  ASSERT_EQ(SiteObjectsOf(map).size(), 1u);
  EXPECT_EQ(SiteObjectsOf(map)[0].label, "Car");
  EXPECT_EQ(SiteObjectsOf(map)[0].y, 2);
  map.objects[0].label = 1;
  EXPECT_THROW(SiteObjectsOf(map), Error);
  std::vector<MapObject> landmarks(2);
  landmarks[0].state = LandmarkState::kConfirmed;
  landmarks[0].label = "Tree";
  landmarks[0].T_world_object = Pose(lie::SO3<double>(), Vec3(1, 2, 3));
  const std::vector<SiteObject> objects =
      SiteObjectsOf(landmarks, GravityFrame::FromUp({0, -1, 0}));
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].label, "Tree");
  EXPECT_EQ(objects[0].x, 1);
  EXPECT_EQ(objects[0].y, 3);
}

}  // namespace
}  // namespace sslcd
