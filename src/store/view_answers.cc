// SPDX-License-Identifier: BSD-3-Clause
#include "store/view_answers.h"

#include <algorithm>

namespace sslcd {

void ViewAnswers::Repeat(const std::vector<AlignedView>& views) {
  repeats_ = true;
  repeated_.clear();
  for (const AlignedView& view : views)
    past_[{view.a_frame, view.b_frame}] = repeated_[{view.a_frame, view.b_frame}] = view.T_a_b;
}

void ViewAnswers::AskHost(ViewAligner host, int frame_offset) {
  repeats_ = false;
  host_ = std::move(host);
  frame_offset_ = frame_offset;
}

std::vector<std::optional<RelativePose>> ViewAnswers::Answer(const std::vector<ViewPair>& pairs) {
  std::vector<std::optional<RelativePose>> answers(pairs.size());
  std::vector<ViewPair> asked;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ViewPair& pair = pairs[i];
    if (!repeats_ && host_ && std::min(pair.a_frame, pair.b_frame) >= frame_offset_) {
      asked.push_back(
          {pair.a_frame - frame_offset_, pair.b_frame - frame_offset_, pair.T_a_b_guess});
      places.push_back(i);
      continue;
    }
    const auto& known = repeats_ ? repeated_ : past_;
    if (const auto found = known.find({pair.a_frame, pair.b_frame}); found != known.end())
      answers[i] = found->second;
  }
  if (!asked.empty()) {
    const std::vector<std::optional<RelativePose>> given = host_(asked);
    for (std::size_t k = 0; k < std::min(given.size(), places.size()); ++k)
      answers[places[k]] = given[k];
  }
  if (!repeats_)
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      record_.push_back({pairs[i].a_frame, pairs[i].b_frame, answers[i]});
      past_[{pairs[i].a_frame, pairs[i].b_frame}] = answers[i];
    }
  return answers;
}

}  // namespace sslcd
