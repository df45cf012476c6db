// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sslcd {

/// Version 1 of the schema. docs/store.md shows it. Keys come first in a table WITHOUT ROWID:
/// SQLite 3.40 reports NULL values there otherwise (PRAGMA integrity_check).
inline constexpr char kSchema1[] = R"sql(
-- The map as a whole: one row.
CREATE TABLE site (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  -- unit vector of the world
  up_x REAL NOT NULL, up_y REAL NOT NULL, up_z REAL NOT NULL,
  -- options of the mapper, YAML
  config TEXT NOT NULL,
  -- of the camera whose 2D boxes are used, [px] and [m]; NULL: none
  fx REAL, fy REAL, cx REAL, cy REAL, offset_x REAL, offset_y REAL, offset_z REAL,
  width INTEGER, height INTEGER,
  created TEXT NOT NULL  -- UTC
) STRICT;

-- Classes of objects, of the datasets and as they were seen.
CREATE TABLE label (
  name TEXT PRIMARY KEY,
  -- about the vertical
  symmetry TEXT NOT NULL CHECK (symmetry IN ('none', 'pi', 'full'))
) STRICT, WITHOUT ROWID;

-- The lengths of the appearance vectors.
CREATE TABLE cue (
  name TEXT PRIMARY KEY,
  length INTEGER NOT NULL CHECK (length > 0)
) STRICT, WITHOUT ROWID;

CREATE TABLE session (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE CHECK (length(name) > 0),
  state TEXT NOT NULL CHECK (state IN ('open', 'ended')),
  -- added to the numbers of its frames: their numbers in the map
  frame_offset INTEGER NOT NULL CHECK (frame_offset >= 0),
  frames INTEGER NOT NULL CHECK (frames >= 0),
  last_frame INTEGER,  -- number in the map
  inputs INTEGER NOT NULL CHECK (inputs >= 0),
  -- SHA-256 over its inputs: of the hash before, the kind and the content of each
  checksum BLOB NOT NULL CHECK (length(checksum) = 32),
  -- provenance, for people
  dataset TEXT NOT NULL,
  command TEXT NOT NULL,
  program TEXT NOT NULL,
  started TEXT NOT NULL  -- UTC
) STRICT;

-- What the map is made from, in order. docs/store.md describes the content.
CREATE TABLE input (
  id INTEGER PRIMARY KEY,
  session INTEGER NOT NULL REFERENCES session (id),
  kind TEXT NOT NULL CHECK (kind IN ('frame', 'sequence', 'refinement')),
  content BLOB NOT NULL
) STRICT;

-- The results below are those after this many inputs. One row.
CREATE TABLE result (
  id INTEGER PRIMARY KEY CHECK (id = 1),
  inputs INTEGER NOT NULL CHECK (inputs >= 0),
  scale REAL NOT NULL,  -- metres per metre of odometry
  -- learnt factors on the noise of the detections
  noise_radial REAL NOT NULL, noise_lateral REAL NOT NULL, noise_vertical REAL NOT NULL,
  noise_yaw REAL NOT NULL
) STRICT;

-- T_world_cam of each frame: quaternion and position [m].
CREATE TABLE pose (
  frame INTEGER PRIMARY KEY,  -- number in the map
  session INTEGER NOT NULL REFERENCES session (id),
  stamp REAL NOT NULL,  -- [s]
  qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL
) STRICT;

-- Stretches between which odometry was lost: sessions, and parts of them. Those with the same
-- joined_with have a common map, others not: nothing tells where they are to each other.
CREATE TABLE part (
  id INTEGER PRIMARY KEY,
  first_frame INTEGER NOT NULL REFERENCES pose (frame),
  sequence INTEGER NOT NULL,
  joined_with INTEGER NOT NULL  -- the first part of the common map
) STRICT;

-- T_world_object at the cuboid's centre: x along the length, y to the left, z up.
CREATE TABLE landmark (
  id INTEGER PRIMARY KEY,
  label TEXT NOT NULL REFERENCES label (name),
  state TEXT NOT NULL CHECK (state IN ('tentative', 'confirmed', 'dynamic', 'stale')),
  qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  length REAL NOT NULL, width REAL NOT NULL, height REAL NOT NULL,  -- [m]
  sightings INTEGER NOT NULL,
  first_frame INTEGER REFERENCES pose (frame), last_frame INTEGER REFERENCES pose (frame)
) STRICT;

-- The history of a landmark: in which frames it was seen, and the row of each detection.
CREATE TABLE sighting (
  landmark INTEGER NOT NULL REFERENCES landmark (id),
  position INTEGER NOT NULL,  -- in the landmark's list
  frame INTEGER NOT NULL REFERENCES pose (frame),
  detection INTEGER NOT NULL,
  PRIMARY KEY (landmark, position)
) STRICT, WITHOUT ROWID;

-- How a confirmed landmark looks: the mean over the sightings that have this cue, of unit length, as
-- floats, least significant byte first.
CREATE TABLE appearance (
  landmark INTEGER NOT NULL REFERENCES landmark (id),
  cue TEXT NOT NULL REFERENCES cue (name),
  sightings INTEGER NOT NULL CHECK (sightings > 0),
  vector BLOB NOT NULL,
  PRIMARY KEY (landmark, cue)
) STRICT, WITHOUT ROWID;

-- Attempts to close a loop, T_match_query and its covariance: of [translation, rotation], the upper
-- triangle row by row as 21 doubles, least significant byte first.
CREATE TABLE loop (
  id INTEGER PRIMARY KEY,
  position INTEGER NOT NULL UNIQUE,  -- in the list of attempts
  newest_frame INTEGER NOT NULL, query_frame INTEGER NOT NULL, match_frame INTEGER NOT NULL,
  decision TEXT NOT NULL CHECK (decision IN ('none', 'ambiguous', 'accepted')),
  reason TEXT NOT NULL,
  score REAL, second_score REAL,  -- [nats]
  probability REAL,
  qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  covariance BLOB NOT NULL CHECK (length(covariance) = 168),
  by_views INTEGER NOT NULL CHECK (by_views IN (0, 1)),
  viewpoint_change REAL NOT NULL  -- [rad]
) STRICT;

-- Which landmarks an attempt takes for the same.
CREATE TABLE loop_pair (
  loop INTEGER NOT NULL REFERENCES loop (id),
  position INTEGER NOT NULL,
  local INTEGER NOT NULL, global INTEGER NOT NULL,  -- landmarks at the time of the attempt
  PRIMARY KEY (loop, position)
) STRICT, WITHOUT ROWID;

-- The pose graph: T_from_to and its information, as the covariance above.
CREATE TABLE edge (
  id INTEGER PRIMARY KEY,
  from_frame INTEGER NOT NULL REFERENCES pose (frame),
  to_frame INTEGER NOT NULL REFERENCES pose (frame),
  loop INTEGER NOT NULL CHECK (loop IN (0, 1)),
  qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL,
  information BLOB NOT NULL CHECK (length(information) = 168)
) STRICT;

-- SHA-256 over the rows of each table but input, in the order of their keys.
CREATE TABLE checksum (
  name TEXT PRIMARY KEY,
  sha256 BLOB NOT NULL CHECK (length(sha256) = 32)
) STRICT, WITHOUT ROWID;
)sql";

}  // namespace sslcd
