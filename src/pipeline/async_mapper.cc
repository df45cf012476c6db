// SPDX-License-Identifier: BSD-3-Clause
#include "sslcd/pipeline/async_mapper.h"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "pipeline/merge_changes.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Step = std::optional<StepUncertainty>;

// Of two steps, one after the other.
Step Together(const Step& a, const Step& b) {
  if (!a) return b;
  if (!b) return a;
  return StepUncertainty{a->lost || b->lost, std::hypot(a->translation_m, b->translation_m),
                         std::hypot(a->rotation_rad, b->rotation_rad)};
}

}  // namespace

struct SSLCD_HIDDEN AsyncMapper::Impl {
  using Job = std::function<void(Mapper&, AsyncReport&)>;

  Impl(const Options& options, const MapperContext& context, int most)
      : mapper(options, context), most_waiting(most), thread([this] { Run(); }) {}
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
  bool IsIdle() const { return jobs.empty() && !works; }
  void Push(Job job) {
    if (HasFailed()) return;
    jobs.push_back(std::move(job));
    changed.notify_all();
  }

  void Run();
  void Do(const Job& job);

  Mapper mapper;  // of the thread alone
  const int most_waiting;
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Job> jobs;
  AsyncReport report;
  Step dropped_step;  // over the frames dropped since the last one
  int waiting = 0;    // frames among the jobs
  bool works = false, ends = false;
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

// Works without the lock, then adds what was done to the report.
void AsyncMapper::Impl::Do(const Job& job) {
  AsyncReport done;
  try {
    job(mapper, done);
  } catch (const Error& error) {
    // of a bad frame alone the mapper is as it was
    if (error.kind() == ErrorKind::kBadInput) {
      done.refused = 1;
      done.refusal = error.what();
    } else {
      done.failure = error.what();
    }
  } catch (const std::exception& error) {
    done.failure = error.what();
  } catch (...) {
    done.failure = "an exception of the host's that is no std::exception";
  }
  const std::lock_guard lock(mutex);
  MergeChanges(std::move(done.changes), report.changes);
  report.frames += done.frames;
  report.refused += done.refused;
  if (!done.refusal.empty()) report.refusal = std::move(done.refusal);
  if (!done.failure.empty()) report.failure = std::move(done.failure);
}

AsyncMapper::AsyncMapper(const Options& options, const MapperContext& context, int most_waiting)
    : impl_(std::make_unique<Impl>(options, context, most_waiting)) {}
AsyncMapper::~AsyncMapper() = default;

bool AsyncMapper::AddFrame(Frame frame) {
  Impl& m = *impl_;
  const std::lock_guard lock(m.mutex);
  frame.step = Together(m.dropped_step, frame.step);
  if (m.waiting >= m.most_waiting || m.HasFailed()) {
    m.dropped_step = frame.step;
    ++m.report.dropped;
    return false;
  }
  m.dropped_step = {};
  ++m.waiting;
  m.Push([&m, frame = std::move(frame)](Mapper& mapper, AsyncReport& done) {
    {
      const std::lock_guard taken(m.mutex);
      --m.waiting;
    }
    done.changes = mapper.AddFrame(frame).changes;
    done.frames = 1;
  });
  return true;
}

void AsyncMapper::StartSequence() {
  const std::lock_guard lock(impl_->mutex);
  impl_->dropped_step = {};
  impl_->Push([](Mapper& mapper, AsyncReport&) { mapper.StartSequence(); });
}

void AsyncMapper::Refine() {
  const std::lock_guard lock(impl_->mutex);
  impl_->Push([](Mapper& mapper, AsyncReport& done) {
    mapper.Refine();
    done.changes = mapper.TakeChanges();
  });
}

std::future<Mapper> AsyncMapper::Snapshot() {
  const auto promise = std::make_shared<std::promise<Mapper>>();
  const std::lock_guard lock(impl_->mutex);
  impl_->Push([promise](Mapper& mapper, AsyncReport&) { promise->set_value(mapper); });
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
