// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace sslcd {

/// Rasters of one byte per cell, and upper bounds of their blocks.
struct Rasters {
  const std::uint8_t *cells = nullptr, *bounds = nullptr;
  int stride = 0, bound_stride = 0;  ///< from one row to the next
};

/// Shifts of rasters that are to be added up: where in `cells` and in `bounds` each one begins.
struct RasterShifts {
  static constexpr int kMax = 32;
  std::array<int, kMax> cells, bounds;
  int count = 0;
};

/// Sums of shifted rasters over a square of cells: s(x, y) = sum_k r_k(x, y).
class Correlation {
 public:
  static constexpr int kSide = 64;   ///< of the square [cells]
  static constexpr int kBlock = 4;   ///< side of the blocks that have a bound [cells]
  static constexpr int kChunk = 32;  ///< width of the parts that are added at once [cells]

  static constexpr int kBorder = 16;                   ///< of zeros about the sums, per row
  static constexpr int kStride = kSide + 2 * kBorder;  ///< of the sums

  Correlation() { sums_.fill(0); }

  /// Adds up the parts whose bound exceeds `threshold`; the sum of the others is 0. The bound of a
  /// part is the largest sum of `bounds` of its blocks. No sum may exceed 255. The same with and
  /// without AVX2, which is used where the processor has it.
  void Add(const Rasters& rasters, const RasterShifts& shifts, std::uint8_t threshold);

  /// The cells above the threshold that no neighbour exceeds (of equal ones the first): calls
  /// visit(x, y, sum).
  template <class Visitor>
  void VisitPeaks(Visitor&& visit) const {
    for (int part = 0; part < part_count_; ++part) {
      const int first_x = parts_[part].x, first_y = parts_[part].y;
      for (int y = first_y; y < first_y + kBlock; ++y)
        for (int x = first_x; x < first_x + kChunk; x += kWord) {
          if (!Exceeds(x, y)) continue;
          for (int i = x; i < x + kWord; ++i)
            if (Sum(i, y) > threshold_ && IsPeak(i, y)) visit(i, y, Sum(i, y));
        }
    }
  }

 private:
  static constexpr int kWord = 8;
  using Word = std::uint8_t __attribute__((vector_size(kWord)));
  struct Part {
    int x, y;
  };

  static std::size_t At(int x, int y) {
    return static_cast<std::size_t>((y + 1) * kStride + x + kBorder);
  }
  std::uint8_t Sum(int x, int y) const { return sums_[At(x, y)]; }
  bool IsPeak(int x, int y) const;
  // Whether one of kWord cells exceeds the threshold.
  bool Exceeds(int x, int y) const {
    Word word;
    std::memcpy(&word, &sums_[At(x, y)], kWord);
    word = word > threshold_;
    std::uint64_t any;
    std::memcpy(&any, &word, kWord);
    return any != 0;
  }

  std::array<std::uint8_t, (kSide + 2) * kStride> sums_;           // with a border of zeros
  std::array<Part, (kSide / kBlock) * (kSide / kChunk)> parts_{};  // with sums above the threshold
  int part_count_ = 0;
  std::uint8_t threshold_ = 0;
};

}  // namespace sslcd
