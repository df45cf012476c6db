// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/run_folder.h"

#include "formats/text_rows.h"
#include "temp_folder.h"

namespace sslcd {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, WritesEveryFileAndNoTemporaryOnes) {
  RunOutputs outputs;
  outputs.trajectory.stamps = outputs.odometry.stamps = outputs.groundtruth.stamps = {0, 0.1};
  outputs.trajectory.poses = outputs.odometry.poses = {Pose(), Pose::Trans(1, 0, 0)};
  outputs.groundtruth.poses = outputs.odometry.poses;
  outputs.map.objects.resize(1);
  outputs.graph.vertices = {{0, Pose(), true}, {1, Pose::Trans(1, 0, 0), false}};
  outputs.timing.Add("data association", 1.5);
  outputs.metrics = {{"ate_m", 1.25}};
  outputs.config_yaml = "mode: robust\n";
  const TempFolder folder;
  const auto paths = WriteRunFolder(folder.In("deep/run"), outputs);
  EXPECT_EQ(paths.size(), 13u);
  EXPECT_EQ(paths, RunFolderPaths(folder.In("deep/run")));
  for (const std::string& path : paths) EXPECT_GT(fs::file_size(path), 0u) << path;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder.In("deep/run"))) ++files;
  EXPECT_EQ(files, paths.size());
  EXPECT_EQ(ReadFileBytes(folder.In("deep/run/config.yaml")), "mode: robust\n");
  EXPECT_EQ(ReadFileBytes(folder.In("deep/run/metrics.json")), "{\n\"ate_m\":1.25\n}\n");
}

TEST(RunFolder, NoticesFilesOfAnotherRun) {
  const TempFolder folder;
  EXPECT_FALSE(CheckRunFolder(folder.In("none")));
  RunOutputs outputs;
  outputs.record.dataset = "first";
  WriteRunFolder(folder.path(), outputs);
  const auto record = CheckRunFolder(folder.path());
  ASSERT_TRUE(record);
  EXPECT_EQ(record->dataset, "first");
  EXPECT_EQ(record->files.size(), RunFolderPaths("").size() - 1);
  for (const FileRecord& file : record->files) {
    const std::string content = ReadFileBytes(folder.In(file.name));
    folder.Write(file.name, content + " ");
    EXPECT_THAT([&] { CheckRunFolder(folder.path()); },
                testing::ThrowsMessage<Error>(testing::HasSubstr(file.name)));
    fs::remove(folder.In(file.name));
    EXPECT_THAT([&] { CheckRunFolder(folder.path()); },
                testing::ThrowsMessage<Error>(testing::HasSubstr(file.name)));
    folder.Write(file.name, content);
  }
  EXPECT_TRUE(CheckRunFolder(folder.path()));
}

}  // namespace
}  // namespace sslcd
