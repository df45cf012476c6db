// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>
#include <vector>

#include "script.h"
#include "sslcd/core/error.h"
#include "sslcd/pipeline/async_mapper.h"
#include "sslcd/pipeline/localiser.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"
#include "targets.h"

namespace sslcd::fuzz {
namespace {

constexpr int kMostFrames = 36, kMostRefinements = 1;
constexpr double kSight = 11;  // few objects a frame, enough for loops [m]

Pose UprightAt(double x, double z, double heading) {  // y points down
  return Pose(lie::SO3<double>::Exp(Vec3(0, heading, 0)), Vec3(x, 0, z));
}

// A vehicle that drives over a lot where an object stands every few metres.
class Vehicle {
 public:
  Frame Next(double step, double turn, Script& script) {
    heading_ += turn;
    x_ += step * std::sin(heading_);
    z_ += step * std::cos(heading_);
    Frame frame;
    frame.index = index_++;
    frame.stamp = 0.1 * frame.index;
    frame.T_odom_cam = UprightAt(x_, z_, heading_);
    const bool vectors = script.Choice(2) == 1;
    for (int object = 0; object < 64; ++object) Add(object, vectors, frame);
    return frame;
  }

  /// Numbers of any kind in place of those of a drive.
  Frame Any(Script& script) {
    Frame frame;
    frame.index = index_ += static_cast<int>(script.Share() * 3);
    ++index_;
    frame.stamp = script.Real();
    frame.T_odom_cam =
        Pose(lie::SO3<double>::Exp(Vec3(script.Real(), script.Real(), script.Real())),
             Vec3(script.Real(), script.Real(), script.Real()));
    if (script.Choice(2) == 1)
      frame.step = StepUncertainty{script.Choice(2) == 1, script.Real(), script.Real()};
    const unsigned count = script.Choice(4);
    for (unsigned i = 0; i < count; ++i) frame.detections.push_back(AnyDetection(script));
    return frame;
  }

 private:
  static Detection AnyDetection(Script& script) {
    Detection detection;
    detection.label = std::string(script.Choice(3), static_cast<char>(script.Byte()));
    detection.score = script.Real();
    detection.T_cam_object = UprightAt(script.Real(), script.Real(), script.Real());
    detection.dims = Vec3(script.Real(), script.Real(), script.Real());
    if (script.Choice(2) == 1)
      detection.box = Box2d{script.Real(), script.Real(), script.Real(), script.Real()};
    for (const Cue cue : {Cue::kColour, Cue::kEmbedding})
      for (unsigned i = script.Choice(4); i > 0; --i)
        detection.appearance[cue].push_back(static_cast<float>(script.Real()));
    return detection;
  }

  void Add(int object, bool vectors, Frame& frame) const {
    // 8 m apart, moved by a pattern without period
    const double x = 8 * (object % 8 - 4) + 2 * std::sin(3. * object),
                 z = 8 * (object / 8 - 1) + 2 * std::cos(5. * object);
    const Pose T_cam_object =
        frame.T_odom_cam.inverse() * UprightAt(x, z, 0.1 * object * (object % 3));
    const Vec3 seen = T_cam_object.translation();
    if (!(seen.z() > 1 && seen.norm() < kSight)) return;
    Detection detection;
    detection.label = object % 5 == 0 ? "Pole" : "Car";
    detection.row = static_cast<int>(frame.detections.size());
    detection.T_cam_object = T_cam_object;
    detection.dims = Vec3(4, 1.8, 1.5);
    if (vectors)
      detection.appearance[Cue::kEmbedding] = {std::sin(1.F * object), std::cos(1.F * object)};
    frame.detections.push_back(detection);
  }

  int index_ = 0;
  double x_ = 0, z_ = 0, heading_ = 0;
};

MapperContext Context() {
  MapperContext context;
  context.labels.Set("Pole", {Symmetry::kFull});
  return context;
}

void Require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

// All questions that a mapper answers, and what holds of the answers.
void Ask(Mapper mapper, std::size_t frames) {
  const Trajectory trajectory = mapper.CameraTrajectory();
  Require(trajectory.size() == frames && trajectory.stamps.size() == frames, "a pose per frame");
  for (const Pose& pose : trajectory.poses)
    Require(pose.translation().allFinite() && pose.so3().matrix().allFinite(), "finite poses");
  for (const MapObject& object : mapper.Objects())
    Require(mapper.Current(object.id) == object.id, "an object has its own id");
  const LoopSearchSummary summary = mapper.SummariseLoopSearch();
  Require(summary.accepted >= 0 && !summary.Text().empty(), "a summary");
  Require(mapper.LoopClosures().size() >= static_cast<std::size_t>(summary.accepted), "loops");
  Require(std::isfinite(mapper.scale()) && mapper.scale() > 0, "a scale");
  const PoseGraph graph = mapper.Graph();
  for (const MapPart& part : mapper.Parts()) Require(part.joined_with >= 0, "parts");
  mapper.noise_scale();
  mapper.improvement();
  mapper.TakeChanges();
}

// Calls of a mapper. An Error leaves it as it was.
class Calls {
 public:
  explicit Calls(std::string bytes) : script_(std::move(bytes)) {}

