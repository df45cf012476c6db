// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sslcd {

/// The images of one camera: files that end with .png, .jpg, .jpeg, .bmp, .tif or .tiff, in any
/// case, and whose names end with a number. A number with a decimal point is a stamp [s]; so is a
/// whole one of a Unix clock in s, ms, us or ns, which is told by its size. Other numbers are frame
/// numbers. Letters may come first (left_000012.png).
struct ImageFolder {
  struct Entry {
    double key = 0;    ///< frame number, or stamp [s]
    std::string name;  ///< of the file
  };

  std::string path;
  bool by_stamp = false;
  std::vector<Entry> images;  ///< by key, which increases
  int others = 0;             ///< images whose names have no number

  /// The image nearest to a key, at most `tolerance` away; null: there is none.
  const Entry* Find(double key, double tolerance) const;
  /// The path of an image, empty for none. Throws Error(kBadInput) if there is no file.
  std::string PathOf(const Entry* image) const;
  std::vector<double> Keys() const;
};

/// Lists a folder; an empty path gives an empty list. Of two files that differ in the ending alone
/// the first is taken (.png before .jpg). Throws Error(kBadInput) if two other names have one
/// number, or if frame numbers and stamps are mixed.
ImageFolder ListImages(const std::string& folder);

/// Whether the name is that of an image, by its ending.
bool IsImageName(const std::string& name);

}  // namespace sslcd
