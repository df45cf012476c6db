// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/mapper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "closing/loop_closer.h"
#include "closing/loop_finder.h"
#include "closing/parts.h"
#include "closing/remeasure.h"
#include "closing/view_ties.h"
#include "core/frame_store.h"
#include "core/turning_axis.h"
#include "odometry/odometry_edge.h"
#include "pipeline/canonical_input.h"
#include "pipeline/change_reporter.h"
#include "pipeline/check_input.h"
#include "pipeline/corrected_odometry.h"
#include "pipeline/final_trajectory.h"
#include "pipeline/sliding_window.h"
#include "refine/refine_map.h"
#include "sslcd/core/error.h"
#include "sslcd/core/timing.h"
#include "sslcd/pipeline/options.h"

namespace sslcd {
namespace {

// The averaging of a landmark's views: by viewpoint, or all together as in the paper.
Gallery::Mode GalleryMode(const AssociationOptions& association) {
  return association.method == AssociationOptions::Method::kPaper ? Gallery::Mode::kMean
                                                                  : Gallery::Mode::kByViewpoint;
}

WholeMapOptions WholeMap(const Options& options) {
  return {options.noise, options.map, options.level, options.ba, options.refine};
}

const Options& Checked(const Options& options) {
  const std::vector<FieldProblem> problems = Check(options);
  if (!problems.empty()) throw Error(ErrorKind::kBadConfig, ToString(problems));
  return options;
}

const MapperContext& Checked(const MapperContext& context) {
  CheckContext(context);
  return context;
}

// Time between two sequences, in which all that moves is forgotten. [s]
double TimeBetweenSequences(const MapOptions& map) {
  return 1 + std::max(map.stale_after_s, map.motion.forget_after_s);
}

// Nothing that associates or compares objects along the path reaches over half of it.
double PathOfLostStep(const Options& options) {
  const LoopLayoutOptions& layout = options.loop.layout;
  return 2 * std::max({options.map.memory_m, layout.local_m, layout.hindsight_m, layout.split_m,
                       options.loop.tracks.agree_m});
}

// The store keeps detections without appearance, which passes and landmarks keep.
std::vector<Detection> WithoutAppearance(std::vector<Detection> detections) {
  for (Detection& detection : detections) detection.appearance = {};
  return detections;
}

}  // namespace

struct SSLCD_HIDDEN Mapper::Impl {
  Impl(const Options& all, const MapperContext& world, std::unique_ptr<LoopFinder> finder)
      : options(all),
        context(world),
        state{ObjectMap(GravityFrame(), world.labels, all.noise, all.association, all.map),
              FrameStore(PathOfLostStep(all))},
        odometry(state.gravity(), all.level),
        window(all.window, all.ba, all.noise),
        loops(all.loop, WholeMap(all), GalleryMode(all.association), std::move(finder)) {}

  const Camera* camera() const { return context.camera ? &*context.camera : nullptr; }
  double scale() const { return std::exp(log_scale); }
  Pose ToHost(const Pose& T_start_any) const { return T_start_odom.inverse() * T_start_any; }
  StepUncertainty BeginSequence(const Frame& frame);
  void LearnFromLoops(WholeMapOptions& whole_map, LoopEvidence& evidence);
  BaSummary Adjust(WholeMapOptions& whole_map, LoopEvidence& evidence);

