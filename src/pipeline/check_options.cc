// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

struct NamedValue {
  const char* key;
  double value;
};

// Checks `small` <= `large`; `otherwise` describes the consequence.
void CheckOrder(const NamedValue& small, const NamedValue& large, const char* otherwise,
                std::vector<FieldProblem>& problems) {
  if (small.value <= large.value) return;
  std::ostringstream text;
  text << small.key << " is " << small.value << ", must be at most " << large.key << ", which is "
       << large.value << ": " << otherwise;
  problems.push_back({{small.key, large.key}, text.str()});
}

void CheckLoop(const LoopOptions& loop, std::vector<FieldProblem>& problems) {
  CheckOrder({"loop.lag_m", loop.lag_m}, {"loop.layout.local_m", loop.layout.local_m},
             "the query camera would stand before the local map begins", problems);
  CheckOrder({"loop.tracks.look_alike", loop.tracks.look_alike},
             {"loop.acceptance.max_risk", loop.acceptance.max_risk},
             "no pose is ever that certain, so no loop would be accepted", problems);
  const CosineStatistics& looks = loop.match.likelihood.appearance.cosine[Cue::kEmbedding];
  const std::string section = "loop.match.likelihood.appearance.";
  const std::string same = section + "same_side", opposite = section + "opposite_side",
                    other = section + "other_object";
  CheckOrder({opposite.c_str(), looks.opposite_side}, {same.c_str(), looks.same_side},
             "one object looks most like itself from the same side", problems);
  CheckOrder({other.c_str(), looks.other_object}, {opposite.c_str(), looks.opposite_side},
             "objects that look alike would count as different ones", problems);
}

}  // namespace

std::vector<FieldProblem> Check(const Options& options) {
  Options copy = options;  // a visitor needs mutable fields
  std::vector<FieldProblem> problems =
      CheckRanges([&copy](FieldVisitor& visitor) { DescribeFields(visitor, copy); });
  CheckOrder({"filter.min_size_m", options.filter.min_size_m},
             {"filter.max_size_m", options.filter.max_size_m}, "no object would be left", problems);
  CheckOrder({"association.gate_m", options.association.gate_m},
             {"map.search_radius_m", options.map.search_radius_m},
             "landmarks beyond the search radius are never compared", problems);
  CheckLoop(options.loop, problems);
  return problems;
}

}  // namespace sslcd
