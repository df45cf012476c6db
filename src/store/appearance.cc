// SPDX-License-Identifier: BSD-3-Clause
#include "store/appearance.h"

#include <cmath>
#include <map>
#include <utility>

#include "store/bytes.h"
#include "store/frame_bytes.h"
#include "store/journal.h"
#include "store/site.h"

namespace sslcd {
namespace {

struct VectorSum {
  std::vector<double> sum;
  int count = 0;

  void Add(const std::vector<float>& vector) {
    if (vector.empty()) return;
    if (sum.empty()) sum.resize(vector.size());
    for (std::size_t i = 0; i < vector.size(); ++i) sum[i] += vector[i];
    ++count;
  }

  // Unit vectors that cancel have no mean.
  bool HasMean() const { return count > 0 && Length() > 0; }
  double Length() const {
    double squares = 0;
    for (const double value : sum) squares += value * value;
    return std::sqrt(squares);
  }
  std::string MeanBytes() const {
    const double length = Length();
    ByteWriter bytes;
    for (const double value : sum) bytes.Float(static_cast<float>(value / length));
    return bytes.Take();
  }
};

// Sightings by frame of the map and row of the detection.
using LandmarkOfSighting = std::map<std::pair<int, int>, int>;

LandmarkOfSighting ConfirmedSightings(const std::vector<MapObject>& objects) {
  LandmarkOfSighting landmarks;
  for (const MapObject& object : objects)
    if (object.state == LandmarkState::kConfirmed)
      for (const Observation& seen : object.observations)
        landmarks[{seen.frame, seen.detection_row}] = object.id.value;
  return landmarks;
}

}  // namespace

void ForEachSighting(Database& database, const std::vector<MapObject>& objects,
                     const std::vector<SessionInfo>& sessions,
                     const std::function<void(int, const Detection&)>& take) {
  const LandmarkOfSighting landmarks = ConfirmedSightings(objects);
  std::map<int, SessionInfo> session;
  for (const SessionInfo& one : sessions) session[one.id] = one;
  ReadInputs(database, sessions, [&](const StoredInput& input) {
    if (input.kind != InputKind::kFrame) return;
    const Frame frame = FrameIn(input, database.path());
    const int number = NumberInMap(frame.index, session[input.session], database.path());
    for (const Detection& detection : frame.detections) {
      const auto found = landmarks.find({number, detection.row});
      if (found != landmarks.end()) take(found->second, detection);
    }
  });
}

void WriteAppearance(Database& database, const std::vector<MapObject>& objects,
                     const std::vector<SessionInfo>& sessions) {
  std::map<int, PerCue<VectorSum>> sums;
  ForEachSighting(database, objects, sessions, [&sums](int landmark, const Detection& seen) {
    for (const CueRow& row : kCueRows) sums[landmark][row.cue].Add(seen.appearance[row.cue]);
  });
  Statement insert(database, "INSERT INTO appearance VALUES (?, ?, ?, ?)");
  for (const auto& [landmark, by_cue] : sums)
    for (const CueRow& row : kCueRows)
      if (const VectorSum& sum = by_cue[row.cue]; sum.HasMean())
        insert.Bind(landmark).BindText(row.name).Bind(sum.count).BindBlob(sum.MeanBytes()).Run();
}

}  // namespace sslcd
