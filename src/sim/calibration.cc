// SPDX-License-Identifier: BSD-3-Clause
#include "sim/calibration.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "eval/iou3d.h"
#include "sim/random.h"
#include "sslcd/core/error.h"
#include "sslcd/eval/trajectory_error.h"

namespace sslcd::sim {
namespace {

struct Mean {
  double sum = 0, squares = 0;
  int count = 0;
  void Add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double value() const { return count > 0 ? sum / count : 0; }
  double sigma() const {
    return count > 0 ? std::sqrt(std::max(0., squares / count - value() * value())) : 0;
  }
};

bool IsParkedCar(const WorldObject& object) {
  return !object.driving() && (object.label == "Car" || object.label == "Van");
}

/// One detection of a car and the bearing of the camera in the car's frame.
struct Sighting {
  const std::vector<float>* embedding;
  double direction;
};

/// All sightings of a sequence's parked cars, by car.
std::vector<std::vector<Sighting>> SightingsOf(const HalvSequence& sequence) {
  const World& world = sequence.scene.world;
  std::map<int, std::vector<Sighting>> by_car;
  for (std::size_t frame = 0; frame < sequence.detections.frames.size(); ++frame) {
    for (const Detection& detection : sequence.detections.frames[frame]) {
      const int id = sequence.detections.identity[detection.row];
      if (id < 0 || !IsParkedCar(world.objects[id])) continue;
      const Vec3 camera =
          world.objects[id].PoseAt(0).inverse() * world.truth.poses[frame].translation();
      by_car[id].push_back(
          {&detection.appearance[Cue::kEmbedding], std::atan2(camera.y(), camera.x())});
    }
  }
  std::vector<std::vector<Sighting>> sightings;
  for (auto& [id, list] : by_car) sightings.push_back(std::move(list));
  return sightings;
}

double Cosine(const Sighting& a, const Sighting& b) {
  double dot = 0;
  for (std::size_t i = 0; i < a.embedding->size(); ++i)
    dot += double((*a.embedding)[i]) * (*b.embedding)[i];
  return dot;
}

template <class T>
const T& Any(Random& random, const std::vector<T>& list) {
  return list[static_cast<std::size_t>(random.Uniform() * static_cast<double>(list.size()))];
}

CosineStats Stats(const Mean& mean) { return {mean.value(), mean.sigma(), mean.count}; }

}  // namespace

bool CalibrationRow::ok() const { return std::abs(reached - target) <= 0.1 * std::abs(target); }

DetectionStats MeasureDetections(const World& world, const SimulatedDetections& detections) {
  Mean iou, flips;
  for (std::size_t frame = 0; frame < detections.frames.size(); ++frame) {
    for (const Detection& detection : detections.frames[frame]) {
      const int id = detections.identity[detection.row];
      if (id < 0 || !IsParkedCar(world.objects[id])) continue;
      const WorldObject& object = world.objects[id];
      const Cuboid seen = ToCuboid(world.truth.poses[frame] * detection.T_cam_object,
                                   detection.dims, world.gravity);
      const Cuboid truth = ToCuboid(object.PoseAt(0), object.dims, world.gravity);
      iou.Add(Iou3d(seen, truth));
      flips.Add(std::abs(WrapAngle(seen.yaw - truth.yaw)) > M_PI / 2);
    }
  }
  return {iou.value(), flips.value()};
}

EmbeddingStats MeasureEmbeddings(const std::vector<HalvSequence>& sequences, int pairs) {
  Random random(1);
  Mean same, opposite, other;
  for (const HalvSequence& sequence : sequences) {
    const std::vector<std::vector<Sighting>> cars = SightingsOf(sequence);
    if (cars.size() < 2) continue;
    const int share = pairs / static_cast<int>(sequences.size());
    // Opposite views are rare, so most drawn pairs are rejected.
    for (int i = 0, opposites = 0, sames = 0;
         i < 100 * share && (opposites < share || sames < share); ++i) {
      const std::vector<Sighting>& car = Any(random, cars);
      const Sighting &a = Any(random, car), &b = Any(random, car);
      const double apart = std::abs(WrapAngle(a.direction - b.direction));
      if (apart < M_PI / 4 && a.embedding != b.embedding && sames++ < share) same.Add(Cosine(a, b));
      if (apart > 3 * M_PI / 4 && opposites++ < share) opposite.Add(Cosine(a, b));
    }
    for (int i = 0; i < share; ++i) {
      const std::vector<Sighting>&first = Any(random, cars), &second = Any(random, cars);
      if (&first != &second) other.Add(Cosine(Any(random, first), Any(random, second)));
    }
  }
  return {Stats(same), Stats(opposite), Stats(other)};
}

std::vector<CalibrationRow> Calibrate(int seeds, HalvOptions options) {
  if (seeds < 1)
    throw Error(ErrorKind::kUsage,
                "seeds is " + std::to_string(seeds) + ": at least one is needed");
  std::vector<CalibrationRow> rows;
  std::vector<HalvSequence> sequences;
  Mean iou, flips;
  for (int number = 1; number <= 4; ++number) {
    options.scene.case_number = number;
    Mean ate;
    for (int seed = 1; seed <= seeds; ++seed) {
      HalvSequence sequence = MakeHalv(seed, options);
      const World& world = sequence.scene.world;
      ate.Add(ComputeAte(sequence.odometry.poses, world.truth.poses, Alignment::kSim3).error.rmse);
      const DetectionStats detections = MeasureDetections(world, sequence.detections);
      iou.Add(detections.iou);
      flips.Add(detections.flips);
      sequences.push_back(std::move(sequence));
    }
    rows.push_back({"case " + std::to_string(number) + ": ATE of the odometry after Sim(3) [m]",
                    HalvAte(number), ate.value()});
  }
  rows.push_back({"mean 3D IoU of single detections of cars and vans", 0.45, iou.value()});
  rows.push_back({"share of them that take front for back", 0.03, flips.value()});
  const EmbeddingStats cosines = MeasureEmbeddings(sequences, 60000);
  rows.push_back({"cosine of embeddings, same car, same side: mean", 0.75, cosines.same_side.mean});
  rows.push_back({"... standard deviation", 0.10, cosines.same_side.sigma});
  rows.push_back({"cosine, same car, opposite side: mean", 0.45, cosines.opposite_side.mean});
  rows.push_back({"... standard deviation", 0.12, cosines.opposite_side.sigma});
  rows.push_back({"cosine, different cars: mean", 0.30, cosines.other_object.mean});
  rows.push_back({"... standard deviation", 0.12, cosines.other_object.sigma});
  return rows;
}

std::string ToMarkdown(const std::vector<CalibrationRow>& rows) {
  std::string text = "| what | target | reached | within 10 % |\n|---|---|---|---|\n";
  for (const CalibrationRow& row : rows) {
    char line[256];
    std::snprintf(line, sizeof line, "| %s | %.3f | %.3f | %s |\n", row.what.c_str(), row.target,
                  row.reached, row.ok() ? "yes" : "no");
    text += line;
  }
  return text;
}

}  // namespace sslcd::sim