  void RunOn(Mapper mapper) {
    while (!script_.AtEnd() && frames_ < kMostFrames) {
      switch (script_.Choice(8)) {
        case 0: mapper.StartSequence(); break;
        case 1:
          if (refinements_++ < kMostRefinements) mapper.Refine(When());
          break;
        case 2: CatchUp(mapper); break;
        case 3: Try(mapper, vehicle_.Any(script_)); break;
        case 4: Ask(mapper, accepted_); break;
        default: Drive(mapper);
      }
    }
    Ask(mapper, accepted_);
  }

  void RunOn(AsyncMapper& mapper) {
    while (!script_.AtEnd() && frames_ < kMostFrames) {
      switch (script_.Choice(8)) {
        case 0: mapper.StartSequence(); break;
        case 1:
          if (refinements_++ < kMostRefinements) mapper.Refine(When());
          break;
        case 2: accepted_ += static_cast<std::size_t>(mapper.TakeReport().frames); break;
        case 3: mapper.AddFrame(vehicle_.Any(script_)), ++frames_; break;
        case 4: mapper.WaitFor(0.001); break;
        default: mapper.AddFrame(NextFrame());
      }
    }
    std::future<Mapper> snapshot = mapper.Snapshot();
    mapper.Wait();
    const AsyncReport report = mapper.TakeReport();
    Require(report.failure.empty(), report.failure.c_str());
    Ask(snapshot.get(), accepted_ + static_cast<std::size_t>(report.frames));
  }

 private:
  Refinement When() { return script_.Choice(2) == 0 ? Refinement::kAtEnd : Refinement::kOnTheWay; }

  Frame NextFrame() {
    ++frames_;
    const double step = 2 + 2 * script_.Share(), turn = 0.5 * script_.Share();
    return vehicle_.Next(step, turn, script_);
  }

  bool Try(Mapper& mapper, const Frame& frame) {
    ++frames_;
    try {
      const FrameReport report = mapper.AddFrame(frame);
      ++accepted_;
      return true;
    } catch (const Error&) {
      return false;
    }
  }

  // A few frames of the same step and turn.
  void Drive(Mapper& mapper) {
    const double step = 2 + 2 * script_.Share(), turn = 0.5 * script_.Share();
    const unsigned count = script_.Choice(24);
    for (unsigned i = 0; i < count && frames_ < kMostFrames; ++i)
      Try(mapper, vehicle_.Next(step, turn, script_));
  }

  // A copy is refined while the original goes on, and then follows.
  void CatchUp(Mapper& mapper) {
    Mapper copy = mapper;
    std::vector<AddedFrame> since;
    bool starts = script_.Choice(4) == 0;
    if (starts) mapper.StartSequence();
    for (unsigned i = script_.Choice(8); i > 0; --i) {
      const Frame frame = NextFrame();
      if (!Try(mapper, frame)) continue;
      since.push_back({frame, starts});
      starts = false;
    }
    if (refinements_++ < kMostRefinements) copy.Refine(When());
    copy.CatchUp(mapper, since);
    if (starts) copy.StartSequence();
    mapper = copy;
  }

  Script script_;
  Vehicle vehicle_;
  int frames_ = 0, refinements_ = 0;
  std::size_t accepted_ = 0;
};

Options OptionsOf(const std::string& bytes) {
  const unsigned char first = bytes.empty() ? 0 : static_cast<unsigned char>(bytes[0]);
  Options options = DefaultOptions(bytes.empty() || first % 8 != 0 ? Mode::kRobust : Mode::kPaper);
  // Searching, adjusting and learning take most of the time: seldom, or not in all drives.
  options.loop.layout.every_m = 10;
  options.window.enabled = (first & 8) != 0;
  options.window.keyframes = 4;
  if ((first & 16) == 0) {
    options.loop.adjust_keyframes = 0;
    options.loop.learn_odometry = false;
  }
  return options;
}

}  // namespace

Targets Programs() {
  return {
      {"mapper",
       [](const std::string& bytes) { Calls(bytes).RunOn(Mapper(OptionsOf(bytes), Context())); }},
      {"async_mapper",
       [](const std::string& bytes) {
         AsyncMapper mapper(OptionsOf(bytes), Context(), 4, 5);
         Calls(bytes).RunOn(mapper);
       }},
  };
}

}  // namespace sslcd::fuzz
