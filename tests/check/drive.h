// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "check/cuboid.h"
#include "check/outcome.h"
#include "perception/projection.h"

namespace sslcd::check {

/// A winding drive of 0.7 m steps past parked cars, without noise.
inline Sequence MakeDrive(int frames = 300) {
  Sequence s;
  s.name = "drive";
  s.odometry_path = "odometry.txt";
  s.has_odometry = true;
  s.has_embeddings = true;
  s.camera = Camera{500, 500, 640, 360, Vec3::Zero(), 1280, 720};
  s.labels.Set("Car", {});
  Trajectory truth;
  double heading = 0, x = 0, z = 0;
  for (int i = 0; i < frames; ++i) {
    const double turn = 0.06 * std::sin(i / 12.) + (i % 40 < 10 ? 0.05 : 0),
                 step = 0.5 + 0.4 * std::sin(i / 20.);
    heading += turn;
    x += step * std::sin(heading);
    z += step * std::cos(heading);
    s.poses.push_back(Pose(lie::SO3<double>::RotY(heading), Vec3(x, 0, z)));
    s.stamps.push_back(0.2 * i);
    s.steps.emplace_back();
  }
  s.groundtruth = Trajectory{s.stamps, s.poses};
  std::mt19937 random(5);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.;
  };
  struct Car {
    Vec3 place;
    double heading;
    std::vector<float> look;
  };
  std::vector<Car> cars;
  for (const Pose& pose : s.poses)
    if (cars.size() * 2 < s.poses.size() && random() % 2 == 0) {
      Car car{pose * Vec3(uniform(-12, 12), 1.5, uniform(5, 15)), uniform(-3, 3), {}};
      for (int k = 0; k < 8; ++k) car.look.push_back(static_cast<float>(uniform(-1, 1)));
      cars.push_back(car);
    }
  for (int i = 0; i < frames; ++i)
    for (const Car& car : cars) {
      const Pose& camera = s.poses[static_cast<std::size_t>(i)];
      const Vec3 p = camera.inverse() * car.place;
      if (!(p.z() > 3 && p.z() < 25 && std::abs(p.x()) < p.z())) continue;
      const Vec3 ahead = camera.so3() * Vec3(Vec3::UnitZ());
      Row row;
      row.frame = i;
      row.detection.label = "Car";
      row.detection.score = row.written.score = 0.9;
      WriteCuboid({p, 1.5, 1.7, 4.2, WrapAngle(car.heading - std::atan2(ahead.x(), ahead.z()))},
                  row);
      row.written.alpha = WrapAngle(row.written.rotation_y - Bearing(row.detection));
      row.detection.box = ProjectCuboid(row.detection.T_cam_object, row.detection.dims, *s.camera);
      row.written.box = row.detection.box.value_or(Box2d{-1, -1, -1, -1});
      row.detection.appearance[Cue::kEmbedding] = car.look;
      s.rows.push_back(row);
    }
  s.rows_read = static_cast<int>(s.rows.size());
  return s;
}

/// Changes every cuboid.
template <class F>
void ChangeCuboids(Sequence& s, F change) {
  for (Row& row : s.rows) {
    FileCuboid cuboid = ReadCuboid(row.detection);
    change(cuboid);
    WriteCuboid(cuboid, row);
  }
}

inline std::string IdOf(const Outcome& outcome) {
  return outcome.mistake                                   ? outcome.mistake->id
         : outcome.status == Outcome::Status::kNotTestable ? "not testable"
                                                           : "ok";
}

/// The id, and that of the repaired sequence.
inline std::vector<std::string> BeforeAndAfter(Outcome (*check)(const Sequence&), Sequence s) {
  const Outcome outcome = check(s);
  if (outcome.mistake && outcome.mistake->repair) outcome.mistake->repair(s);
  return {IdOf(outcome), IdOf(check(s))};
}

}  // namespace sslcd::check
