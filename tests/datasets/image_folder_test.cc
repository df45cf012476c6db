// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/image_folder.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::ElementsAre;

ImageFolder ListOf(const std::vector<std::string>& names) {
  const TempFolder folder;
  for (const std::string& name : names) folder.Write(name, "");
  return ListImages(folder.path());
}

TEST(ListImages, FrameNumbers) {
  const ImageFolder images = ListOf({"10.png", "frame_000002.jpg", "x.000001.TIFF", "notes.txt"});
  EXPECT_FALSE(images.by_stamp);
  EXPECT_THAT(images.Keys(), ElementsAre(1, 2, 10));
  EXPECT_EQ(images.images[1].name, "frame_000002.jpg");
  EXPECT_EQ(images.others, 0);
  EXPECT_THAT(ListOf({"0000000007.png"}).Keys(), ElementsAre(7)) << "as KITTI raw";
}

TEST(ListImages, StampsInEachUnit) {
  for (const char* name : {"1403636579763000000.png", "1403636579763000.png", "1403636579763.png",
                           "cam0_1403636579.763.png", "1403636579.763000.png"}) {
    const ImageFolder images = ListOf({name});
    EXPECT_TRUE(images.by_stamp) << name;
    ASSERT_EQ(images.images.size(), 1u) << name;
    EXPECT_NEAR(images.images[0].key, 1403636579.763, 1e-6) << name;
  }
  EXPECT_THAT(ListOf({"0.1.png", "12.5.png"}).Keys(), ElementsAre(0.1, 12.5));
}

TEST(ListImages, NamesWithoutANumber) {
  const ImageFolder images = ListOf({"left.png", "2011-09-26_12.30.45.png", "3..png"});
  EXPECT_THAT(images.images, testing::IsEmpty());
  EXPECT_EQ(images.others, 3);
}

TEST(ListImages, OneOfTwoKinds) {
  EXPECT_EQ(ListOf({"1.jpg", "1.png"}).images.at(0).name, "1.png");
  ExpectError([] { ListOf({"1.png", "000001.png"}); }, {"is the same number as"});
}

TEST(ListImages, NoFolder) {
  EXPECT_THAT(ListImages("").images, testing::IsEmpty());
  EXPECT_THAT(ListImages("/nowhere").images, testing::IsEmpty());
}

TEST(ImageFolder, FindsTheNearest) {
  const ImageFolder images = ListOf({"1.0.png", "2.0.png"});
  const auto name = [&](double key, double tolerance) {
    const ImageFolder::Entry* found = images.Find(key, tolerance);
    return found ? found->name : "";
  };
  EXPECT_EQ(name(1.4, 0.5), "1.0.png");
  EXPECT_EQ(name(1.6, 0.5), "2.0.png");
  EXPECT_EQ(name(0.5, 0.5), "1.0.png");
  EXPECT_EQ(name(2.6, 0.5), "");
  EXPECT_EQ(ImageFolder().Find(0, 1e9), nullptr);
}

TEST(IsImageName, ByTheEnding) {
  for (const char* name : {"a.png", "a.JPG", "a.jpeg", "a.Bmp", "a.tif", "a.tiff"})
    EXPECT_TRUE(IsImageName(name)) << name;
  for (const char* name : {"a.pgm", "png", ".png", "a.png.txt", ""})
    EXPECT_FALSE(IsImageName(name)) << name;
}

}  // namespace
}  // namespace sslcd
