// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "formats/raw_file.h"

namespace sslcd {
namespace {

enum TiffTag : std::uint32_t {
  kWidth = 256,
  kHeight = 257,
  kBits = 258,
  kCompression = 259,
  kPhotometric = 262,
  kStripOffsets = 273,
  kSamples = 277,
  kRowsPerStrip = 278,
  kPlanar = 284,
  kTileWidth = 322
};

struct TiffField {
  int bytes = 0;            // of one value
  std::uint32_t count = 0;  // of values
  std::uint64_t place = 0;  // of the first value
};

/// The fields of the first directory that hold whole numbers of 8, 16 or 32 bits.
std::map<std::uint32_t, TiffField> ReadFields(RawFile& file) {
  std::map<std::uint32_t, TiffField> fields;
  const std::uint64_t directory = file.At(4, 4);
  const std::uint32_t count = file.At(directory, 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t entry = directory + 2 + 12 * std::uint64_t{i};
    const std::uint32_t tag = file.At(entry, 2), type = file.At(entry + 2, 2);
    const int bytes = type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0;
    const std::uint32_t values = file.At(entry + 4, 4);
    if (bytes == 0 || values == 0) continue;
    const bool inside = std::uint64_t{values} * bytes <= 4;
    fields[tag] = {bytes, values, inside ? entry + 8 : file.At(entry + 8, 4)};
  }
  return fields;
}

class TiffDirectory {
 public:
  explicit TiffDirectory(RawFile& file) : file_(file), fields_(ReadFields(file)) {}

  bool Has(TiffTag tag) const { return fields_.count(tag) > 0; }
  std::uint32_t Count(TiffTag tag) const { return Has(tag) ? fields_.at(tag).count : 0; }
  std::uint32_t Value(TiffTag tag, std::uint32_t missing, std::uint32_t index = 0) const {
    const auto field = fields_.find(tag);
    if (field == fields_.end() || index >= field->second.count) return missing;
    const std::uint64_t offset = std::uint64_t{index} * field->second.bytes;
    return file_.At(field->second.place + offset, field->second.bytes);
  }

 private:
  RawFile& file_;
  std::map<std::uint32_t, TiffField> fields_;
};

}  // namespace

RawImage ReadTiffHeader(RawFile& file) {
  const TiffDirectory directory(file);
  const std::uint32_t width = directory.Value(kWidth, 0), height = directory.Value(kHeight, 0);
  const std::uint32_t samples = directory.Value(kSamples, 1);
  CheckRawSize(file, width, height);
  if (directory.Value(kCompression, 1) != 1) file.Refuse("is a compressed TIFF");
  if (directory.Has(kTileWidth)) file.Refuse("is a TIFF in tiles");
  if (directory.Value(kPlanar, 1) != 1) file.Refuse("is a TIFF with a plane for each colour");
  if (samples != 1 && samples != 3 && samples != 4)
    file.Refuse("is a TIFF of " + std::to_string(samples) + " channels");
  for (std::uint32_t i = 0; i < samples; ++i)
    if (directory.Value(kBits, i == 0 ? 1 : 8, i) != 8)
      file.Refuse("is a TIFF of " + std::to_string(directory.Value(kBits, 1, i)) +
                  " bits a channel");
  if (directory.Value(kPhotometric, 0) != (samples == 1 ? 1 : 2))
    file.Refuse("is a TIFF of neither grey nor R G B");

  RawImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.bytes_per_pixel = static_cast<int>(samples);
  image.rgb = samples > 1;
  const std::uint32_t strip = directory.Value(kRowsPerStrip, height);
  if (strip == 0 || (height - 1) / strip >= directory.Count(kStripOffsets))
    file.Refuse("is a TIFF that does not say where its pixels are");
  std::uint64_t begin = 0;  // of the strip
  for (std::uint32_t row = 0; row < height; ++row) {
    if (row % strip == 0) begin = directory.Value(kStripOffsets, 0, row / strip);
    image.rows.push_back(begin + image.RowBytes() * (row % strip));
  }
  return image;
}

}  // namespace sslcd
