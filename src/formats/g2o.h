// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sslcd/core/pose_graph.h"

namespace sslcd {

/// A .g2o file as a graph in 3D.
struct G2oFile {
  PoseGraph graph;
  bool planar = false;   ///< all rows were SE2: z, roll and pitch are zero (up is +z)
  int rows_ignored = 0;  ///< rows of other kinds (landmarks, parameters)
};

/// Reads VERTEX_SE3:QUAT, EDGE_SE3:QUAT, VERTEX_SE2, EDGE_SE2 and FIX rows; rows of other kinds are
/// counted and skipped. Information is the upper triangle, row by row, in the order of the
/// measurement: [translation, rotation] or [x, y, yaw]. It is taken as that of Log(T_from_to^-1
/// T_world_from^-1 T_world_to) in metres and radians, as GTSAM does; g2o itself reads a rotation as
/// the imaginary part of its quaternion, half the angle, which makes its chi2 another number for
/// the same file. SE2 rows are lifted: z, roll and pitch are held at zero with an information of
/// kLiftedInformation. Edges between other than consecutive ids (i -> i + 1) are marked as loops. A
/// file without any vertex rows (odometry and loops only) gets its vertices from its edges: the
/// first at the origin, the others by the shortest way over consecutive edges, where there is one,
/// and over loops where there is none. Throws Error with file:line for bad counts and numbers, NaN,
/// quaternions that are not of unit length, vertices given twice or missing, edges from a vertex to
/// itself and information that is not positive definite.
G2oFile ReadG2o(const std::string& path);

/// VERTEX_SE3:QUAT, FIX and EDGE_SE3:QUAT rows; information in the order [translation, rotation],
/// upper triangle.
std::string G2oText(const PoseGraph& graph);

/// Information [1/m^2, 1/rad^2] of z, roll and pitch of a lifted SE2 edge: 0.1 mm and 0.1 mrad.
constexpr double kLiftedInformation = 1e8;

}  // namespace sslcd
