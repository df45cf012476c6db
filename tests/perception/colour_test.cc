// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/perception/colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "sslcd/core/error.h"

namespace sslcd {
namespace {

struct Bgr {
  int blue, green, red;
};
constexpr Bgr kWhite{230, 235, 235}, kBlack{22, 20, 20}, kGrey{130, 128, 126}, kRed{40, 30, 200},
    kBlue{190, 80, 30}, kGreen{60, 150, 40};

/// An image with the memory to back its view; rows are padded.
struct Picture {
  int width, height;
  std::vector<unsigned char> bytes;
  std::size_t stride() const { return 3 * static_cast<std::size_t>(width) + 5; }
  Picture(int w, int h) : width(w), height(h), bytes(stride() * h, 0) {}
  ImageView view() const { return {bytes.data(), width, height, stride(), 3}; }
  Box2d all() const { return {0, 0, double(width), double(height)}; }
  void Set(int x, int y, const Bgr& colour, double brightness) {
    unsigned char* pixel = &bytes[y * stride() + 3 * static_cast<std::size_t>(x)];
    const auto lit = [brightness](int value) {
      return static_cast<unsigned char>(
          std::min(255., std::max(0., std::round(value * brightness))));
    };
    pixel[0] = lit(colour.blue);
    pixel[1] = lit(colour.green);
    pixel[2] = lit(colour.red);
  }
};

/// A "car": body colour, dark windows, grey road at the bottom, some texture.
Picture Car(const Bgr& body, double brightness) {
  Picture picture(120, 80);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const bool window = y > 15 && y < 35 && x > 20 && x < 100;
      const bool road = y > 70;
      const double texture = 1 + 0.02 * ((x * 7 + y * 13) % 5 - 2);
      picture.Set(x, y,
                  window ? Bgr{50, 45, 45}
                  : road ? Bgr{105, 105, 105}
                         : body,
                  brightness * texture);
    }
  }
  return picture;
}

std::vector<float> Colour(const Picture& picture, const ColourOptions& options = {}) {
  return ColourVector(picture.view(), picture.all(), options);
}

std::vector<float> Uniform(const Bgr& colour) {
  Picture picture(20, 20);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) picture.Set(x, y, colour, 1);
  }
  return Colour(picture);
}

double Dot(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

TEST(ColourVector, SurvivesAChangeOfBrightness) {
  for (const Bgr& body : {kWhite, kGrey, kBlack, kRed, kBlue, kGreen}) {
    const std::vector<float> reference = Colour(Car(body, 1));
    for (double brightness : {0.7, 0.8, 0.9, 1.1, 1.2, 1.3}) {
      EXPECT_GE(Dot(reference, Colour(Car(body, brightness))), 0.9)
          << body.red << " at " << brightness;
    }
  }
}

TEST(ColourVector, TellsColoursApart) {
  EXPECT_LE(Dot(Uniform(kWhite), Uniform(kRed)), 0.3);
  EXPECT_LE(Dot(Uniform(kWhite), Uniform(kBlack)), 0.3);
  EXPECT_LE(Dot(Uniform(kBlue), Uniform(kRed)), 0.3);
  EXPECT_LE(Dot(Uniform(kBlue), Uniform(kGreen)), 0.3);
  // windows and road are common to both
  EXPECT_LE(Dot(Colour(Car(kWhite, 1)), Colour(Car(kRed, 1))), 0.5);
}

TEST(ColourVector, IsAUnitVectorWithoutNegativeEntries) {
  const std::vector<float> colour = Colour(Car(kBlue, 1));
  EXPECT_NEAR(Dot(colour, colour), 1, 1e-5);
  for (float entry : colour) EXPECT_GE(entry, 0);
}

TEST(ColourVector, HueIsACircle) {
  const Bgr before{4, 0, 200}, after{0, 4, 200};  // hues of about 359 and 1 degrees
  EXPECT_GE(Dot(Uniform(before), Uniform(after)), 0.99);
  EXPECT_LE(Dot(Uniform({200, 0, 0}), Uniform(after)), 0.3);
}

TEST(ColourVector, SmallSoftnessStaysFinite) {
  ColourOptions options;
  options.softness = 0.01;
  const std::vector<float> colour = Colour(Car(kRed, 1), options);
  EXPECT_NEAR(Dot(colour, colour), 1, 1e-5);
}

TEST(ColourVector, PaperModeIsTheSortedShares) {
  ColourOptions options;
  options.method = ColourOptions::Method::kPaper;
  options.clusters = 5;
  const std::vector<float> shares = Colour(Car(kRed, 1), options);
  ASSERT_EQ(shares.size(), 5u);
  EXPECT_TRUE(std::is_sorted(shares.rbegin(), shares.rend()));
  EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.), 1, 1e-6);
}

