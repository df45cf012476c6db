// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/async_mapper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/odometry_failures.h"
#include "pipeline/background_refinement.h"
#include "pipeline/merge_changes.h"
#include "pipeline/refinement_plan.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

// The step over dropped frames, of which nothing else is left.
StepUncertainty Together(const OdometryFailures& failures) {
  return {failures.lost > 0, std::sqrt(failures.translation_m2), std::sqrt(failures.rotation_rad2)};
}

}  // namespace

struct SSLCD_HIDDEN AsyncMapper::Impl {
  using Job = std::function<void(AsyncReport&)>;

  Impl(const Options& options, const MapperContext& context, int most, double refine_every_m)
      : mapper(options, context),
        plan(refine_every_m),
        most_waiting(most),
        thread([this] { Run(); }) {}
  ~Impl() {
    {
      const std::lock_guard lock(mutex);
      ends = true;
    }
    changed.notify_all();
    thread.join();
  }

  // All below need the lock.
  bool HasFailed() const { return !report.failure.empty(); }
  bool IsIdle() const { return jobs.empty() && !works && (!refines || HasFailed()); }
  void Push(Job job) {
    if (HasFailed()) return;
    jobs.push_back(std::move(job));
    changed.notify_all();
  }

  void Run();
  void Do(const Job& job);

  // Of the thread alone.
  void AddFrame(const Frame& frame, AsyncReport& done);
  void BeginRefinement(Refinement when, AsyncReport& done);
  void EndRefinement(AsyncReport& done);
  Mapper mapper;
  RefinementPlan plan;
  bool starts_sequence = false;  // with the next frame
  int begun = 0;                 // refinements
  int newest_frame = -1;
  int refined_frame = -1;  // the newest one when the last refinement began
  std::vector<std::shared_ptr<std::promise<Mapper>>> snapshots;  // to be given

  const int most_waiting;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Job> jobs;
  AsyncReport report;
  StepJudge steps;                          // of all frames handed in
  std::optional<OdometryFailures> dropped;  // in the steps to the frames dropped since the last one
  int waiting = 0;                          // frames among the jobs
  bool works = false, refines = false, ends = false;
  std::unique_ptr<BackgroundRefinement> refinement;  // of the thread alone
  std::thread thread;  // the last member: it starts when all others are there
};

void AsyncMapper::Impl::Run() {
  std::unique_lock lock(mutex);
  while (true) {
    changed.wait(lock, [this] { return ends || !jobs.empty(); });
    if (ends) return;
    const Job job = std::move(jobs.front());
    jobs.pop_front();
    works = true;
    lock.unlock();
    Do(job);
    lock.lock();
    works = false;
    if (HasFailed()) jobs.clear();
    changed.notify_all();
  }
}

// Works without the lock, then adds what was done to the report. A snapshot comes after the report
// of what is in it.
void AsyncMapper::Impl::Do(const Job& job) {
  AsyncReport done;
  try {
    job(done);
  } catch (const std::exception& error) {
    done.failure = error.what();
    if (done.failure.empty()) done.failure = "an exception without a message";
  } catch (...) {
    done.failure = "an exception of the host's that is no std::exception";
  }
  const bool failed = !done.failure.empty();
  {
    const std::lock_guard lock(mutex);
    MergeChanges(std::move(done.changes), report.changes);
    report.frames += done.frames;
    report.refused += done.refused;
    if (!done.refusal.empty()) report.refusal = std::move(done.refusal);
    if (failed) report.failure = std::move(done.failure);
  }
  if (failed) snapshots.clear();
  for (const auto& snapshot : std::exchange(snapshots, {})) {
    try {
      snapshot->set_value(mapper);
    } catch (...) {
      snapshot->set_exception(std::current_exception());
    }
  }
}