  Options options;
  MapperContext context;
  Pose T_start_odom;  // from the host's world to that of `state`, see StartOf
  MapState state;
  CorrectedOdometry odometry;
  SlidingWindow window;
  LoopCloser loops;
  double log_scale = 0;
  double refined_log_scale = 0;  // result of the last refinement
  std::vector<ViewTie> view_ties;
  ImprovementProbability improvement;  // by the last refinement, until the next frame
  ChangeReporter reporter;
  bool starts_sequence = false;  // with the next frame
  int sequence = 0;              // of the newest frame
  double first_stamp = 0;        // of this sequence: as odometry gave it, and in the store [s]
  double first_stored_stamp = 0;
  TimingTable timing;
};

Mapper::Mapper(const Options& options, const MapperContext& context)
    : Mapper(options, context, MakeFinder(Checked(options).loop, context.place_matcher)) {}
Mapper::Mapper(const Options& options, const MapperContext& context,
               std::unique_ptr<LoopFinder> finder)
    : impl_(std::make_unique<Impl>(Checked(options), Checked(context), std::move(finder))) {}
Mapper::~Mapper() = default;
Mapper::Mapper(const Mapper& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Mapper& Mapper::operator=(const Mapper& other) { return *this = Mapper(other); }
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

double Mapper::scale() const { return impl_->scale(); }
ImprovementProbability Mapper::improvement() const { return impl_->improvement; }
const GravityFrame& Mapper::gravity() const { return impl_->context.gravity; }
NoiseScale Mapper::noise_scale() const { return impl_->state.map.noise_scale(); }
const std::vector<ViewTie>& Mapper::view_ties() const { return impl_->view_ties; }
TimingTable& Mapper::timing() { return impl_->timing; }
std::vector<LoopClosure> Mapper::LoopClosures() const { return impl_->loops.ledger().Rows(); }
std::optional<LandmarkId> Mapper::Current(LandmarkId id) const {
  return impl_->state.map.Current(id);
}
std::vector<MapPart> Mapper::Parts() const {
  return ListParts(impl_->state.frames, impl_->loops.ledger());
}
void Mapper::StartSequence() { impl_->starts_sequence = true; }

// Before the first frame of a sequence other than the first: stamps go on over all sequences, its
// odometry is upright again. Returns the step to it.
StepUncertainty Mapper::Impl::BeginSequence(const Frame& frame) {
  first_stored_stamp = state.frames.back().stamp + TimeBetweenSequences(options.map);
  first_stamp = frame.stamp;
  odometry.StartSequence();
  ++sequence;
  return StepUncertainty{true};
}

FrameReport Mapper::AddFrame(const Frame& frame) {
  Impl& m = *impl_;
  FrameStore& frames = m.state.frames;
  CheckFrame(frame, frames, m.starts_sequence);
  m.improvement = {};
  FrameReport report;
  std::optional<StepUncertainty> step = frame.step;
  const bool begins = std::exchange(m.starts_sequence, false) && !frames.empty();
  if (begins) step = m.BeginSequence(frame);
  if (frames.empty()) m.T_start_odom = StartOf(frame.T_odom_cam, m.context.gravity);
  if (frames.empty()) m.first_stamp = frame.stamp;
  FrameRecord record;
  record.T_input_cam = m.T_start_odom * frame.T_odom_cam;
  const Pose T_odom_cam = m.odometry.Correct(record.T_input_cam);
  const Pose T_world_cam = frames.empty() ? T_odom_cam
                           : begins       ? PlaceBeside(m.state, T_odom_cam)
                                          : PredictPose(frames.back(), T_odom_cam, m.log_scale);
  report.keyframe = begins || m.window.IsKeyframe(frames, T_odom_cam);
  record.sequence = m.sequence;
  record.input_stamp = frame.stamp;
  record.stamp = m.first_stored_stamp + WholeMicroseconds(frame.stamp - m.first_stamp);
  const bool lost = !frames.empty() && step && step->lost;
  std::vector<Detection> seen = lost ? std::vector<Detection>() : frame.detections;
  {
    const ScopedTimer timer(m.timing, "data association");
    report.filter = FilterDetections(seen, m.options.filter);
    const std::vector<int> order = CanonicalOrder(seen);
    seen = InOrder(seen, order);
    const double stamp = record.stamp;
    record.frame = frame.index;
    record.T_odom_cam = T_odom_cam;
    record.T_world_cam = T_world_cam;
    record.detections = WithoutAppearance(seen);
    frames.Append(std::move(record), step);
    report.map = m.state.map.AddFrame(frame.index, stamp, T_world_cam, seen, m.camera(),
                                      frames.back().travelled);
    frames.SetMatched(frames.size() - 1, report.map.matched);
    report.map.matched = BackInOrder(report.map.matched, order);
  }
  if (m.options.loop.enabled) m.loops.AddFrame(m.state, seen);
  if (report.keyframe) {
    {
      const ScopedTimer timer(m.timing, "object optimisation");
      report.window = m.window.AddKeyframe(m.state, m.log_scale, m.refined_log_scale);
    }
    if (m.options.loop.enabled) m.loops.AddKeyframe(m.state, m.scale(), m.timing);
  }
  report.T_world_cam = m.ToHost(frames.back().T_world_cam);
  report.changes = TakeChanges();
  return report;
}

void Mapper::SearchNow() { impl_->loops.SearchNow(impl_->state, scale(), impl_->timing); }

MapChanges Mapper::TakeChanges() {
  Impl& m = *impl_;
  MapChanges changes = m.reporter.Take(m.state, m.loops.ledger());
  changes.scale = scale();
  changes.T_world_odom = m.ToHost(changes.T_world_odom) * m.T_start_odom;
  for (FramePose& pose : changes.poses) pose.T_world_cam = m.ToHost(pose.T_world_cam);
  return changes;
}

LoopSearchSummary Mapper::SummariseLoopSearch() const {
  const Impl& m = *impl_;
  const std::vector<LoopAttempt>& attempts = m.loops.ledger().attempts();
  LoopSearchSummary summary;
  summary.without_candidate = summary.searches = m.loops.without_candidate();
  for (const LoopAttempt& attempt : attempts) {
    if (!attempt.counts()) continue;
    ++summary.searches;
    if (attempt.accepted())
      ++summary.accepted;
    else
      ++summary.refused[attempt.row().reason];
  }
  std::vector<Pose> odometry;
  for (const FrameRecord& frame : m.state.frames) odometry.push_back(frame.T_input_cam);
  summary.up_axis_is_plausible = MayBeUp(m.state.gravity().up, odometry);
  return summary;
}

// Sets the noise of odometry, and takes its turn out. Later frames keep the correction of the
// loops.
void Mapper::Impl::LearnFromLoops(WholeMapOptions& whole_map, LoopEvidence& evidence) {
  whole_map.ba.odometry = options.ba.odometry;
  evidence.odometry_factors = {};
  if (!loops.ledger().AnyAccepted()) return odometry.SetTurn(0, state.frames);
  whole_map.ba.odometry = options.loop.odometry;
  const OdometryByLoops learnt =
      LearnOdometry(state, loops.ledger(), scale(), options.loop, odometry.turn() / scale());
  odometry.SetTurn(learnt.turn * scale(), state.frames);
  loops.LearnFromSight(state, scale());
  evidence.odometry_factors = FactorsOfRefinement(learnt, loops.odometry_factors(), options.loop);
}

// Adjusts again while loops are withdrawn.
BaSummary Mapper::Impl::Adjust(WholeMapOptions& whole_map, LoopEvidence& evidence) {
  const ScopedTimer timer(timing, "full-map optimisation");
  while (true) {
    const BaSummary summary = RefineMap(state, log_scale, evidence, whole_map, camera());
    refined_log_scale = log_scale;
    if (!loops.Review(state)) return summary;
    LearnFromLoops(whole_map, evidence);
  }
}

BaSummary Mapper::Refine(Refinement when) {
  Impl& m = *impl_;
  const LoopOptions& loop = m.options.loop;
  WholeMapOptions whole_map = WholeMap(m.options);
  LoopEvidence evidence;
  if (m.state.frames.empty()) return {};
  if (loop.enabled) {
    if (when == Refinement::kAtEnd) m.loops.SearchAtEnd(m.state, m.scale(), m.timing);
    m.loops.SearchAgain(m.state, m.scale(), m.timing);
  }
  m.LearnFromLoops(whole_map, evidence);
  m.view_ties.clear();
  BaSummary summary = m.Adjust(whole_map, evidence);
  if (m.context.view_aligner && loop.enabled && loop.views.enabled) {
    const ScopedTimer timer(m.timing, "view alignment");
    evidence.view_ties = TieViews(m.state.frames, m.loops.ledger().AcceptedPath(m.state.frames),
                                  m.context.view_aligner, loop);
  }
  if (!evidence.view_ties.empty()) {
    summary = m.Adjust(whole_map, evidence);
    m.view_ties = AgreeingTies(evidence.view_ties, m.state.frames);
    MeasureByViews(m.state, m.view_ties, m.scale(), loop.odometry, m.loops.ledger());
  }
  {
    const ScopedTimer timer(m.timing, "choice of trajectory");
    m.improvement = ChooseTrajectory(m.state, m.log_scale, evidence, whole_map, m.loops.ledger(),
                                     loop.odometry);
  }
  m.refined_log_scale = m.log_scale;
  m.state.frames.MarkRefined();
  m.loops.ledger().MarkRefined();
  return summary;
}

void Mapper::CatchUp(const Mapper& original, const std::vector<AddedFrame>& since) {
  Impl& m = *impl_;
  const Impl& other = *original.impl_;
  m.loops.ledger().ReserveIds(other.loops.ledger());
  m.state.map.ReserveIds(other.state.map);
  for (const AddedFrame& added : since) {
    if (added.starts_sequence) StartSequence();
    AddFrame(added.frame);
  }
  m.starts_sequence = other.starts_sequence;
  const int first_new = since.empty() ? std::numeric_limits<int>::max() : since[0].frame.index;
  m.reporter.TakeOver(other.reporter, m.loops.ledger(), first_new);
}

Trajectory Mapper::CameraTrajectory() const {
  Trajectory trajectory;
  for (const FrameRecord& record : impl_->state.frames) {
    trajectory.stamps.push_back(record.input_stamp);
    trajectory.poses.push_back(impl_->ToHost(record.T_world_cam));
  }
  return trajectory;
}

PoseGraph Mapper::Graph() const {
  PoseGraph graph;
  const FrameStore& frames = impl_->state.frames;
  for (int i = 0; i < frames.size(); ++i) {
    graph.vertices.push_back({frames[i].frame, impl_->ToHost(frames[i].T_world_cam), i == 0});
    if (i == 0) continue;
    const OdometryEdge step = OdometryBetween(frames, i - 1, i, {impl_->options.ba.odometry, {}},
                                              impl_->state.gravity().up, scale());
    graph.edges.push_back(
        {frames[i - 1].frame, frames[i].frame, step.T_from_to, step.information, false});
  }
  for (const LoopClosure& loop : WithoutEarly(LoopClosures())) {
    // otherwise the tie would count twice
    if (loop.decision != LoopDecision::kAccepted || loop.by_views) continue;
    graph.edges.push_back({loop.match_frame, loop.query_frame, loop.T_match_query,
                           Eigen::Matrix<double, 6, 6>(loop.covariance).inverse(), true});
  }
  for (const ViewTie& tie : impl_->view_ties)
    graph.edges.push_back({frames[tie.from].frame, frames[tie.to].frame, tie.pose.T_a_b,
                           tie.pose.covariance.inverse(), true});
  return graph;
}

std::vector<MapObject> Mapper::Objects() const {
  std::vector<MapObject> objects;
  for (const auto& [id, landmark] : impl_->state.map.landmarks()) {
    MapObject object;
    object.id = landmark.id;
    object.label = landmark.label;
    object.state = landmark.state;
    object.T_world_object = impl_->ToHost(ToPose(landmark.pose, impl_->state.gravity()));
    object.dims = landmark.dims;
    for (const Sighting& sighting : landmark.sightings)
      object.observations.push_back({sighting.frame, sighting.detection_row});
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace sslcd
