// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/pose.h"

namespace SSLCD_EXPORT sslcd {

/// What one session tells of a place.
struct SessionEvidence {
  int seen = 0;            ///< frames with a detection
  double expected = 0;     ///< frames that should have one if an object was there, on average
  double probability = 0;  ///< that an object was there, by all sessions
  /// Whether the session has looked there: something was seen, or should have been.
  bool InView() const { return seen > 0 || expected >= 1; }
};

/// A place where an object has stood in some session: landmarks of a map that are too close to be
/// two objects at one time.
struct PlaceHistory {
  std::vector<LandmarkId> landmarks;      ///< that with most sightings first
  std::string label;                      ///< of the first landmark
  Pose T_world_object;                    ///< of the first landmark
  Vec3 dims{0, 0, 0};                     ///< of the first landmark [m]
  int map = 0;                            ///< MapPart::joined_with
  std::vector<SessionEvidence> sessions;  ///< of each session of the map
};

/// How often the places of a label change from one session to the next.
struct ChangeRates {
  double departure = 0;  ///< that an object leaves
  double replaced = 0;   ///< that another one stands there in the next session, if it has left
  double arrival = 0;    ///< that an object comes to an empty place
};

/// What became of a place between two sessions: probabilities, of sum 1.
struct PlaceOutcome {
  double stayed = 0;    ///< the same object is there
  double departed = 0;  ///< an object was there, and none is
  double replaced = 0;  ///< another object is there
  double arrived = 0;   ///< none was there, and one is
  double empty = 0;     ///< none was there, and none is

  double Departure() const { return departed + replaced; }  ///< the object there has gone
  double Arrival() const { return arrived + replaced; }     ///< another object has come
};

/// What was there when, in each session of a map (docs/change.md). Cheap to copy.
class MapHistory {
 public:
  struct Impl;
  explicit MapHistory(std::shared_ptr<const Impl> impl);

  const std::vector<PlaceHistory>& places() const;
  const std::map<std::string, ChangeRates>& rates() const;  ///< learnt, by label

  /// What became of places()[place] between two sessions, by their numbers in
  /// PlaceHistory::sessions, `from` before `to`. O(to - from)
  PlaceOutcome Between(int place, int from, int to) const;

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace sslcd
