// SPDX-License-Identifier: BSD-3-Clause
#include "retrieval/pose_votes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <new>
#include <tuple>

namespace sslcd {
namespace {

// Sides of a cell; headings in a turn; cells in a table. Set by hand. [m]
constexpr float kSide = 8;
constexpr int kHeadings = 18;
constexpr int kTableBits = 20;
constexpr std::size_t kCells = std::size_t{1} << kTableBits;
constexpr std::size_t kMostListed = kCells / 16;  // a table with more is read as a whole
constexpr float kSteps = 16;                      // of weights in a nat
constexpr std::uint16_t kMost = 4095;             // steps of a cell, 256 nats

std::uint32_t CellOf(const PoseVote& vote, int grid) {
  const float shift = 0.5f * static_cast<float>(grid);
  const auto steps = [&](float value) {
    constexpr int kPositive = 1 << 20;  // rounds down
    return static_cast<std::uint64_t>(static_cast<int>(value + shift + kPositive));
  };
  const std::uint64_t heading =
      steps(vote.pose.yaw * static_cast<float>(kHeadings / (2 * M_PI))) % kHeadings;
  const std::uint64_t cell = heading << 52 ^ steps(vote.pose.x / kSide) << 26 ^
                             steps(vote.pose.y / kSide) ^ vote.site * 0xBF58476D1CE4E5B9u;
  const std::uint64_t hash = (cell ^ cell >> 32) * 0x9E3779B97F4A7C15u;
  return static_cast<std::uint32_t>((hash ^ hash >> 29) * 0x94D049BB133111EBu >> (64 - kTableBits));
}

// The weight that about `most` cells have at least, by their number for each weight.
int Threshold(const std::array<std::size_t, kMost + 1>& cells, std::size_t most) {
  int least = kMost;
  for (std::size_t count = cells[kMost]; count < most && least > 1;) count += cells[--least];
  return least;
}

struct Mean {
  double x = 0, y = 0, cosine = 0, sine = 0, weight = 0;

  void Add(const PoseVote& vote) {
    x += vote.weight * vote.pose.x;
    y += vote.weight * vote.pose.y;
    cosine += vote.weight * std::cos(vote.pose.yaw);
    sine += vote.weight * std::sin(vote.pose.yaw);
    weight += vote.weight;
  }
  PoseVote Vote(std::uint32_t site) const {
    return {site,
            {static_cast<float>(std::atan2(sine, cosine)), static_cast<float>(x / weight),
             static_cast<float>(y / weight)},
            static_cast<float>(weight)};
  }
};

bool AreNear(const PoseVote& a, const PoseVote& b) {
  return a.site == b.site && std::hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y) < kSide / 2 &&
         std::cos(a.pose.yaw - b.pose.yaw) > std::cos(M_PI / kHeadings);
}

}  // namespace

PoseVotes::PoseVotes() {
  for (auto& table : table_) {
    // zeros that take no memory before a vote falls there
    table.reset(static_cast<std::uint16_t*>(std::calloc(kCells, sizeof(std::uint16_t))));
    if (table == nullptr) throw std::bad_alloc();
  }
}

// Maybe for zeros, too.
template <class Function>
void PoseVotes::ForUsedCells(const Function& function) const {
  for (int grid = 0; grid < 2; ++grid)
    if (used_[grid].size() < kMostListed)
      for (const std::uint32_t cell : used_[grid]) function(table_[grid][cell]);
    else
      for (std::size_t cell = 0; cell < kCells; ++cell) function(table_[grid][cell]);
}

void PoseVotes::Clear() {
  votes_.clear();
  ForUsedCells([](std::uint16_t& weight) { weight = 0; });
  for (auto& cells : used_) cells.clear();
}

void PoseVotes::Add(const PoseVote& vote) {
  Counted& counted = votes_.emplace_back();
  counted.vote = vote;
  for (int grid = 0; grid < 2; ++grid) {
    counted.cell[grid] = CellOf(vote, grid);
    std::uint16_t& sum = table_[grid][counted.cell[grid]];
    const bool was_zero = sum == 0;
    sum = static_cast<std::uint16_t>(
        std::min<int>(sum + static_cast<int>(vote.weight * kSteps), kMost));
    if (was_zero && sum != 0 && used_[grid].size() < kMostListed)
      used_[grid].push_back(counted.cell[grid]);
  }
}

std::vector<PoseVote> PoseVotes::Best(std::size_t most) const {
  std::array<std::size_t, kMost + 1> cells{};  // of each weight
  ForUsedCells([&](std::uint16_t weight) { ++cells[weight]; });
  const int least = Threshold(cells, 2 * most);
  // Sites that share a cell of a table by chance are told apart here.
  std::map<std::tuple<int, std::uint32_t, std::uint32_t>, Mean> means;
  for (const auto& [vote, cell] : votes_)
    for (int grid = 0; grid < 2; ++grid)
      if (table_[grid][cell[grid]] >= least) means[{grid, cell[grid], vote.site}].Add(vote);
  std::vector<PoseVote> all, best;
  for (const auto& [key, mean] : means) all.push_back(mean.Vote(std::get<2>(key)));
  std::stable_sort(all.begin(), all.end(),
                   [](const PoseVote& a, const PoseVote& b) { return a.weight > b.weight; });
  for (const PoseVote& vote : all) {
    if (best.size() == most) break;
    if (std::none_of(best.begin(), best.end(),
                     [&](const PoseVote& other) { return AreNear(vote, other); }))
      best.push_back(vote);
  }
  return best;
}

}  // namespace sslcd
