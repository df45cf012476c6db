// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/json_text.h"
#include "report/base64.h"
#include "report/loop_truth.h"
#include "report/palette.h"
#include "report/viewpoint_recall.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;

double Rounded(double value, int decimals) {
  const double unit = std::pow(10, decimals);
  return std::isfinite(value) ? std::round(value * unit) / unit + 0. : 0;
}

std::int64_t Millimetres(double metres) {
  return std::isfinite(metres) ? std::llround(1000 * metres) : 0;
}

class RunJsonMaker {
 public:
  RunJsonMaker(const RunView& run, const ReportLimits& limits) : run_(run), limits_(limits) {
    if (!run.trajectory.poses.empty()) origin_ = run.trajectory.poses[0].translation();
    R_page_world_ = PageAxes(run.gravity);
    const std::size_t frames = run.trajectory.size();
    stride_ = std::max<std::size_t>(1, (frames + limits.poses - 1) / limits.poses);
    for (std::size_t i = 0; i < frames; i += stride_) rows_.push_back(i);
    truth_ = TrueRows(run);
  }

  Json Make(const std::string& name) {
    Json json;
    json["name"] = name;
    json["stride"] = stride_;
    json["metrics"] = run_.metrics_json;
    json["timing"] = run_.timing_json;
    json["config"] = run_.config_yaml;
    json["record"] = Record();
    json["stamps"] = Stamps();
    json["corrected"] = Positions(run_.trajectory);
    json["odometry"] = Positions(run_.odometry);
    json["turns"] = Turns();
    json["truth"] = run_.truth.poses.empty() ? Json() : Truth();
    AddObjects(json);
    json["recall"] = Recall();
    json["images"] = Images();
    json["images_note"] = run_.crops_note;
    json["attempts"] = Attempts();
    json["attempts_left_out"] = run_.loops.size() - std::min(run_.loops.size(), limits_.attempts);
    return json;
  }

 private:
  Vec3 Page(const Vec3& p) const { return R_page_world_ * (p - origin_); }

  void Append(const Vec3& p, Json& list) const {
    const Vec3 page = Page(p);
    for (int axis = 0; axis < 3; ++axis) list.push_back(Millimetres(page[axis]));
  }

  Json Stamps() const {
    Json list = Json::array();
    const double first = run_.trajectory.stamps.empty() ? 0 : run_.trajectory.stamps[0];
    for (const std::size_t i : rows_) list.push_back(Rounded(run_.trajectory.stamps[i] - first, 3));
    return list;
  }

  Json Positions(const Trajectory& trajectory) const {
    Json list = Json::array();
    for (const std::size_t i : rows_)
      if (i < trajectory.size()) Append(trajectory.poses[i].translation(), list);
    return list;
  }

  // Quaternions x y z w of the corrected cameras, with the axes of three.js: y up, z backwards.
  Json Turns() const {
    Json list = Json::array();
    const Eigen::Quaterniond page(R_page_world_), camera(0, 1, 0, 0);
    for (const std::size_t i : rows_) {
      const Eigen::Quaterniond world(run_.trajectory.poses[i].so3().matrix());
      const Eigen::Quaterniond q = page * world * camera;
      for (const double value : {q.x(), q.y(), q.z(), q.w()})
        list.push_back(std::llround(1e4 * value));
    }
    return list;
  }

  Json Truth() const {
    Json list = Json::array();
    for (const std::size_t i : rows_) {
      if (truth_[i] >= 0)
        Append(run_.truth.poses[static_cast<std::size_t>(truth_[i])].translation(), list);
      else
        for (int axis = 0; axis < 3; ++axis) list.push_back(nullptr);
    }
    return list;
  }

