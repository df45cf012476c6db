// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "retrieval/site_point.h"

namespace sslcd {

/// A pose of the stretch in a site.
struct PoseVote {
  std::uint32_t site = 0;
  FlatPose pose;
  float weight = 0;  ///< [nats]
};

/// Counts votes for poses by cells of site, place and heading, in two grids shifted by half a cell,
/// so that neighbours on both sides of an edge share a cell in one of them. Cells are hashed into
/// tables of constant size.
class PoseVotes {
 public:
  PoseVotes();

  /// Forgets all votes and keeps the memory, 4 MiB and more.
  void Clear();

  /// Coordinates below 10^6 m.
  void Add(const PoseVote& vote);

  /// The means of the cells with most weight, distinct poses, best first. O(votes + size of the
  /// tables); few votes do without the latter
  std::vector<PoseVote> Best(std::size_t most) const;

 private:
  struct Counted {
    PoseVote vote;
    std::uint32_t cell[2];  // of each table
  };
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  template <class Function>
  void ForUsedCells(const Function& function) const;

  std::unique_ptr<std::uint16_t[], Free> table_[2];  // [1/16 nat]
  std::vector<std::uint32_t> used_[2];               // the cells that are not zero
  std::vector<Counted> votes_;
};

}  // namespace sslcd
