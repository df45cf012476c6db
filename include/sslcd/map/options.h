// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sslcd/core/export.h"
#include "sslcd/core/fields.h"
#include "sslcd/core/landmark.h"

namespace SSLCD_EXPORT sslcd {

/// When an object counts as parked, and when as driving.
struct MotionTestOptions {
  double decide_at = 6.;       ///< log Bayes factor at which an object is called driving [nats]
  double min_travel_m = 2.;    ///< an object that has moved less is not called driving
  double min_speed_mps = 0.7;  ///< an object that is slower is not called driving
  double settle_s = 1.5;  ///< a driving object that stops for this time becomes a new parked one

  // No keys: properties of road users and of the models, set by hand without a recorded search.
  double speed_prior_mps = 8.;    ///< standard deviation of an unknown object's speed, per axis
  double acceleration_mps2 = 2.;  ///< standard deviation of a driving object's acceleration
  /// random walk of a parked object's position that camera drift causes
  double wander_m_per_sqrt_s = 0.02;
  /// largest speed of a parked object, including one standard deviation
  double max_parked_speed_mps = 2.;
  /// limit of the absolute log Bayes factor, which a change of state has to overcome [nats]
  double memory = 10.;
  double forget_after_s = 5.;  ///< the test restarts after an object was unseen for longer
};
void DescribeFields(FieldVisitor& visitor, MotionTestOptions& options);

/// Options of the life cycle of landmarks.
struct MapOptions {
  int confirm_sightings = 3;     ///< sightings that confirm a tentative landmark
  double birth_score = 0.5;      ///< a detection with a lower score makes no new landmark
  double stale_after_s = 2.;     ///< a tentative or driving object unseen for longer is dropped
  double search_radius_m = 12.;  ///< radius of the search for a detection's landmark
  /// a landmark that was out of sight for this length of path is only found by loop closure, since
  /// the drift may exceed the distance to its neighbour
  double memory_m = 60.;
  /// learn the detector's noise scale from the scatter of its detections
  bool learn_noise = true;
  MotionTestOptions motion;
};
void DescribeFields(FieldVisitor& visitor, MapOptions& options);

/// The changes of the map by one frame.
struct MapUpdate {
  std::vector<LandmarkId> matched;  ///< landmark of each detection; value -1: none
  /// numbers of new landmarks, and of landmarks that became confirmed or driving
  int born = 0, confirmed = 0, turned_dynamic = 0;
};

}  // namespace sslcd
