// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/image_folder.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "formats/files.h"
#include "formats/text_rows.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kImageEndings = {".png", ".jpg", ".jpeg",
                                                      ".bmp", ".tif", ".tiff"};
constexpr double kFirstStamp = 1e9;  // [s] of a Unix clock, in 2001; frame numbers are smaller

/// The position of a name's ending among kImageEndings; their number: it is no image.
std::size_t EndingOf(const std::string& name) {
  std::string ending = fs::path(name).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(kImageEndings.begin(), kImageEndings.end(), ending) - kImageEndings.begin();
}

std::string StemOf(const std::string& name) { return fs::path(name).stem().string(); }

/// The number at the end of a name without its ending: digits, or digits with a point.
std::string NumberOf(const std::string& stem) {
  std::size_t first = stem.find_last_not_of("0123456789.") + 1;
  while (first < stem.size() && stem[first] == '.') ++first;
  const std::string number = stem.substr(first);
  const bool one_number = std::count(number.begin(), number.end(), '.') <= 1;
  return one_number && !number.empty() && number.back() != '.' ? number : "";
}

/// Seconds of one unit of whole stamps as large as this one.
double UnitOfStamps(double largest) {
  for (const auto& [first, unit] : {std::pair(1e17, 1e-9), {1e14, 1e-6}, {1e11, 1e-3}})
    if (largest >= first) return unit;
  return 1;
}

/// By key. Of images of one key that differ in the ending alone the first is kept.
void SortImages(ImageFolder& folder) {
  using Entry = ImageFolder::Entry;
  const auto rank = [](const Entry& e) { return std::pair(e.key, EndingOf(e.name)); };
  std::sort(folder.images.begin(), folder.images.end(),
            [&](const Entry& a, const Entry& b) { return rank(a) < rank(b); });
  const auto same = [&](const Entry& a, const Entry& b) {
    if (a.key != b.key) return false;
    if (StemOf(a.name) != StemOf(b.name))
      throw Error(ErrorKind::kBadInput, {(fs::path(folder.path) / b.name).string()},
                  "is the same number as " + a.name + ": remove one");
    return true;
  };
  folder.images.erase(std::unique(folder.images.begin(), folder.images.end(), same),
                      folder.images.end());
}

}  // namespace

bool IsImageName(const std::string& name) { return EndingOf(name) < kImageEndings.size(); }

ImageFolder ListImages(const std::string& path) {
  ImageFolder folder;
  folder.path = path;
  if (path.empty()) return folder;
  bool point = false;
  double largest = 0;
  for (const std::string& name : FileNames(path)) {
    if (!IsImageName(name)) continue;
    const std::string text = NumberOf(StemOf(name));
    const auto number = ParseNumber(text);
    if (!number || !std::isfinite(*number)) {
      ++folder.others;
      continue;
    }
    point = point || text.find('.') != std::string::npos;
    largest = std::max(largest, *number);
    folder.images.push_back({*number, name});
  }
  if (!point && largest >= kFirstStamp)
    for (const ImageFolder::Entry& image : folder.images)
      if (image.key < kFirstStamp)
        throw Error(ErrorKind::kBadInput, {(fs::path(path) / image.name).string()},
                    "is named by a frame number, others by stamps: name all of them alike");
  folder.by_stamp = point || largest >= kFirstStamp;
  const double unit = point ? 1 : UnitOfStamps(largest);
  for (ImageFolder::Entry& image : folder.images) image.key *= unit;
  SortImages(folder);
  return folder;
}

const ImageFolder::Entry* ImageFolder::Find(double key, double tolerance) const {
  auto nearest = std::lower_bound(images.begin(), images.end(), key,
                                  [](const Entry& image, double k) { return image.key < k; });
  if (nearest != images.begin() &&
      (nearest == images.end() || key - (nearest - 1)->key < nearest->key - key))
    --nearest;
  if (nearest == images.end() || !(std::abs(nearest->key - key) <= tolerance)) return nullptr;
  return &*nearest;
}

std::string ImageFolder::PathOf(const Entry* image) const {
  return image ? IfFile(fs::path(path) / image->name) : "";
}

std::vector<double> ImageFolder::Keys() const {
  std::vector<double> keys;
  for (const Entry& image : images) keys.push_back(image.key);
  return keys;
}

}  // namespace sslcd