  // Each object: id, label, x, y, z, yaw [mrad], length, width, height, observations, first frame.
  void AddObjects(Json& json) const {
    std::vector<MapObject> objects = run_.map.objects;
    const auto first = [](const MapObject& object) {
      int frame = std::numeric_limits<int>::max();
      for (const Observation& seen : object.observations) frame = std::min(frame, seen.frame);
      return object.observations.empty() ? 0 : frame;
    };
    std::stable_sort(objects.begin(), objects.end(),
                     [&](const MapObject& a, const MapObject& b) { return first(a) < first(b); });
    json["objects_left_out"] = objects.size() - std::min(objects.size(), limits_.objects);
    if (objects.size() > limits_.objects) objects.resize(limits_.objects);
    std::map<std::string, std::size_t> labels;
    for (const MapObject& object : objects) labels.emplace(object.label, 0);
    Json& named = json["labels"] = Json::array();
    for (auto& [label, index] : labels) {
      index = named.size();
      named.push_back(
          {{"name", label}, {"round", IsRound(run_, label)}, {"colour", Hex(LabelColour(index))}});
    }
    Json& list = json["objects"] = Json::array();
    for (const MapObject& object : objects) {
      Json row = {object.id.value, labels.at(object.label)};
      Append(object.T_world_object.translation(), row);
      row.push_back(std::llround(1000 * run_.gravity.YawOf(object.T_world_object.so3())));
      for (int axis = 0; axis < 3; ++axis) row.push_back(Millimetres(object.dims[axis]));
      row.push_back(object.observations.size());
      row.push_back(first(object));
      list.push_back(std::move(row));
    }
  }

  Json Recall() const {
    Json list = Json::array();
    for (const ViewpointCounts& bin : ViewpointRecall(run_, truth_))
      list.push_back({bin.revisits, bin.recognised, bin.loops, bin.right});
    return list;
  }

  // The images, each once. Fills `crops_`: pair, image at the query, image at the match; by loop.
  Json Images() {
    Json list = Json::array();
    std::map<std::string, std::size_t> known;
    const auto index = [&](const std::string& bytes) {
      const auto [entry, is_new] = known.emplace(bytes, list.size());
      if (is_new) list.push_back(Base64(bytes));
      return entry->second;
    };
    for (const PairCrops& crops : run_.crops)
      crops_[crops.loop].push_back({crops.pair, index(crops.query_jpeg), index(crops.match_jpeg)});
    return list;
  }

  Json Attempts() const {
    Json list = Json::array();
    const std::size_t every = (run_.loops.size() + limits_.attempts - 1) / limits_.attempts;
    for (std::size_t i = 0; i < run_.loops.size(); i += std::max<std::size_t>(1, every)) {
      const LoopClosure& loop = run_.loops[i];
      Json row;
      row["query"] = loop.query_frame;
      row["match"] = loop.match_frame;
      row["decision"] = ToString(loop.decision);
      row["reason"] = loop.reason;
      row["score"] = Rounded(loop.score, 3);
      row["second"] = Rounded(loop.second_score, 3);
      row["probability"] = loop.probability ? Json(Rounded(*loop.probability, 6)) : Json();
      row["angle"] = Rounded(loop.viewpoint_change_rad * 180 / M_PI, 2);
      const auto error = LoopError(run_, truth_, loop);
      row["error"] = error ? Json(Rounded(*error, 3)) : Json();
      Json& pairs = row["pairs"] = Json::array();
      for (const auto& [local, global] : loop.pairs) {
        pairs.push_back(local.value);
        pairs.push_back(global.value);
      }
      if (const auto crops = crops_.find(i); crops != crops_.end()) row["crops"] = crops->second;
      list.push_back(std::move(row));
    }
    return list;
  }

  Json Record() const {
    if (!run_.record) return {};
    Json json = Json::parse(RunJson(*run_.record));
    json.erase("files");
    return json;
  }

  const RunView& run_;
  ReportLimits limits_;
  Vec3 origin_{0, 0, 0};
  Eigen::Matrix3d R_page_world_;
  std::size_t stride_ = 1;
  std::vector<std::size_t> rows_;      // of the trajectory, those that are shown
  std::vector<int> truth_;             // by row of the trajectory
  std::map<std::size_t, Json> crops_;  // by loop
};

}  // namespace

std::string ReportJson(const std::vector<RunView>& runs, const std::vector<std::string>& names,
                       const ReportLimits& limits) {
  Json root;
  Json& palette = root["viewpoint_colours"] = Json::array();
  constexpr int kSteps = 36;
  for (int i = 0; i <= kSteps; ++i) palette.push_back(Hex(ViewpointColour(M_PI * i / kSteps)));
  root["colours"] = {{"odometry", Hex(kOdometryColour)},
                     {"corrected", Hex(kTrajectoryColour)},
                     {"matched", Hex(kMatchedColour)}};
  Json& list = root["runs"] = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i)
    list.push_back(RunJsonMaker(runs[i], limits).Make(names[i]));
  std::string text;
  for (const char c : JsonText(root, list)) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

}  // namespace sslcd
