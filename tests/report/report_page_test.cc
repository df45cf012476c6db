// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_page.h"

#include <cmath>

#include "formats/json.h"
#include "report/markup.h"
#include "report/report_data.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

using testing::HasSubstr;
using testing::Not;

RunView Drive(int frames) {
  RunView run;
  run.folder = "runs/<b>";
  for (int i = 0; i < frames; ++i) {
    run.trajectory.stamps.push_back(100 + .5 * i);
    run.trajectory.poses.push_back(Pose::Trans(4e6 + i, -2, 3 * i));  // far from the origin
  }
  run.odometry = run.truth = run.trajectory;
  run.truth.stamps[1] += .02;  // no frame has that time
  run.metrics_json = "{\n\"ate_m\":0.30000000000000004\n}\n";
  run.timing_json = "{}\n";
  for (int i = 0; i < 3; ++i) {
    MapObject object;
    object.id.value = i;
    object.label = "</script><b>";
    object.T_world_object = Pose(run.gravity.Upright(.5), Vec3(4e6 + 1, -3, 2));
    object.dims = Vec3(4, 2, 1.5);
    object.observations = {{9 - i, 0}, {9, 0}};
    run.map.objects.push_back(object);
  }
  LoopClosure loop;
  loop.query_frame = 2;
  loop.T_match_query = Pose::Trans(2, 0, 5);  // 1 m off
  loop.pairs = {{{1}, {2}}};
  run.loops = {loop, loop, loop, loop};
  return run;
}

JsonValue Parsed(const RunView& run, const ReportLimits& limits = {}) {
  const TempFolder folder;
  return ReadJson(folder.Write("data.json", ReportJson({run}, {"a <b> name"}, limits)))
      .Child("runs")
      .List()[0];
}

TEST(ReportJson, MillimetresFromTheFirstCameraInTheAxesOfThePage) {
  const JsonValue run = Parsed(Drive(3));
  EXPECT_EQ(run.Child("corrected").Numbers(9),
            (std::vector<double>{0, 0, 0, 1000, 0, -3000, 2000, 0, -6000}));
  EXPECT_EQ(run.Child("stamps").Numbers(3), (std::vector<double>{0, .5, 1}));
  const std::vector<double> turns = run.Child("turns").Numbers(12);
  EXPECT_EQ(std::abs(turns[3]), 10000) << "x right, y up, looking along -z";
  EXPECT_EQ(run.Child("truth").List()[3].kind, JsonValue::Kind::kNull);
  EXPECT_EQ(run.Child("truth").List()[6].Number(), 2000);
  // id, label, x y z, yaw, size, observations, first frame; in order of the first frame
  EXPECT_EQ(run.Child("objects").List()[0].Numbers(11),
            (std::vector<double>{2, 0, 1000, 1000, -2000, 500, 4000, 2000, 1500, 2, 7}));
}

TEST(ReportJson, LoopsAreComparedWithTheTruth) {
  RunView run = Drive(3);
  EXPECT_EQ(Parsed(run).Child("attempts").List()[0].Child("error").Number(), 1);
  run.loops[0].match_frame = 1;
  run.loops[1].match_frame = 77;
  const JsonValue parsed = Parsed(run);
  EXPECT_EQ(parsed.Child("attempts").List()[0].Child("error").kind, JsonValue::Kind::kNull);
  EXPECT_EQ(parsed.Child("attempts").List()[1].Child("error").kind, JsonValue::Kind::kNull);
}

TEST(ReportJson, CropsOfALoopNameTheirImages) {
  RunView run = Drive(3);
  run.crops = {{1, 0, "query", "match"}, {2, 0, "query", "other"}};
  run.crops_note = "2 of 4 loops";
  const JsonValue parsed = Parsed(run);
  ASSERT_EQ(parsed.Child("images").List().size(), 3u) << "each once";
  EXPECT_EQ(parsed.Child("images").List()[0].Text(), "cXVlcnk=");
  EXPECT_EQ(parsed.Child("images_note").Text(), "2 of 4 loops");
  const auto& attempts = parsed.Child("attempts").List();
  EXPECT_EQ(attempts[0].Find("crops"), nullptr);
  EXPECT_EQ(attempts[2].Child("crops").List()[0].Numbers(3), (std::vector<double>{0, 0, 2}));
}

TEST(ReportJson, LongRunsAreThinnedAndSaySo) {
  const JsonValue run = Parsed(Drive(10), {4, 2, 2});
  EXPECT_EQ(run.Child("stride").Integer(), 3);
  EXPECT_EQ(run.Child("stamps").List().size(), 4u);
  EXPECT_EQ(run.Child("objects").List().size(), 2u);
  EXPECT_EQ(run.Child("objects_left_out").Integer(), 1);
  EXPECT_EQ(run.Child("attempts").List().size(), 2u);
  EXPECT_EQ(run.Child("attempts_left_out").Integer(), 2);
}

TEST(ReportJson, AnEmptyRun) {
  RunView run;
  run.metrics_json = run.timing_json = "{}\n";
  const JsonValue parsed = Parsed(run);
  EXPECT_TRUE(parsed.Child("corrected").List().empty());
  EXPECT_EQ(parsed.Child("truth").kind, JsonValue::Kind::kNull);
}

TEST(ReportPage, TextOfTheUserIsNoMarkup) {
  const std::string json = ReportJson({Drive(3)}, {"<b>"});
  EXPECT_THAT(json, Not(HasSubstr("<")));
  EXPECT_EQ(MarkupText("<b class=\"x\">&\x1b</b>"), "&lt;b class=&quot;x&quot;&gt;&amp;&lt;/b&gt;");
  EXPECT_EQ(MarkupText("\xEF\xBF\xBF\xEF\xBF\xBD!\xEF\xBF\xBE"), "\xEF\xBF\xBD!")
      << "U+FFFF, U+FFFE";
  try {
    RequireReportLibraries();
  } catch (const Error& missing) {
    EXPECT_THAT(missing.what(), HasSubstr("libjs-three"));
    return;
  }
  const std::string page = ReportPage(json, "<!-- data -->");
  EXPECT_THAT(page, HasSubstr("<title>&lt;!-- data --&gt;</title>"));
  EXPECT_THAT(page, HasSubstr(">" + json + "</script>"));
  EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
  for (const char* outside : {"src=\"http", "href=\"http", "@import", "<!-- scripts -->"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
}

}  // namespace
}  // namespace sslcd
