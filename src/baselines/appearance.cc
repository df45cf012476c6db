// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/appearance.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "baselines/image_features.h"
#include "sslcd/core/error.h"
#include "sslcd/datasets/dataset.h"

namespace sslcd::baselines {
namespace {

class Recogniser {
 public:
  Recogniser(const std::string& folder, const AppearanceOptions& options)
      : options_(options), dataset_(Load(folder)), vocabulary_(Train()) {}

  std::optional<PlaceAnswer> Ask(const PlaceQuery& query) {
    for (; next_old_ <= query.old_frame; next_old_ += options_.every)
      if (HasFrame(next_old_))
        old_.insert({next_old_, vocabulary_.Words(FeaturesOf(next_old_).descriptors)});
    if (!HasFrame(query.frame)) return std::nullopt;
    const ImageFeatures features = FeaturesOf(query.frame);
    std::optional<PlaceAnswer> best;
    for (const int frame : Candidates(vocabulary_.Words(features.descriptors))) {
      const auto pose = PoseFromImages(features, FeaturesOf(frame), *dataset_.camera, options_);
      if (!pose || !WithinLimits(pose->T_old_query) || (best && pose->inliers <= best->score))
        continue;
      best = PlaceAnswer();
      best->match_frame = frame;
      best->T_match_query = pose->T_old_query;
      best->score = pose->inliers;
      best->accepted = pose->inliers >= options_.least_inliers;
    }
    return best;
  }

 private:
  static Dataset Load(const std::string& folder) {
    DatasetRequest request;
    request.path = folder;
    request.format = "sequence";
    Dataset dataset = LoadDataset(request);
    if (!dataset.camera || !dataset.camera_right)
      throw Error(ErrorKind::kBadInput, {folder},
                  "needs a calib.txt with P2 and P3 for the appearance baseline");
    if (dataset.frames.empty() || dataset.frames[0].image_left.empty())
      throw Error(ErrorKind::kBadInput, {folder},
                  "has no images in image_2; write them with sslcd_sim halv --render");
    return dataset;
  }

  // Trains on images of the whole sequence. Published systems have a larger vocabulary from other
  // data.
  Vocabulary Train() {
    std::vector<std::vector<BinaryDescriptor>> images;
    const std::size_t step =
        std::max<std::size_t>(1, dataset_.frames.size() / options_.training_images);
    for (std::size_t i = 0; i < dataset_.frames.size(); i += step)
      images.push_back(FeaturesOf(static_cast<int>(i)).descriptors);
    return {images, options_.branching, options_.levels};
  }

  // Old frames by similarity of words; only the best one of neighbouring frames (DBoW2's islands).
  std::vector<int> Candidates(const WordVector& words) const {
    std::vector<std::pair<double, int>> similar;  // best first, on a tie the earlier one
    for (const auto& [frame, other] : old_) {
      const double similarity = Similarity(words, other);
      if (similarity >= options_.least_similarity) similar.push_back({-similarity, frame});
    }
    std::sort(similar.begin(), similar.end());
    std::vector<int> candidates;
    for (const auto& [minus_similarity, frame] : similar) {
      if (static_cast<int>(candidates.size()) == options_.candidates) break;
      if (std::none_of(candidates.begin(), candidates.end(),
                       [&, f = frame](int other) { return std::abs(other - f) < options_.island; }))
        candidates.push_back(frame);
    }
    return candidates;
  }

  bool WithinLimits(const Pose& T_old_query) const {
    return T_old_query.so3().Log().norm() <= options_.max_turn_deg * M_PI / 180 &&
           T_old_query.translation().norm() <= options_.max_apart_m;
  }

  bool HasFrame(int frame) const {
    return frame >= 0 && frame < static_cast<int>(dataset_.frames.size());
  }

  // Cache: about a thousand features of each of some hundred images.
  const ImageFeatures& FeaturesOf(int frame) {
    const auto known = features_.find(frame);
    if (known != features_.end()) return known->second;
    const std::filesystem::path left = dataset_.frames[frame].image_left,
                                right = dataset_.frames[frame].image_right;
    const auto missing = left.parent_path().parent_path() / "image_3" / left.filename();
    const StereoCamera camera = MakeStereoCamera(*dataset_.camera, *dataset_.camera_right);
    ImageFeatures features = ExtractFeatures(
        left.string(), (right.empty() ? missing : right).string(), camera, options_);
    return features_.insert({frame, std::move(features)}).first->second;
  }

  AppearanceOptions options_;
  Dataset dataset_;
  std::map<int, ImageFeatures> features_;
  Vocabulary vocabulary_;
  std::map<int, WordVector> old_;
  int next_old_ = 0;
};

}  // namespace

void DescribeFields(FieldVisitor& visitor, AppearanceOptions& options) {
  visitor.Integer("features", options.features, 10, 100000, "ORB features of an image");
  visitor.Integer("every", options.every, 1, 1000, "old images are kept from every so many frames");
  visitor.Integer("branching", options.branching, 2, 100,
                  "children of a node in the tree of words");
  visitor.Integer("levels", options.levels, 1, 10, "depth of the tree of words");
  visitor.Integer("training_images", options.training_images, 1, 100000,
                  "from which the words are learnt");
  visitor.Real("least_similarity", options.least_similarity, 0, 1, "of the words of two images");
  visitor.Integer("candidates", options.candidates, 1, 1000,
                  "old images whose geometry is checked");
  visitor.Integer("island", options.island, 1, 1000, "so many frames apart, at least");
  visitor.Real("max_depth_m", options.max_depth_m, 1, 1e6, "points further off do not count");
  visitor.Integer("max_distance", options.max_distance, 0, 256,
                  "bits in which matched descriptors differ");
  visitor.Real("ratio", options.ratio, 0, 1,
               "distance of the best match to that of the second best");
  visitor.Real("reprojection_px", options.reprojection_px, 0.1, 100,
               "error of a point that agrees with a pose");
  visitor.Real("search_px", options.search_px, 1, 100,
               "how far from where a pose has them points are searched for");
  visitor.Integer("least_inliers", options.least_inliers, 6, 100000, "points that agree in a loop");
  visitor.Real("max_turn_deg", options.max_turn_deg, 0, 180,
               "a loop turns the camera by no more than this");
  visitor.Real("max_apart_m", options.max_apart_m, 0, 1000, "a loop lies no further off");
}

PlaceMatcher AppearanceMatcher(const std::string& folder, const AppearanceOptions& options) {
  const auto recogniser = std::make_shared<Recogniser>(folder, options);
  return [recogniser](const PlaceQuery& query) { return recogniser->Ask(query); };
}

}  // namespace sslcd::baselines
