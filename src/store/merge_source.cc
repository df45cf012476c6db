// SPDX-License-Identifier: BSD-3-Clause
#include "store/merge_source.h"

#include <algorithm>
#include <map>
#include <utility>

#include "sslcd/core/error.h"
#include "store/checksums.h"
#include "store/schema.h"
#include "store/site.h"

namespace sslcd {
namespace {

// Answers about pairs of frames, by their numbers in the drive.
using Answers = std::map<std::pair<int, int>, std::optional<RelativePose>>;

Answers AnswersOf(const MergeSource& source, const SessionInfo& session) {
  Answers answers;
  for (const StoredInput& input : source.inputs) {
    if (input.session != session.id || input.kind != InputKind::kRefinement) continue;
    for (const AlignedView& view : RefinementOf(input.content).views)
      if (std::min(view.a_frame, view.b_frame) >= session.frame_offset)
        answers[{view.a_frame - session.frame_offset, view.b_frame - session.frame_offset}] =
            view.T_a_b;
  }
  return answers;
}

}  // namespace

MergeSource ReadMergeSource(const std::string& path) {
  Database database = OpenMap(path, Database::Access::kRead);
  const Transaction one_state(database, Transaction::Kind::kRead);
  MergeSource source{path, ReadInfo(database), {}};
  std::vector<std::string> problems = FileProblems(database, false);
  if (problems.empty())
    problems = ReadInputs(database, source.info.sessions,
                          [&](const StoredInput& input) { source.inputs.push_back(input); });
  if (!problems.empty()) ThrowDamaged(path, problems.front());
  return source;
}

MapperContext ContextOf(const MergeSource& source, const SessionInfo& session) {
  MapperContext context;
  context.gravity = GravityFrame::FromUp(source.info.up_axis);
  context.labels = source.info.labels;
  context.camera = source.info.camera;
  Answers answers = AnswersOf(source, session);
  if (answers.empty()) return context;
  context.view_aligner = [answers = std::move(answers)](const std::vector<ViewPair>& pairs) {
    std::vector<std::optional<RelativePose>> known(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (const auto found = answers.find({pairs[i].a_frame, pairs[i].b_frame});
          found != answers.end())
        known[i] = found->second;
    return known;
  };
  return context;
}

}  // namespace sslcd
