// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_ply.h"

#include "formats/number_text.h"
#include "formats/ply.h"

namespace sslcd {

std::string RunPly(const RunScene& scene) {
  PlyMesh mesh;
  std::string up;
  for (int axis = 0; axis < 3; ++axis) up += " " + ShortestNumber(scene.gravity.up[axis]);
  mesh.comments = {"sslcd, metres, up:" + up};
  const Solid box = UnitBox(), cylinder = UnitCylinder();
  for (const auto& [name, colour, round, object] : scene.objects)
    mesh.AddSolid(round ? cylinder : box, object.T_world_object, object.dims, colour);
  for (const RunScene::Path& path : scene.paths) mesh.AddLine(path.points, path.colour);
  for (const RunScene::Loop& loop : scene.loops)
    mesh.AddLine({loop.match, loop.query}, loop.colour);
  return PlyText(mesh);
}

}  // namespace sslcd
