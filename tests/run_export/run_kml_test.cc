// SPDX-License-Identifier: BSD-3-Clause
#include "run_export/run_kml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "small_run.h"

namespace sslcd {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(RunKml, ObjectsStandOnTheGround) {
  const std::string kml = RunKml(SceneOf(SmallRun()), {45, 10, std::nullopt, 0});
  EXPECT_THAT(kml, HasSubstr("<Folder><name>Tree&lt;</name>\n<Placemark><name>Tree&lt; 3</name>"));
  EXPECT_THAT(kml, HasSubstr("<description>sightings: 2; size: 4.0 x 2.0 x 1.5 m</description>"));
  EXPECT_THAT(kml, HasSubstr("<extrude>1</extrude><altitudeMode>relativeToGround</altitudeMode>"));
  EXPECT_THAT(kml, HasSubstr(",1.5</coordinates>"));
  EXPECT_THAT(kml, HasSubstr("<color>ff99aa44</color>")) << "of the first label: blue first";
}

TEST(RunKml, LinesLieOnTheGroundOrHaveAltitudes) {
  const RunScene scene = SceneOf(SmallRun());
  const std::string flat = RunKml(scene, {45, 10, std::nullopt, 0});
  EXPECT_THAT(flat, HasSubstr("<coordinates>10,45 10,45.00008998"));
  EXPECT_THAT(flat, Not(HasSubstr("absolute")));
  const std::string high = RunKml(scene, {45, 10, 115.25, 0});
  EXPECT_THAT(high, HasSubstr("<altitudeMode>absolute</altitudeMode><coordinates>10,45,115.25 "));
  EXPECT_THAT(high, Not(HasSubstr("clampToGround")));
}

TEST(RunKml, LoopsSayWhatTheyJoin) {
  RunView run = SmallRun();
  run.loops[1].probability = .98765;
  run.loops[1].pairs = {{{1}, {2}}};
  EXPECT_THAT(RunKml(SceneOf(run), {45, 10, std::nullopt, 0}),
              HasSubstr("<name>loop 2 to 0</name><description>viewpoint change: 180 degrees; "
                        "matched objects: 1; probability: 0.9877</description>"));
  run.loops.clear();
  run.map.objects.clear();
  EXPECT_THAT(RunKml(SceneOf(run), {45, 10, std::nullopt, 0}), Not(HasSubstr("loops")));
}

}  // namespace
}  // namespace sslcd
