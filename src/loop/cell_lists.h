// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "loop/append.h"

namespace sslcd {

/// Lists of numbers by the cells of an unbounded grid, as chains in a hash table. Adding, removing
/// and finding a cell's list are O(1) on average, for any size of the map and any share of empty
/// cells.
class CellLists {
 public:
  explicit CellLists(double cell_m) : per_cell_(1 / cell_m), heads_(4 * kTile * kTile, -1) {}

  /// The column or row of a finite coordinate. Coordinates beyond 2^29 cells share the last one.
  int Cell(double coordinate) const {
    constexpr double kMiddle = 1 << 29;  // keeps numbers positive, so that truncation rounds down
    return static_cast<int>(std::clamp(coordinate * per_cell_ + kMiddle, 2., 2 * kMiddle - 2));
  }

  void Add(int column, int row, int number) {
    if (kRoom * entries_.size() >= heads_.size() && free_ < 0) Widen();
    int entry = free_;
    if (entry < 0) {
      entry = static_cast<int>(entries_.size());
      Append(entries_);
    } else {
      free_ = entries_[entry].next;
    }
    int& head = heads_[Slot(column, row)];
    entries_[entry] = {column, row, number, head};
    head = entry;
  }

  /// Removes a number that the cell contains.
  void Remove(int column, int row, int number) {
    int* link = &heads_[Slot(column, row)];
    const auto is_it = [&](const Entry& e) {
      return e.number == number && e.column == column && e.row == row;
    };
    while (!is_it(entries_[*link])) link = &entries_[*link].next;
    const int entry = *link;
    *link = entries_[entry].next;
    entries_[entry].next = free_;
    free_ = entry;
  }

  /// The numbers of a cell in an unspecified but deterministic order.
  class Iterator {
   public:
    Iterator(const CellLists* lists, int column, int row, int entry)
        : lists_(lists), column_(column), row_(row), entry_(entry) {
      SkipOthers();
    }
    int operator*() const { return lists_->entries_[entry_].number; }
    Iterator& operator++() {
      entry_ = lists_->entries_[entry_].next;
      SkipOthers();
      return *this;
    }
    bool operator!=(const Iterator& other) const { return entry_ != other.entry_; }

   private:
    void SkipOthers() {  // skips entries of other cells with the same hash
      while (entry_ >= 0 &&
             (lists_->entries_[entry_].column != column_ || lists_->entries_[entry_].row != row_))
        entry_ = lists_->entries_[entry_].next;
    }
    const CellLists* lists_;
    int column_, row_, entry_;
  };
  struct Range {
    Iterator first, last;
    Iterator begin() const { return first; }
    Iterator end() const { return last; }
    bool empty() const { return !(first != last); }
  };
  Range At(int column, int row) const {
    return {{this, column, row, heads_[Slot(column, row)]}, {this, column, row, -1}};
  }
  Range None() const { return {{this, 0, 0, -1}, {this, 0, 0, -1}}; }

 private:
  struct Entry {
    int column = 0, row = 0, number = 0, next = -1;
  };
  // chains per entry, so that most empty cells have an empty chain
  static constexpr std::size_t kRoom = 4;
  // a square of kTile x kTile cells is contiguous in memory
  static constexpr int kTile = 8;

  std::size_t Slot(int column, int row) const {
    const std::uint64_t tile =
        static_cast<std::uint64_t>(column / kTile) << 32 | static_cast<unsigned>(row / kTile);
    const std::uint64_t hash = tile * 0x9E3779B97F4A7C15u >> 32;
    const std::uint64_t first = (hash * (heads_.size() / (kTile * kTile)) >> 32) * (kTile * kTile);
    return first + static_cast<unsigned>(column % kTile * kTile + row % kTile);
  }
  void Widen() {  // called when all entries are in use
    const std::size_t tiles = heads_.size() / (kTile * kTile);
    heads_ = {};  // frees the memory first
    heads_.assign((tiles + tiles / 2) * (kTile * kTile), -1);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      int& head = heads_[Slot(entries_[i].column, entries_[i].row)];
      entries_[i].next = head;
      head = static_cast<int>(i);
    }
  }

  double per_cell_;
  std::vector<int> heads_;  // first entries of the chains; the size is a multiple of a tile
  std::vector<Entry> entries_;
  int free_ = -1;
};

}  // namespace sslcd
