// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sslcd/core/camera.h"
#include "sslcd/core/label.h"

namespace sslcd {

/// A file, or the files of a folder, as they were when the record was made.
struct FileRecord {
  std::string name;  ///< of a file of the run; the path of an input
  std::string role;  ///< of an input: "odometry", "detections", ...
  int files = 1;     ///< number of files, if it is a folder
  std::uint64_t bytes = 0;
  /// of the file, in hexadecimal; of a folder, of its files one after the other, in order of their
  /// names. Empty: not computed.
  std::string sha256;
};

/// What one test of the dataset has found (docs/check.md).
struct CheckRecord {
  std::string check;         ///< name of the test
  std::string result;        ///< "ok", "not testable" or "mistake"
  std::string text;          ///< what was measured, or why nothing could be
  std::string mistake, fix;  ///< of a mistake: its name, and what to change
};

/// The content of run.json: how a run came about (docs/formats.md).
struct RunRecord {
  std::string version, commit;  ///< of the program
  std::vector<std::string> command;
  std::string dataset, format;  ///< name of the sequence, format of its folder
  LabelTable labels;            ///< symmetries of the labels
  std::string started;          ///< UTC, "2026-01-31T12:00:00Z"
  bool complete = true;         ///< false: interrupted, or ended by an error
  double wall_s = 0, cpu_s = 0;
  std::vector<std::pair<std::string, double>> counts;
  std::vector<std::string> warnings;
  std::optional<std::vector<CheckRecord>> check;  ///< none: the dataset was not tested
  std::optional<Camera> camera;                   ///< the left one; none: no calibration
  std::vector<FileRecord> inputs;
  std::vector<FileRecord> files;  ///< all other files of the run folder
};

/// Returns the text of run.json, version 1.
std::string RunJson(const RunRecord& record);

/// Reads run.json. Throws Error(kBadInput) with file and line.
RunRecord ReadRunJson(const std::string& path);

/// Describes bytes that are a file's content.
FileRecord RecordOf(const std::string& name, const std::string& content);

/// Reads and describes a file, or the files of a folder (not of its subfolders). Without `hash`
/// nothing is read but the sizes. Throws Error(kBadInput) if the path cannot be read.
FileRecord RecordFile(const std::string& path, bool hash = true);

}  // namespace sslcd
