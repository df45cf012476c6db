// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/method.h"

#include <algorithm>
#include <utility>

#include "loop/paper_match.h"
#include "sslcd/config/config.h"
#include "sslcd/core/error.h"
#include "sslcd/loop/layout_match.h"

namespace sslcd::benchmark {
namespace {

// Matches two layouts without tracks of earlier attempts.
std::optional<PlaceAnswer> OneLook(const PlaceQuery& query) {
  const LayoutAnswer found = MatchLayouts(query.local, query.global, Options().loop.match);
  if (found.hypotheses.empty()) return std::nullopt;
  PlaceAnswer answer;
  answer.matches = found.hypotheses[0].fit.matches;
  answer.score = found.score;
  answer.accepted = found.decision == LoopDecision::kAccepted;
  return answer;
}

// The paper's two stages. The score is the sum of the similarities. It accepts every match.
std::optional<PlaceAnswer> PaperStages(const PlaceQuery& query) {
  const auto matches = PaperMatch(query.local, query.global, Options().loop.paper);
  if (!matches) return std::nullopt;
  PlaceAnswer answer;
  for (const ObjectMatch& match : *matches) {
    answer.matches.emplace_back(match.local, match.global);
    answer.score += match.similarity;
  }
  answer.accepted = true;
  return answer;
}

template <class Matcher>
std::function<PlaceMatcher(const std::string&)> Always(Matcher matcher) {
  return [matcher](const std::string&) { return PlaceMatcher(matcher); };
}

Method Changed(const std::string& key, const std::string& title,
               const std::vector<std::string>& settings) {
  Method method{key, title, {}};
  ApplySettings(settings, [&](FieldVisitor& visitor) { DescribeFields(visitor, method.options); });
  return method;
}

}  // namespace

std::vector<Method> Methods(const baselines::BaselineOptions& baselines) {
  const Options as_printed = DefaultOptions(Mode::kPaper);
  Method paper_unrefined{"paper_unrefined", "the paper as printed, w/o refinement", as_printed};
  paper_unrefined.options.window.enabled = paper_unrefined.options.refine.enabled = false;
  return {
      {"sslcd", "**sslcd**", {}},
      Changed("unrefined", "sslcd w/o refinement",
              {"window.enabled=false", "refine.enabled=false", "loop.adjust_keyframes=0"}),
      {"one_look", "sslcd's matching of one pair of layouts, no memory", {}, Always(OneLook)},
      Changed("no_loops", "sslcd without loops", {"loop.enabled=false"}),
      {"paper", "the paper as printed", as_printed},
      paper_unrefined,
      {"paper_stages", "the paper's matching", {}, Always(PaperStages)},
      {"lin", "Lin et al. 2021", {}, Always(LinMatcher(baselines.lin))},
      {"x_view", "X-View", {}, Always(XViewMatcher(baselines.x_view))},
      {"histogram",
       "semantic histograms",
       {},
       Always(SemanticHistogramMatcher(baselines.semantic_histogram))},
  };
}

Method AppearanceMethod(const std::string& folder, const baselines::AppearanceOptions& options) {
  Method method = Changed("appearance", "appearance of images (DBoW2, VINS-Fusion)",
                          {"refine.enabled=false", "loop.adjust_keyframes=0"});
  method.from_files = true;
  method.matcher = [folder, options](const std::string& world) {
    return baselines::AppearanceMatcher(folder + "/" + world, options);
  };
  return method;
}

Method PointMatchMethod(const std::string& folder, const baselines::PointMatchOptions& options) {
  Method method{"point_matches", "point matches, mean confidence", {}};
  method.from_files = true;
  method.matcher = [folder, options](const std::string& world) {
    return baselines::PointMatchMatcher(folder + "/" + world + ".txt", options);
  };
  return method;
}

std::vector<Method> Ablations() {
  return {
      {"sslcd", "**sslcd**", {}},
      Changed("no_appearance", "loops by layout alone, no colour, no embedding",
              {"loop.match.likelihood.appearance.limit=0"}),
      Changed("no_tracks", "each attempt by itself, no agreement over time",
              {"loop.tracks.agree_m=0"}),
      Changed("no_prior", "no place looks like another one, so objects alone may decide",
              {"loop.tracks.look_alike=1e-12"}),
      Changed("no_hindsight", "no second look at the end", {"loop.layout.hindsight_m=0"}),
      Changed("no_odometry_learning", "odometry no better or worse than told",
              {"loop.learn_odometry=false"}),
      Changed("no_lag", "loops tie the newest camera", {"loop.lag_m=0"}),
      Changed("trusting", "no loop is ever refused or taken back by the others",
              {"loop.graph.inlier_probability=0.999999", "loop.graph.drift_factor=1000",
               "loop.acceptance.withdraw_m=1000", "loop.acceptance.withdraw_rad=4"}),
      Changed("paper_association", "association as printed (Eqs. 2 to 6)",
              {"association.method=paper"}),
      Changed("paper_adjustment", "bundle adjustment as printed (Eq. 8)", {"ba.residual=paper"}),
      Changed("no_adjustment", "no bundle adjustment after a loop", {"loop.adjust_keyframes=0"}),
      Changed("no_window", "no sliding window", {"window.enabled=false"}),
      Changed("no_refinement", "no refinement at the end, and so no second look",
              {"refine.enabled=false"}),
  };
}

std::vector<Method> Select(const std::vector<Method>& methods,
                           const std::vector<std::string>& keys) {
  if (keys.empty()) return methods;
  std::vector<Method> selected;
  for (const std::string& key : keys) {
    const auto found =
        std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.key == key; });
    if (found == methods.end()) {
      std::string known;
      for (const Method& method : methods) known += (known.empty() ? "" : ", ") + method.key;
      throw Error(ErrorKind::kUsage, "there is no method '" + key + "'; there are: " + known);
    }
    selected.push_back(*found);
  }
  return selected;
}

}  // namespace sslcd::benchmark