TEST(ExtractColour, FindsTheSharesOfTwoColours) {
  Picture picture(40, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 40; ++x) picture.Set(x, y, x < 30 ? kRed : kWhite, 1);
  }
  ColourOptions options;
  options.box_share = 1;
  const ColourSignature signature = ExtractColour(picture.view(), picture.all(), options);
  ASSERT_EQ(signature.size(), 2u);  // not six: there are only two colours
  EXPECT_DOUBLE_EQ(signature[0].weight, 0.75);
  EXPECT_DOUBLE_EQ(signature[1].weight, 0.25);
  EXPECT_LT((signature[0].centre - ConeColour(200 / 255., 30 / 255., 40 / 255.)).norm(), 1e-5);
}

TEST(ExtractColour, LooksAtTheCentreOfTheBoxOnly) {
  Picture picture(100, 100);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      const bool inside = x >= 40 && x < 60 && y >= 40 && y < 60;
      picture.Set(x, y, inside ? kBlue : kGreen, 1);
    }
  }
  ColourOptions options;
  options.box_share = 0.5;
  const ColourSignature signature = ExtractColour(picture.view(), {30, 30, 70, 70}, options);
  ASSERT_EQ(signature.size(), 1u);
}

TEST(ExtractColour, SamplesNoMoreThanAskedFor) {
  // With one pixel there is one cluster for any image.
  ColourOptions options;
  options.max_pixels = 1;
  const Picture car = Car(kRed, 1);
  EXPECT_EQ(ExtractColour(car.view(), car.all(), options).size(), 1u);
}

TEST(ExtractColour, BoxesWithoutPixels) {
  const Picture car = Car(kRed, 1);
  const ImageView view = car.view();
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Box2d& box :
       {Box2d{10, 10, 10, 20}, Box2d{10, 10, 5, 20}, Box2d{-50, -50, -20, -20},
        Box2d{500, 10, 600, 20}, Box2d{nan, 0, 10, 10}, Box2d{0, 0, inf, 10}, Box2d{}}) {
    EXPECT_TRUE(ExtractColour(view, box, {}).empty());
    EXPECT_TRUE(ColourVector(view, box, {}).empty());
  }
}

TEST(ExtractColour, BoxesOverTheBorderAreClipped) {
  const Picture car = Car(kRed, 1);
  EXPECT_FALSE(ExtractColour(car.view(), {-100, -100, 60, 60}, {}).empty());
  EXPECT_FALSE(ExtractColour(car.view(), {-1e12, -1e12, 1e12, 1e12}, {}).empty());
}

TEST(ExtractColour, OnePixel) {
  Picture picture(1, 1);
  picture.Set(0, 0, kRed, 1);
  const ColourSignature signature = ExtractColour(picture.view(), {0, 0, 1, 1}, {});
  ASSERT_EQ(signature.size(), 1u);
  EXPECT_EQ(signature[0].weight, 1);
}

TEST(ExtractColour, RefusesWhatIsNoColourImage) {
  const Picture car = Car(kRed, 1);
  ImageView grey = car.view();
  grey.channels = 1;
  ImageView empty = car.view();
  empty.data = nullptr;
  ImageView narrow = car.view();
  narrow.stride = 10;
  for (const ImageView& image : {grey, empty, narrow, ImageView{}}) {
    EXPECT_THROW(ExtractColour(image, car.all(), {}), Error);
  }
}

TEST(HsvColour, MatchesKnownColours) {
  EXPECT_LT((HsvColour(1, 0, 0) - Vec3(0, 255, 255)).norm(), 1e-9);
  EXPECT_LT((HsvColour(0, 1, 0) - Vec3(60, 255, 255)).norm(), 1e-9);
  EXPECT_LT((HsvColour(0, 0, 1) - Vec3(120, 255, 255)).norm(), 1e-9);
  EXPECT_LT((HsvColour(1, 0, 1) - Vec3(150, 255, 255)).norm(), 1e-9);
  EXPECT_LT((HsvColour(0.5, 0.5, 0.5) - Vec3(0, 0, 127.5)).norm(), 1e-9);
  EXPECT_LT(HsvColour(0, 0, 0).norm(), 1e-9);
}

TEST(ConeColour, StaysInsideTheCone) {
  for (double red : {0., 0.01, 0.5, 1.}) {
    for (double green : {0., 0.3, 1.}) {
      for (double blue : {0., 0.7, 1.}) {
        const Vec3 colour = ConeColour(red, green, blue);
        EXPECT_TRUE(colour.allFinite());
        EXPECT_LE(colour.head<2>().norm(), 1 + 1e-12);
        EXPECT_GE(colour.z(), 0);
        EXPECT_LE(colour.z(), 1 + 1e-12);
      }
    }
  }
}

TEST(ColourVector, Time) {
  Picture noisy(200, 150);
  for (std::size_t i = 0; i < noisy.bytes.size(); ++i)
    noisy.bytes[i] = static_cast<unsigned char>(i * i * 2654435761u >> 13);
  constexpr int kRuns = 20;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kRuns; ++i) Colour(noisy);
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  // said, not asserted: machines differ
  std::printf("colour vector: %.3f ms per box\n", elapsed.count() / kRuns);
}

}  // namespace
}  // namespace sslcd
