// SPDX-License-Identifier: BSD-3-Clause
// What the tests of eval share about the world outside: files, real data and reference
// implementations in Python.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sslcd/core/pose.h"

namespace sslcd::outside {

namespace fs = std::filesystem;

inline fs::path SourceDir() { return SSLCD_SOURCE_DIR; }

inline fs::path DataDir() {
  const char* set = std::getenv("SSLCD_DATA_DIR");
  return set != nullptr ? fs::path(set) : SourceDir() / "../shared/data";
}

inline fs::path ToolsDir() {
  const char* set = std::getenv("SSLCD_TOOLS_DIR");
  return set != nullptr ? fs::path(set) : DataDir() / "../tools";
}

/// A folder of its own, gone at the end.
class TempDir {
 public:
  TempDir() {
    std::string name = (fs::temp_directory_path() / "sslcd_eval_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TempDir() { fs::remove_all(path_); }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline fs::path WriteFile(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

inline std::string Quoted(const fs::path& path) { return "'" + path.string() + "'"; }

struct CommandResult {
  int status = 0;
  std::string output;
};

inline CommandResult RunCommand(const std::string& command) {
  CommandResult result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe))
    result.output.append(buffer, n);
  result.status = WEXITSTATUS(pclose(pipe));
  return result;
}

/// Whether python3 can import the modules, e.g. "numpy, shapely".
inline bool PythonHas(const std::string& modules) {
  return RunCommand("python3 -c 'import " + modules + "'").status == 0;
}

/// Lines of numbers; KITTI's 12 columns are 3x4 matrices, row by row.
inline std::vector<std::vector<double>> ReadNumbers(const fs::path& path, char separator = ' ') {
  std::ifstream file(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    for (char& c : line) c = c == separator ? ' ' : c;
    std::istringstream stream(line);
    std::vector<double> row;
    for (double v; stream >> v;) row.push_back(v);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

inline std::vector<Pose> ReadKittiPoses(const fs::path& path) {
  std::vector<Pose> poses;
  for (const std::vector<double>& row : ReadNumbers(path)) {
    poses.push_back(Pose::FromMatrix(
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(row.data())));
  }
  return poses;
}

inline std::string KittiText(const std::vector<Pose>& poses) {
  std::ostringstream text;
  text.precision(17);
  for (const Pose& T : poses) {
    const Eigen::Matrix<double, 3, 4> M = T.matrix3x4();
    for (int i = 0; i < 12; ++i) text << M(i / 4, i % 4) << (i < 11 ? " " : "\n");
  }
  return text.str();
}

inline std::string TumText(const std::vector<double>& stamps, const std::vector<Pose>& poses) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3& t = poses[i].translation();
    const auto& q = poses[i].unit_quaternion();
    text << stamps[i] << ' ' << t.x() << ' ' << t.y() << ' ' << t.z() << ' ' << q.x() << ' '
         << q.y() << ' ' << q.z() << ' ' << q.w() << '\n';
  }
  return text.str();
}

}  // namespace sslcd::outside
