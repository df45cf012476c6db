// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sslcd/closing/view_aligner.h"
#include "store/frame_bytes.h"

namespace sslcd {

/// Stands between the mapper and the host's ViewAligner. The answers of the past are repeated, so
/// that no images of earlier sessions are needed; those of the present session are asked of the
/// host, and recorded.
class ViewAnswers {
 public:
  /// From here on, only these answers are given; other pairs have none.
  void Repeat(const std::vector<AlignedView>& views);
  /// From here on, the host is asked about pairs of frames that are numbered from `frame_offset`
  /// on, with its own numbers. Pairs with earlier frames keep the answers of the past.
  void AskHost(ViewAligner host, int frame_offset);

  std::vector<std::optional<RelativePose>> Answer(const std::vector<ViewPair>& pairs);
  /// The answers given since the last call.
  std::vector<AlignedView> TakeRecord() { return std::exchange(record_, {}); }

 private:
  using Key = std::pair<int, int>;
  std::map<Key, std::optional<RelativePose>> past_, repeated_;
  std::vector<AlignedView> record_;
  bool repeats_ = true;
  ViewAligner host_;
  int frame_offset_ = 0;
};

}  // namespace sslcd
