// SPDX-License-Identifier: BSD-3-Clause
#include "parameters.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd::ros1 {
namespace {

constexpr double kMostAhead_s = 10;

// Reads parameters one by one and remembers what is wrong.
class Reader {
 public:
  explicit Reader(const ros::NodeHandle& node) : node_(node) {}

  template <typename T>
  bool Read(const std::string& name, T& value) {
    known_.insert(node_.resolveName(name));
    if (!node_.hasParam(name) || node_.getParam(name, value)) return node_.hasParam(name);
    problems_ += "\n~" + name + " has another type";
    return false;
  }
  bool IsText(const std::string& name) const {
    XmlRpc::XmlRpcValue value;
    return node_.getParam(name, value) && value.getType() == XmlRpc::XmlRpcValue::TypeString;
  }
  void AddProblem(const std::string& problem) { problems_ += "\n" + problem; }

  // Throws if there are problems. A parameter that was not read has a wrong name.
  void Finish() {
    std::vector<std::string> names;
    node_.getParamNames(names);
    const std::string mine = node_.getNamespace() + "/";
    for (const std::string& name : names) {
      if (name.compare(0, mine.size(), mine) == 0 && known_.count(name) == 0)
        AddProblem("unknown parameter ~" + name.substr(mine.size()));
    }
    if (!problems_.empty())
      throw Error(ErrorKind::kBadConfig, "the parameters are wrong:" + problems_);
  }

 private:
  const ros::NodeHandle& node_;
  std::set<std::string> known_;
  std::string problems_;
};

// A list of words, or one text with commas, since roscpp takes no lists on the command line.
std::vector<std::string> ReadWords(Reader& reader, const std::string& name) {
  std::vector<std::string> words;
  std::string text;
  if (!reader.IsText(name)) {
    reader.Read(name, words);
  } else if (reader.Read(name, text)) {
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  }
  return words;
}

void ReadLabels(Reader& reader, Parameters& parameters) {
  parameters.labels = ReadWords(reader, "labels");
  const std::vector<std::string> symmetries = ReadWords(reader, "symmetries");
  if (parameters.labels.empty())
    reader.AddProblem("~labels is missing: the names of the classes 0, 1, ...");
  if (symmetries.size() > parameters.labels.size())
    reader.AddProblem("~symmetries is longer than ~labels");
  for (std::size_t i = 0; i < std::min(symmetries.size(), parameters.labels.size()); ++i) {
    const std::optional<Symmetry> symmetry = ParseSymmetry(symmetries[i]);
    if (symmetry)
      parameters.context.labels.Set(parameters.labels[i], {*symmetry});
    else
      reader.AddProblem("~symmetries: '" + symmetries[i] + "' is none of none, pi, full");
  }
}

}  // namespace

Parameters ReadParameters(const ros::NodeHandle& node) {
  Parameters parameters;
  Reader reader(node);
  ros_bridge::BridgeOptions& bridge = parameters.bridge;
  reader.Read("map_frame", parameters.map_frame);
  reader.Read("odom_frame", bridge.odom_frame);
  reader.Read("base_frame", bridge.base_frame);
  reader.Read("camera_frame", bridge.camera_frame);
  reader.Read("body_axes", bridge.body_axes);
  reader.Read("max_gap_s", bridge.max_gap_s);
  reader.Read("min_interval_s", bridge.min_interval_s);
  reader.Read("lost_variance", bridge.lost_variance);
  reader.Read("most_frames", bridge.most_frames);
  reader.Read("publish_tf", parameters.publish_tf);
  reader.Read("tf_ahead_s", parameters.tf_ahead_s);
  reader.Read("map_every_s", parameters.map_every_s);
  if (!(std::abs(parameters.tf_ahead_s) <= kMostAhead_s))
    reader.AddProblem("~tf_ahead_s must be a few seconds at most");
  if (!(parameters.map_every_s >= 0)) reader.AddProblem("~map_every_s must be at least 0");
  ReadLabels(reader, parameters);
  std::string config;
  if (reader.Read("config", config) && !config.empty())
    LoadConfigFile(config, [&](FieldVisitor& v) { DescribeFields(v, parameters.mapper); });
  for (const std::string& problem : Check(bridge)) reader.AddProblem("~" + problem);
  reader.Finish();
  parameters.context.gravity = GravityFrame::FromUp(Vec3::UnitZ());  // REP 103
  return parameters;
}

}  // namespace sslcd::ros1
