// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/pass_map.h"
#include "pipeline/path_graph.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/pose_tracks.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Paper IV, as it runs with every keyframe: the objects seen lately are matched with those of older passes; what is
/// believed becomes an edge of the pose graph, and trajectory and map follow.
class LoopCloser {
 public:
  /// Works on the mapper's own map and frames.
  LoopCloser(const Options& options, ObjectMap& map, std::vector<FrameRecord>& frames);

  /// Looks for loops if the camera has come far enough since the last time. True: trajectory and map have moved.
  bool AddKeyframe(double scale, TimingTable& timing);

  /// After the last frame: nothing more is to come that could surround the latest cameras with objects.
  void Finish(double scale, TimingTable& timing);

  /// Takes back loops that the trajectory, once everything has been weighed, does not go through.
  void Review();

  /// Has any loop been believed?
  bool Closed() const;

  /// All attempts so far that had something to compare.
  std::vector<LoopClosure> closures() const;

 private:
  struct Attempt {
    LoopClosure row;
    int track = -1;
    int query = 0, match = 0;                                  // indices into frames_
    std::vector<std::pair<LandmarkId, LandmarkId>> fuse;  // the row's pairs, by the names they have now
    double own_evidence = 0, heading_sigma = 0;
    bool confirmed = false, believed = false, in_graph = false;
  };
  bool Detect(double lag_m);
  bool Agree() const;
  double OldUntil() const { return frames_.back().travelled - options_.loop.local_m - options_.loop.gap_m; }
  double Bent(int frame, double seen_m) const;
  int NearestOldFrame(const Pose& T_world_cam, const std::vector<std::pair<LandmarkId, LandmarkId>>& matches) const;
  PoseTracks::Prior PriorOf(const PassLayout& local, const PassLayout& global, const LayoutIndex& index) const;
  bool Measure(double lag_m, const PoseTrack& track, const PassLayout& local, const PassLayout& global, Attempt& attempt) const;
  bool MeasureAt(double lag_m, const PoseTrack& track, const PassLayout& local, const PassLayout& global,
                 Attempt& attempt) const;
  void Correct(double scale);
  bool Fuse();

  Options options_;
  ObjectMap& map_;
  std::vector<FrameRecord>& frames_;
  PassMap passes_;
  PoseTracks tracks_;
  PathGraph path_;
  double last_attempt_m_ = 0;
  std::vector<Attempt> attempts_;
};

}  // namespace sslcd
