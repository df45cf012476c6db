// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sslcd/core/export.h"
#include "sslcd/pipeline/mapper.h"
#include "sslcd/pipeline/options.h"
#include "sslcd/store/map_store.h"

namespace SSLCD_EXPORT sslcd {

/// A new drive for a map.
struct SessionRequest {
  std::string name;  ///< unlike those of the map's other sessions
  /// provenance, for people
  std::string dataset{}, command{}, program{};
};

/// A drive that is added to a map in a file. The file keeps the mapper's inputs in order, from
/// which the mapper, which is deterministic, is made again when a session begins or goes on, and
/// the results for readers. Inputs are stored in batches that end with a keyframe: what
/// stored_frames() counts survives a killed process and a loss of power. One MapSession at a time
/// may write to a file; others are refused with the name of the holder.
///
/// Not thread-safe. All functions throw Error(kOutput) if the file cannot be written, e.g. on a
/// full disk. What was stored before stays, and Save() or End() may be called again.
class MapSession {
 public:
  /// Adds a session; makes the file if there is none. Options: none stands for those of the map,
  /// or for the defaults if it is new. Throws what MapStore throws; Error(kUsage) if the name is
  /// taken, another session has not been ended, the options differ from those of the map, or the
  /// host has a place matcher, which cannot be stored; Error(kBadInput) for another site: another
  /// up axis or another symmetry of a label. A session with another camera is mapped without 2D
  /// boxes. O(all frames of the map).
  static MapSession Begin(const std::string& path, const SessionRequest& request,
                          const MapperContext& context, const std::optional<Options>& options);
  /// Goes on with the session that was not ended. The context as before. Throws Error(kUsage) if
  /// there is none.
  static MapSession Resume(const std::string& path, const MapperContext& context);
  /// Ends this session and begins another one on the same map. The results are those of End() and
  /// Begin(), without the time to make the mapper again, unless the context brings symmetries of
  /// labels or a view aligner that the mapper does not know yet. Throws what these two throw; the
  /// session is ended then, and nothing else may be called but info().
  void BeginNext(const SessionRequest& request, const MapperContext& context);
  ~MapSession();
  MapSession(MapSession&&) noexcept;
  MapSession& operator=(MapSession&&) noexcept;

  /// Whether this frame is stored already, by its number. Throws Error(kBadInput) if it was stored
  /// with another content: the drive is another one, or has changed.
  bool IsStored(const Frame& frame) const;
  /// Mapper::AddFrame, with the number of the frame in its own drive. Throws Error(kBadInput) for
  /// appearance vectors of another length than the map's.
  FrameReport AddFrame(const Frame& frame);
  /// Mapper::StartSequence, which Begin() has called already.
  void StartSequence();
  /// Mapper::Refine. Stored with the next batch, Save() or End().
  BaSummary Refine(Refinement when = Refinement::kAtEnd);
  /// Stores all inputs so far and the present results. The session can go on, now or later.
  void Save();
  /// Save(), and the session is ended.
  void End();

  const SessionInfo& info() const;
  const Options& options() const;  ///< of the map
  int stored_frames() const;       ///< frames of this session that will not be lost
  FilterReport filter() const;     ///< sums over the frames of this session
  /// All sessions together. Frames have the numbers of the map.
  Mapper& mapper();

 private:
  struct Impl;
  explicit MapSession(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sslcd
