// SPDX-License-Identifier: BSD-3-Clause
#include "formats/run_json.h"

#include "temp_folder.h"

namespace sslcd {
namespace {

TEST(RunJson, ReadsWhatItWrites) {
  RunRecord record;
  record.version = "1.2.3";
  record.commit = "0123456789ab";
  record.command = {"sslcd_run", "run", "a folder"};
  record.dataset = "0007";
  record.format = "kitti-tracking";
  record.labels.Set("Tree", {Symmetry::kFull});
  record.started = "2026-01-31T12:00:00Z";
  record.complete = false;
  record.wall_s = 1.5;
  record.cpu_s = 2.25;
  record.counts = {{"frames", 40}, {"odometry_scale", 1.03}};
  record.warnings = {"calib.txt: \"</script>\""};
  record.check = {{"stamps", "ok", "steps of 0.1 s", "", ""},
                  {"scores", "mistake", "up to 98", "score_percent", "divide by 100"}};
  record.camera = Camera{700.25, 701, 600, 180, {.06, 0, 0}, 1242, 375};
  record.inputs = {{"data/odometry.txt", "odometry", 1, 12, "ab"},
                   {"data/image_2", "left images", 40, 3000000000u, ""}};
  record.files = {{"map.json", "", 1, 7, "cd"}};
  const TempFolder folder;
  const RunRecord read = ReadRunJson(folder.Write("run.json", RunJson(record)));
  EXPECT_EQ(RunJson(read), RunJson(record));
  EXPECT_EQ(read.inputs[1].bytes, 3000000000u);
  EXPECT_EQ(read.inputs[1].files, 40);
  EXPECT_FALSE(read.complete);
  EXPECT_EQ(read.check->at(1).mistake, "score_percent");
  EXPECT_EQ(read.camera->offset.x(), .06);
  EXPECT_FALSE(ReadRunJson(folder.Write("run.json", RunJson({}))).check) << "was not tested";
}

TEST(RunJson, RefusesOtherFiles) {
  const TempFolder folder;
  for (const char* text : {"{}", "{\"format\":\"sslcd-map\",\"version\":1}", "[", ""})
    EXPECT_THROW(ReadRunJson(folder.Write("run.json", text)), Error) << text;
  std::string newer = RunJson({});
  newer.replace(newer.find("\"version\":1"), 11, "\"version\":2");
  EXPECT_THROW(ReadRunJson(folder.Write("run.json", newer)), Error);
  RunRecord record;
  record.files = {{"map.json", "", 1, 7, "cd"}};
  const std::string text = RunJson(record), bytes = "\"bytes\":7";
  ASSERT_NE(text.find(bytes), std::string::npos);
  for (const char* size : {"-1", "1e300"}) {
    std::string wrong = text;
    wrong.replace(wrong.find(bytes) + bytes.size() - 1, 1, size);
    EXPECT_THROW(ReadRunJson(folder.Write("run.json", wrong)), Error) << size;
  }
}

TEST(RecordFile, DescribesFilesAndFolders) {
  const TempFolder folder;
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  const FileRecord file = RecordFile(folder.Write("in/2.txt", "c"));
  EXPECT_EQ(file.bytes, 1u);
  folder.Write("in/1.txt", "ab");
  folder.Write("in/deeper/3.txt", "d");
  const FileRecord all = RecordFile(folder.In("in"));
  EXPECT_EQ(all.files, 2);
  EXPECT_EQ(all.bytes, 3u);
  EXPECT_EQ(all.sha256, abc);
  EXPECT_EQ(RecordOf("x", "abc").sha256, abc);
  EXPECT_EQ(RecordFile(folder.In("in"), false).sha256, "");
  EXPECT_THROW(RecordFile(folder.In("none")), Error);
}

}  // namespace
}  // namespace sslcd
