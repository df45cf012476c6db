// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/loop_measurement.h"
#include "pipeline/pass_map.h"
#include "pipeline/path_graph.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/loop/layout_index.h"
#include "sslcd/loop/pose_tracks.h"
#include "sslcd/optim/odometry_noise.h"
#include "sslcd/pipeline/mapper.h"

namespace sslcd {

/// Paper IV, as it runs with the keyframes: the objects seen lately are matched with those of older
/// passes; loops that are believed become edges of the pose graph, and trajectory and map follow.
/// Works on the mapper's own map and frames.
class LoopCloser {
 public:
  LoopCloser(const Options& options, ObjectMap& map, std::vector<FrameRecord>& frames,
             PlaceMatcher matcher = {});

  /// The newest frame, while it still knows how its detections look. To be called with each frame.
  void AddFrame() { passes_.Update(); }

  /// Frames from this one on are about to move, as those of the sliding window do.
  void MovedFrom(int frame) { passes_.MovedFrom(frame); }

  /// Looks for a loop if the camera has come far enough since the last time. True: trajectory or
  /// map have changed.
  bool AddKeyframe(double scale, TimingTable& timing);

  /// After the last frame: nothing more is to come that could surround the latest cameras with
  /// objects. Then looks at the whole run again, with hindsight.
  void Finish(double scale, TimingTable& timing);

  /// After everything was refined and associated anew: takes back loops that the trajectory does
  /// not go through, and measures the others again.
  void Review();

  /// Measures accepted loops anew where a tie between views close by does so better than their
  /// objects.
  void MeasureByViews(const std::vector<ViewTie>& ties, double scale);

  /// Has any loop been accepted?
  bool Closed() const;

  /// The path with all accepted loops as shortcuts.
  PathGraph Path() const;

  /// How far off the accepted loops say the odometry is, compared with LoopOptions::odometry.
  OdometryFactors LearnOdometry(double scale) const;

  /// All attempts that had something to compare, in order.
  std::vector<LoopClosure> closures() const;

 private:
  /// Where on the path to look for a loop, and how. [m]
  struct Look {
    double here_m = 0, lag_m = 0;  // the path so far; the query camera stood so far back
    double local_m = 0;            // the local map
    // the query camera may have stood so far before the first or after the last matched object
    double beyond_m = 0;
    double OldUntil(double gap_m) const { return here_m - local_m - gap_m; }
  };
  struct Attempt {
    LoopMeasurement loop;
    std::vector<std::pair<LandmarkId, LandmarkId>> pairs;  // the row's, by the names they have now
    std::optional<LoopClosure> anew;                       // the row as measured by the refined map
    Look look;
    double sigma_m = 0;      // how well the matched objects agree; 0: found otherwise
    int track = -1;          // whose pose this is
    bool confirmed = false;  // its own objects say enough; believed as soon as its track is
    bool believed = false;   // an edge of the pose graph, which may refuse it
    bool in_graph = false;   // ... since the last time that was solved
  };
  bool DetectAndCorrect(const Look& look, double scale, TimingTable& timing);
  bool Find(const Look& look);
  const LayoutIndex& OldMap(double old_until_m);
  bool Detect(const Look& look);
  bool DetectWithMatcher(const Look& look);
  LoopMeasurement MeasureImages(int match_frame, int old_frame, const Pose& T_match_query) const;
  bool DetectAsPrinted();
  LoopMeter Meter() const { return {map_.gravity(), frames_, passes_, options_.loop}; }
  Attempt& AddAttempt(LoopMeasurement loop);
  bool Judge(const PoseTrack& best, double own_evidence, Attempt& attempt);
  void Believe(Attempt& attempt, const std::string& reason);
  bool Agree() const;
  void Correct(double here_m, double scale);
  bool Fuse();
  int FrameAt(double path_m) const;
  bool ClosedNear(double path_m) const;
  bool Known(const LoopMeasurement& loop) const;
  void LookAgain(double scale, TimingTable& timing);
  void MeasureAnew(Attempt& attempt) const;
  RelativePose OdometryBetween(int from, int to, double scale) const;

  Options options_;
  ObjectMap& map_;
  std::vector<FrameRecord>& frames_;
  PlaceMatcher matcher_;
  PassMap passes_;
  std::optional<LayoutIndex> old_;  // objects of old passes, as the last attempt had them
  PoseTracks tracks_;
  PathGraph path_;
  double last_attempt_m_ = 0;
  std::vector<Attempt> attempts_;
};

}  // namespace sslcd
