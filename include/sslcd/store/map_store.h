// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sslcd/change/map_history.h"
#include "sslcd/closing/localisation.h"
#include "sslcd/core/camera.h"
#include "sslcd/core/cue.h"
#include "sslcd/core/detection.h"
#include "sslcd/core/detection_noise.h"
#include "sslcd/core/export.h"
#include "sslcd/core/label.h"
#include "sslcd/core/landmark.h"
#include "sslcd/core/loop_closure.h"
#include "sslcd/core/pose.h"
#include "sslcd/core/pose_graph.h"
#include "sslcd/pipeline/mapper.h"

namespace SSLCD_EXPORT sslcd {

/// One drive of a site, as its map describes it.
struct SessionInfo {
  int id = 0;  ///< 1, 2, 3, ... in the order in which they were begun
  std::string name;
  bool ended = false;    ///< false: interrupted, or still in work
  int frame_offset = 0;  ///< added to Frame::index: the frame's number in the map
  int frames = 0;
  std::optional<int> last_frame;  ///< number in the map; none: no frame yet
  int inputs = 0;                 ///< frames, starts of sequences and refinements
  std::string checksum;           ///< SHA-256 over the inputs, 32 bytes
  /// where it comes from, for people; `started` in UTC
  std::string dataset, command, program, started;
};

/// What a map is about.
struct MapInfo {
  Vec3 up_axis{0, 0, 1};  ///< unit vector in the world
  LabelTable labels;      ///< of the datasets, and all labels seen
  std::optional<Camera> camera;
  PerCue<int> vector_length;  ///< of the appearance vectors; 0: none seen
  std::string config;         ///< the mapper's options as YAML
  std::string created;        ///< UTC
  std::vector<SessionInfo> sessions;
  std::int64_t file_bytes = 0;
};

/// The camera poses of one session.
struct SessionPath {
  int session = 0;                  ///< SessionInfo::id
  std::vector<int> frames;          ///< numbers in the map
  Trajectory trajectory, odometry;  ///< T_world_cam and T_odom_cam of each frame
};

/// The results that a map holds: those after its first `inputs` inputs. Frames have the numbers of
/// the map.
struct MapResults {
  std::int64_t inputs = 0;
  std::vector<SessionPath> paths;
  std::vector<MapPart> parts;      ///< by number; which of them have a common map
  std::vector<MapObject> objects;  ///< all landmarks by id
  std::vector<LoopClosure> loops;  ///< all attempts in order
  PoseGraph graph;
  double scale = 1;  ///< metres per odometry metre
  NoiseScale noise_scale;
};

/// A map in a file, opened to be read (docs/store.md). Readers may come at any time, also while a
/// MapSession writes; each call sees one state of the file. Throws Error(kBadInput) for a file that
/// is missing, damaged, cut short, the database of another program or of another schema, and
/// Error(kOutput) if it cannot be read.
class MapStore {
 public:
  explicit MapStore(const std::string& path);
  ~MapStore();
  MapStore(MapStore&&) noexcept;
  MapStore& operator=(MapStore&&) noexcept;

  MapInfo Describe() const;
  /// Throws Error(kBadInput) if a checksum of the results is wrong.
  MapResults Results() const;
  /// What was there when; sessions in the order of MapInfo::sessions. Throws as Results does.
  /// O(inputs + frames * (objects in sight)^2)
  MapHistory History() const;

  /// The frames of a session as they were given to MapSession::AddFrame, without the paths of their
  /// images. Throws Error(kUsage) if there is no session of this name, and Error(kBadInput) if its
  /// checksum is wrong.
  std::vector<Frame> Frames(const std::string& session) const;

  /// The confirmed landmarks, to localise in (pipeline/localiser.h). Throws as Results() does.
  ReferenceMap Reference() const;

  /// Reads the whole file: SQLite's own check, the schema, foreign keys and all checksums. One
  /// sentence per problem; empty: the file is sound.
  std::vector<std::string> Verify() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the file is there and has a session. False for an empty file: a program was ended before
/// it stored anything. Throws as MapStore does for all other files that are no map.
bool HasMap(const std::string& path);

/// Updates a map of an older schema, returns unused space to the disk and merges the log into the
/// file. Throws Error(kOutput) while a session is in work.
void CompactMap(const std::string& path);

}  // namespace sslcd
