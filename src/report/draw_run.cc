// SPDX-License-Identifier: BSD-3-Clause
#include "report/draw_run.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/ground_plan.h"
#include "report/legend.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

constexpr double kGap = 20;              // between two maps [px]
constexpr double kThinnest = .4;         // what a line leaves out [px]
constexpr std::size_t kManyLoops = 100;  // from here on thin lines
constexpr double kViewRange = 26;        // of a camera's sector [m]
constexpr double kViewHalfAngle = 40 * M_PI / 180;

std::vector<LoopClosure> ChosenLoops(const RunView& run, const DrawOptions& options) {
  const std::vector<LoopClosure> all = AcceptedLoops(run);
  if (options.loop) {
    for (const LoopClosure& loop : all)
      if (loop.query_frame == *options.loop) return {loop};
    throw Error(ErrorKind::kUsage, "no accepted loop of " + run.folder + " has the query frame " +
                                       std::to_string(*options.loop) + ": see its loops.csv");
  }
  const std::size_t count = std::min(
      all.size(), options.max_loops ? static_cast<std::size_t>(*options.max_loops) : all.size());
  std::vector<LoopClosure> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  return chosen;
}

class RunPainter {
 public:
  RunPainter(const RunView& run, const DrawOptions& options)
      : run_(run),
        loops_(ChosenLoops(run, options)),
        one_loop_(options.loop.has_value()),
        label_colours_(LabelColours(run)) {
    if (one_loop_)
      for (const auto& [local, global] : loops_[0].pairs) matched_.insert(global);
  }

  const std::vector<LoopClosure>& loops() const { return loops_; }
  const std::map<std::string, Colour>& label_colours() const { return label_colours_; }

  std::vector<Vec2> Extent() const {
    std::vector<Vec2> points;
    for (const Trajectory* path : {&run_.odometry, &run_.trajectory, &run_.truth})
      for (const Vec2& p : PathFromAbove(*path, run_.gravity)) points.push_back(p);
    for (const MapObject& object : run_.map.objects)
      for (const Vec2& p : Footprint(object, run_.gravity)) points.push_back(p);
    return points;
  }

  void Objects(const GroundPlan& plan, double left, Drawing& page) const {
    for (const MapObject& object : run_.map.objects) {
      Pen pen;
      pen.fill = matched_.count(object.id) > 0 ? kMatchedColour : label_colours_.at(object.label);
      if (one_loop_ && matched_.count(object.id) == 0) pen.opacity = .35;
      pen.stroke = Colour{90, 90, 90};
      pen.width = .5;
      const std::vector<Vec2> corners = At(plan(Footprint(object, run_.gravity)), left);
      if (IsRound(run_, object.label)) {
        const double radius = .25 * (object.dims.x() + object.dims.y()) * plan.scale();
        page.Circle((corners[0] + corners[2]) / 2, std::max(1.5, radius), pen);
      } else {
        page.Polygon(corners, pen);
      }
    }
  }

  void Path(const Trajectory& trajectory, Colour colour, bool dashed, const GroundPlan& plan,
            double left, Drawing& page) const {
    Pen pen;
    pen.stroke = colour;
    pen.width = dashed ? 1.2 : 1.6;
    pen.dashed = dashed;
    const auto path = At(plan(PathFromAbove(trajectory, run_.gravity)), left);
    if (!path.empty()) page.Line(Thinned(path, kThinnest), pen);
  }

  void Loops(const Trajectory& trajectory, const GroundPlan& plan, double left,
             Drawing& page) const {
    const auto path = At(plan(PathFromAbove(trajectory, run_.gravity)), left);
    for (const LoopClosure& loop : loops_) {
      Pen line, dot;
      line.stroke = dot.fill = ViewpointColour(loop.viewpoint_change_rad);
      line.width = loops_.size() > kManyLoops ? .7 : 1.4;
      const Vec2 query = path.at(static_cast<std::size_t>(loop.query_frame)),
                 match = path.at(static_cast<std::size_t>(loop.match_frame));
      page.Line({match, query}, line);
      for (const Vec2& end : {match, query}) page.Circle(end, 1.8, dot);
    }
  }

  // The camera of a frame with its viewing direction.
  void Camera(int frame, Colour colour, const GroundPlan& plan, double left, Drawing& page) const {
    const Pose& pose = run_.trajectory.poses.at(static_cast<std::size_t>(frame));
    const Vec2 at = FromAbove(pose.translation(), run_.gravity),
               ahead = FromAbove(pose.so3() * Vec3(0, 0, 1), run_.gravity);
    const double heading = std::atan2(ahead.y(), ahead.x());
    std::vector<Vec2> sector = {at};
    for (int k = -8; k <= 8; ++k) {
      const double angle = heading + kViewHalfAngle * k / 8;
      sector.push_back(at + kViewRange * Vec2(std::cos(angle), std::sin(angle)));
    }
    Pen pen;
    pen.stroke = pen.fill = colour;
    pen.opacity = .18;
    page.Polygon(At(plan(sector), left), pen);
    Pen dot;
    dot.fill = colour;
    page.Circle(At(plan(std::vector<Vec2>{at}), left)[0], 5, dot);
  }

 private:
  static std::vector<Vec2> At(std::vector<Vec2> points, double left) {
    for (Vec2& p : points) p.x() += left;
    return points;
  }

  const RunView& run_;
  std::vector<LoopClosure> loops_;
  bool one_loop_;
  std::map<std::string, Colour> label_colours_;
  std::set<LandmarkId> matched_;
};

}  // namespace

Drawing DrawRun(const RunView& run, const DrawOptions& options) {
  RequirePoses(run);
  const RunPainter painter(run, options);
  const double maps = options.before_after ? 2 : 1;
  const GroundPlan plan(painter.Extent(), (options.width - kGap * (maps - 1)) / maps);
  Drawing page;
  page.width = options.width;
  const double left = options.before_after ? (options.width + kGap) / 2 : 0;
  painter.Path(run.odometry, kOdometryColour, false, plan, 0, page);
  if (options.before_after) painter.Loops(run.odometry, plan, 0, page);
  painter.Objects(plan, left, page);
  if (options.loop) {
    painter.Camera(painter.loops()[0].match_frame, kTrajectoryColour, plan, left, page);
    painter.Camera(painter.loops()[0].query_frame, kOdometryColour, plan, left, page);
  }
  painter.Path(run.trajectory, kTrajectoryColour, false, plan, left, page);
  painter.Path(run.truth, kTruthColour, true, plan, left, page);
  if (!options.loop) painter.Loops(run.trajectory, plan, left, page);

  Legend legend;
  legend.labels = painter.label_colours();
  legend.truth = !run.truth.poses.empty();
  legend.loops = painter.loops();
  legend.all_loops = AcceptedLoops(run).size();
  legend.one_loop = options.loop.has_value();
  legend.scale = plan.scale();
  page.height =
      static_cast<int>(std::ceil(plan.height() + DrawLegend(legend, plan.height(), page)));
  return page;
}

}  // namespace sslcd