void AsyncMapper::Impl::AddFrame(const Frame& frame, AsyncReport& done) {
  try {
    done.changes = mapper.AddFrame(frame).changes;
  } catch (const Error& error) {
    done.changes = mapper.TakeChanges();
    const std::vector<FramePose>& poses = done.changes.poses;
    const bool is_in = !poses.empty() && poses.back().frame == frame.index;
    if (error.kind() != ErrorKind::kBadInput || is_in) throw;  // is_in: a function of the host's
    done.refused = 1;                                          // the mapper is as it was
    done.refusal = error.what();
    return;
  }
  done.frames = 1;
  newest_frame = frame.index;
  if (refinement) refinement->Add({frame, starts_sequence});
  starts_sequence = false;
  if (!plan.Add(frame)) return;
  if (refinement) EndRefinement(done);  // so that its loops count, however fast it was
  const std::vector<LoopClosure> loops = mapper.LoopClosures();
  if (std::any_of(loops.begin(), loops.end(), [this](const LoopClosure& loop) {
        return loop.decision == LoopDecision::kAccepted && loop.newest_frame > refined_frame;
      }))
    BeginRefinement(Refinement::kOnTheWay, done);
}

void AsyncMapper::Impl::BeginRefinement(Refinement when, AsyncReport& done) {
  if (refinement) EndRefinement(done);
  refined_frame = newest_frame;
  {
    const std::lock_guard lock(mutex);
    refines = true;
  }
  refinement = std::make_unique<BackgroundRefinement>(mapper, when, [this, which = ++begun] {
    const std::lock_guard lock(mutex);
    Push([this, which](AsyncReport& its) {
      if (refinement && which == begun) EndRefinement(its);
    });
  });
}

void AsyncMapper::Impl::EndRefinement(AsyncReport& done) {
  const std::unique_ptr<BackgroundRefinement> ended = std::move(refinement);
  ended->Replace(mapper);
  MergeChanges(mapper.TakeChanges(), done.changes);
  const std::lock_guard lock(mutex);
  refines = false;
}

AsyncMapper::AsyncMapper(const Options& options, const MapperContext& context, int most_waiting,
                         double refine_every_m)
    : impl_(std::make_unique<Impl>(options, context, most_waiting, refine_every_m)) {}
AsyncMapper::~AsyncMapper() = default;

bool AsyncMapper::AddFrame(Frame frame) {
  Impl& m = *impl_;
  const std::lock_guard lock(m.mutex);
  OdometryFailures failures = m.steps.Add(frame.T_odom_cam, frame.step);
  if (m.dropped) failures += *m.dropped;
  if (m.waiting >= m.most_waiting || m.HasFailed()) {
    m.dropped = failures;
    ++m.report.dropped;
    return false;
  }
  // a step over many frames would be taken for a failure
  if (std::exchange(m.dropped, {})) frame.step = Together(failures);
  ++m.waiting;
  m.Push([&m, frame = std::move(frame)](AsyncReport& done) {
    {
      const std::lock_guard taken(m.mutex);
      --m.waiting;
    }
    m.AddFrame(frame, done);
  });
  return true;
}

void AsyncMapper::StartSequence() {
  const std::lock_guard lock(impl_->mutex);
  impl_->dropped = {};
  impl_->Push([this](AsyncReport&) {
    impl_->mapper.StartSequence();
    impl_->plan.StartSequence();
    impl_->starts_sequence = true;
  });
}

void AsyncMapper::Refine(Refinement when) {
  const std::lock_guard lock(impl_->mutex);
  impl_->Push([this, when](AsyncReport& done) { impl_->BeginRefinement(when, done); });
}

std::future<Mapper> AsyncMapper::Snapshot() {
  const auto promise = std::make_shared<std::promise<Mapper>>();
  const std::lock_guard lock(impl_->mutex);
  impl_->Push([this, promise](AsyncReport& done) {
    if (impl_->refinement) impl_->EndRefinement(done);
    impl_->snapshots.push_back(promise);
  });
  return promise->get_future();
}

AsyncReport AsyncMapper::TakeReport() {
  const std::lock_guard lock(impl_->mutex);
  AsyncReport report = std::exchange(impl_->report, {});
  impl_->report.failure = report.failure;
  impl_->report.changes.T_world_odom = report.changes.T_world_odom;
  impl_->report.changes.scale = report.changes.scale;
  return report;
}

void AsyncMapper::Wait() {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock, [this] { return impl_->IsIdle(); });
}

bool AsyncMapper::WaitFor(double seconds) {
  std::unique_lock lock(impl_->mutex);
  return impl_->changed.wait_for(lock, std::chrono::duration<double>(seconds),
                                 [this] { return impl_->IsIdle(); });
}

}  // namespace sslcd
