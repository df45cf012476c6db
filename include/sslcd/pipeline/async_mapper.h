// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <memory>
#include <string>

#include "sslcd/core/export.h"
#include "sslcd/pipeline/mapper.h"

namespace SSLCD_EXPORT sslcd {

/// What an AsyncMapper has done since it was last asked.
struct AsyncReport {
  MapChanges changes;   ///< of all frames since then, together
  int frames = 0;       ///< frames that were added
  int dropped = 0;      ///< frames that found the queue full
  int refused = 0;      ///< frames that Mapper::AddFrame threw at
  std::string refusal;  ///< the message of the last of these
  /// what ended the thread, e.g. want of memory or an exception of a host's function; empty: it
  /// runs. The results so far stay.
  std::string failure;
};

/// A Mapper on a thread of its own, for hosts that must not wait: a frame that closes a loop takes
/// a tenth of a second, a refinement of a long run seconds. A copy is refined on a second thread,
/// while frames go on, and then gets the frames since (Mapper::CatchUp). Calls return at once but
/// for Wait() and WaitFor(). All of them are thread-safe; frames and sequences are in the order of
/// the calls, and the result, but for ids, depends on them alone, not on how long anything takes,
/// unless frames are dropped. The host's functions (MapperContext) are called on both threads, and
/// for the frames since a copy once more. If no one takes the report, it grows no larger than the
/// results.
class AsyncMapper {
 public:
  /// At most `most_waiting` frames wait. A refinement (Refinement::kOnTheWay) begins by itself when
  /// a loop was accepted and the path has become longer by `refine_every_m`, and by a twentieth,
  /// since the last one began; 0: none does. It ends the one in work first, and frames wait. Throws
  /// what Mapper's constructor throws, and Error(kBadConfig) for a path below 0.
  AsyncMapper(const Options& options, const MapperContext& context, int most_waiting = 64,
              double refine_every_m = 50);
  /// Ends after the frame and the refinement in work; what waits is not done.
  ~AsyncMapper();
  AsyncMapper(const AsyncMapper&) = delete;
  AsyncMapper& operator=(const AsyncMapper&) = delete;

  /// Hands in the next frame. False: the queue is full, or the thread has failed, so this frame is
  /// dropped and counted. The step to the next frame then spans it, with its uncertainty.
  bool AddFrame(Frame frame);
  /// Mapper::StartSequence for the next frame.
  void StartSequence();
  /// Refines after the frames handed in so far. Ends a refinement in work first, and frames after
  /// it wait.
  void Refine(Refinement when = Refinement::kAtEnd);
  /// A copy of the mapper after all that was handed in so far; ends a refinement in work first. If
  /// the thread ends before, the future has a std::future_error.
  std::future<Mapper> Snapshot();

  /// What was done since the last call.
  AsyncReport TakeReport();
  /// Waits until all that was handed in is done, or the thread has failed.
  void Wait();
  /// The same, but at most for `seconds`. False: something is left to do.
  bool WaitFor(double seconds);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
