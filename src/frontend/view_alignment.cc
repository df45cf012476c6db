// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/frontend/stereo_files.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/for_each.h"
#include "sslcd/core/error.h"
#include "sslcd/core/log.h"
#include "sslcd/ground/ground_alignment.h"

namespace sslcd {
namespace {

/// AlignGround of two frames, read from their files. None: they cannot be aligned; `problem` gets
/// the defect of the images.
std::optional<RelativePose> Align(const ViewPair& pair, const StereoFiles& files,
                                  const StereoCamera& camera, const VisionOptions& vision,
                                  std::string& problem) {
  const auto& a = files.paths.at(static_cast<std::size_t>(pair.a_frame));
  const auto& b = files.paths.at(static_cast<std::size_t>(pair.b_frame));
  Image images[4];
  const std::string* const paths[] = {&a.first, &a.second, &b.first, &b.second};
  const auto complain = [&](const std::string& file, const std::string& what) {
    problem = file + ": not aligned with images of other passes: " + what;
    return std::nullopt;
  };
  for (int i = 0; i < 4; ++i) {
    if (files.stopped() || paths[i]->empty()) return std::nullopt;
    images[i] = files.load(*paths[i]);
    if (images[i].empty()) return complain(*paths[i], "it cannot be read");
  }
  try {
    return AlignGround({images[0].view(), images[1].view()}, {images[2].view(), images[3].view()},
                       camera, pair.T_a_b_guess, vision.lift.ground, vision.alignment);
  } catch (const Error& error) {  // other pairs may succeed
    return complain(a.first + ", " + b.first, error.what());
  }
}

}  // namespace

ViewAligner MakeGroundAligner(StereoFiles files, const StereoCamera& camera,
                              const VisionOptions& vision, GroundAlignerOptions options) {
  return [=, files = std::move(files),
          options = std::move(options)](const std::vector<ViewPair>& pairs) {
    std::vector<std::optional<RelativePose>> answers(pairs.size());
    std::vector<std::string> problems(pairs.size());
    try {
      StereoCamera used = camera;
      if (options.check_rig)
        used.disparity_at_infinity = CheckRig(files, camera, vision.odometry).disparity_at_infinity;
      ForEach(
          pairs.size(), options.threads,
          [&](std::size_t i) { answers[i] = Align(pairs[i], files, used, vision, problems[i]); },
          options.progress);
    } catch (const Error& error) {  // must not lose the results of the run
      problems.push_back(std::string("images of different passes are not aligned: ") +
                         error.what());
    }
    // Warns once, since the defect may concern all images.
    const auto first = std::find_if(problems.begin(), problems.end(),
                                    [](const std::string& p) { return !p.empty(); });
    if (first != problems.end()) Log(LogLevel::kWarning, *first);
    return answers;
  };
}

}  // namespace sslcd
