// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "closing/pass_map.h"
#include "map/map_state.h"
#include "odometry/resighting.h"

namespace sslcd {

/// Factor on what is learnt in sight, i.e. over 20 m of path: over 100 to 400 m of path the heading
/// of the odometry of poles 00, 02, 05 and of both forests errs by .2 to 2 times as much, that of
/// Victoria Park and of a constant turn rate by more.
inline constexpr double kCaution = 2;

/// Factors on `noise` for this run's odometry, learnt from the objects in sight (see
/// FactorsFromResightings) and from the tilts of the cameras. They are cautious: errors that
/// persist add up to more over a long path than over the path that an object stays in sight.
/// `scale` is metres per odometry metre. The search begins at the factors of `before`.
OdometryFactors LearnOdometryInSight(const MapState& state, const PassMap& passes,
                                     const OdometryNoise& noise, double scale,
                                     const OdometryFactors& before = {});

/// The resightings of all passes: the first sighting of each against later ones, a few metres of
/// path apart. `tilt_factor` is the factor on the noise of tilt.
std::vector<Resighting> ResightingsOf(const MapState& state, const PassMap& passes,
                                      const OdometryNoise& noise, double scale, double tilt_factor);

/// Largest factor on the noise of tilt that the cameras of `frames` allow. The tilt that odometry
/// reports is true tilt plus error, so its mean square is not less than that of the error. Zero for
/// odometry in a plane.
double LargestTiltFactor(const FrameStore& frames, const Vec3& up, const OdometryNoise& noise);

}  // namespace sslcd
