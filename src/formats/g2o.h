// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/error.h"
#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A .g2o file as a graph in 3D.
struct G2oFile {
  PoseGraph graph;
  bool planar = false;   ///< all rows were SE2: z, roll and pitch are zero (up is +z)
  int rows_ignored = 0;  ///< rows of other kinds (landmarks, parameters)

  int information_projected = 0;  ///< matrices that were not positive definite
  FileLocation first_projected;   ///< row of the first of them
  /// smallest eigenvalue of these matrices, relative to the largest one of its matrix; 0 if they
  /// are semi-definite
  double least_eigenvalue = 0;
};

/// Reads VERTEX_SE3:QUAT, EDGE_SE3:QUAT, VERTEX_SE2, EDGE_SE2 and FIX rows; rows of other kinds are
/// counted and skipped. Information is the upper triangle, row by row, in the order of the
/// measurement: [translation, rotation] or [x, y, yaw]. It is the information of Log(T_from_to^-1
/// T_world_from^-1 T_world_to) in metres and radians, as in GTSAM. g2o itself measures a rotation
/// by the imaginary part of its quaternion (half the angle), so its chi2 of the same file differs.
/// SE2 rows are lifted: z, roll and pitch are held at zero with an information of
/// kLiftedInformation. Edges between ids that are not consecutive (i -> i + 1) are marked as loops.
/// A file without vertex rows gets its vertices from its edges: the first one is at the origin, and
/// the others follow by the shortest path over consecutive edges, or over loops where no such path
/// exists.
///
/// Information that is indefinite or semi-definite (cross terms in the wrong place, a component
/// without a measurement, rounding) is projected by ProjectInformation and counted; SE2 rows before
/// they are lifted. Positive definite matrices stay as they are, bit by bit.
///
/// Throws Error with file:line for wrong counts and malformed numbers, NaN, quaternions without
/// unit length, duplicate or missing vertices, edges from a vertex to itself, and information with
/// a negative diagonal entry or with none that is positive: zero information measures nothing, and
/// a floor has no scale to be relative to.
G2oFile ReadG2o(const std::string& path);

/// VERTEX_SE3:QUAT, FIX and EDGE_SE3:QUAT rows; information in the order [translation, rotation],
/// upper triangle.
std::string G2oText(const PoseGraph& graph);

/// Information [1/m^2, 1/rad^2] of z, roll and pitch of a lifted SE2 edge: 0.1 mm and 0.1 mrad.
constexpr double kLiftedInformation = 1e8;

}  // namespace sslcd
