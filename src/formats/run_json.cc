// SPDX-License-Identifier: BSD-3-Clause
#include "formats/run_json.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/sha256.h"
#include "formats/files.h"
#include "formats/json.h"
#include "formats/json_text.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "sslcd-run";
constexpr double kMostBytes = 1LL << 53;  // what a number of JSON tells exactly

Json JsonOfFile(const FileRecord& file, const char* name) {
  Json json;
  if (!file.role.empty()) json["role"] = file.role;
  json[name] = file.name;
  if (file.files != 1) json["files"] = file.files;
  json["bytes"] = file.bytes;
  if (!file.sha256.empty()) json["sha256"] = file.sha256;
  return json;
}

FileRecord FileOf(const JsonValue& json, const char* name) {
  FileRecord file;
  file.name = json.Child(name).Text();
  if (const JsonValue* role = json.Find("role")) file.role = role->Text();
  if (const JsonValue* files = json.Find("files")) file.files = files->Integer();
  const double bytes = json.Child("bytes").Number();
  if (!(bytes >= 0 && bytes <= kMostBytes)) json.Child("bytes").Fail("expected the size of a file");
  file.bytes = static_cast<std::uint64_t>(bytes);
  if (const JsonValue* hash = json.Find("sha256")) file.sha256 = hash->Text();
  return file;
}

Json JsonOfCheck(const CheckRecord& check) {
  Json json = {{"check", check.check}, {"result", check.result}, {"text", check.text}};
  if (!check.mistake.empty()) {
    json["mistake"] = check.mistake;
    json["fix"] = check.fix;
  }
  return json;
}

CheckRecord CheckOf(const JsonValue& json) {
  CheckRecord check;
  check.check = json.Child("check").Text();
  check.result = json.Child("result").Text();
  check.text = json.Child("text").Text();
  if (const JsonValue* mistake = json.Find("mistake")) check.mistake = mistake->Text();
  if (const JsonValue* fix = json.Find("fix")) check.fix = fix->Text();
  return check;
}

Json JsonOfCamera(const Camera& camera) {
  return {{"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"offset", {camera.offset.x(), camera.offset.y(), camera.offset.z()}},
          {"width", camera.width},
          {"height", camera.height}};
}

Camera CameraOf(const JsonValue& json) {
  Camera camera;
  camera.fx = json.Child("fx").Number();
  camera.fy = json.Child("fy").Number();
  camera.cx = json.Child("cx").Number();
  camera.cy = json.Child("cy").Number();
  camera.offset = Vec3(json.Child("offset").Numbers(3).data());
  camera.width = json.Child("width").Integer();
  camera.height = json.Child("height").Integer();
  return camera;
}

std::vector<std::string> Texts(const JsonValue& list) {
  std::vector<std::string> texts;
  for (const JsonValue& item : list.List()) texts.push_back(item.Text());
  return texts;
}

void AddFile(const std::string& path, bool hash, FileRecord& record, Sha256& sum) {
  std::error_code code;
  const std::uint64_t bytes = fs::file_size(path, code);
  std::ifstream file;
  if (!code && hash) file.open(path, std::ios::binary);
  if (code || (hash && !file)) throw Error(ErrorKind::kBadInput, path + ": cannot be read");
  record.bytes += bytes;
  std::string buffer(1 << 20, '\0');
  while (hash && file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    sum.Add({buffer.data(), static_cast<std::size_t>(file.gcount())});
  }
}

}  // namespace

std::string RunJson(const RunRecord& record) {
  Json root;
  root["format"] = kFormat;
  root["version"] = 1;
  root["program"] = {{"version", record.version}, {"commit", record.commit}};
  root["command"] = record.command;
  root["dataset"] = {{"name", record.dataset}, {"format", record.format}};
  Json& labels = root["labels"] = Json::object();
  for (const auto& [label, info] : record.labels.entries()) labels[label] = ToString(info.symmetry);
  root["started"] = record.started;
  root["complete"] = record.complete;
  root["wall_s"] = record.wall_s;
  root["cpu_s"] = record.cpu_s;
  Json& counts = root["counts"] = Json::object();
  for (const auto& [name, value] : record.counts) counts[name] = value;
  root["warnings"] = record.warnings;
  if (record.camera) root["camera"] = JsonOfCamera(*record.camera);
  if (record.check) {
    Json& check = root["check"] = Json::array();
    for (const CheckRecord& one : *record.check) check.push_back(JsonOfCheck(one));
  }
  Json& inputs = root["inputs"] = Json::array();
  for (const FileRecord& file : record.inputs) inputs.push_back(JsonOfFile(file, "path"));
  Json& files = root["files"] = Json::array();
  for (const FileRecord& file : record.files) files.push_back(JsonOfFile(file, "name"));
  return JsonText(root, root);
}

RunRecord ReadRunJson(const std::string& path) {
  const JsonValue root = ReadJson(path);
  if (root.Child("format").Text() != kFormat) root.Fail("this is not the run.json of a run");
  const int version = root.Child("version").Integer();
  if (version != 1)
    root.Fail("version " + std::to_string(version) + " of run.json; this program reads version 1");
  RunRecord record;
  record.version = root.Child("program").Child("version").Text();
  record.commit = root.Child("program").Child("commit").Text();
  record.command = Texts(root.Child("command"));
  record.dataset = root.Child("dataset").Child("name").Text();
  record.format = root.Child("dataset").Child("format").Text();
  const JsonValue& labels = root.Child("labels");
  for (std::size_t i = 0; i < labels.keys.size(); ++i) {
    const auto symmetry = ParseSymmetry(labels.items[i].Text());
    if (!symmetry) labels.items[i].Fail("a symmetry is none, pi or full");
    record.labels.Set(labels.keys[i], {*symmetry});
  }
  record.started = root.Child("started").Text();
  record.complete = root.Child("complete").number != 0;
  record.wall_s = root.Child("wall_s").Number();
  record.cpu_s = root.Child("cpu_s").Number();
  const JsonValue& counts = root.Child("counts");
  for (std::size_t i = 0; i < counts.keys.size(); ++i)
    record.counts.emplace_back(counts.keys[i], counts.items[i].Number());
  record.warnings = Texts(root.Child("warnings"));
  if (const JsonValue* camera = root.Find("camera")) record.camera = CameraOf(*camera);
  if (const JsonValue* check = root.Find("check"))
    for (const JsonValue& one : (record.check.emplace(), check->List()))
      record.check->push_back(CheckOf(one));
  for (const JsonValue& file : root.Child("inputs").List())
    record.inputs.push_back(FileOf(file, "path"));
  for (const JsonValue& file : root.Child("files").List())
    record.files.push_back(FileOf(file, "name"));
  return record;
}

FileRecord RecordOf(const std::string& name, const std::string& content) {
  FileRecord record;
  record.name = name;
  record.bytes = content.size();
  record.sha256 = Hexadecimal(Sha256().Add(content).Finish());
  return record;
}

FileRecord RecordFile(const std::string& path, bool hash) {
  FileRecord record;
  record.name = path;
  Sha256 sum;
  if (IsFolder(path)) {
    record.files = 0;
    for (const std::string& name : FileNames(path)) {
      const std::string file = (fs::path(path) / name).string();
      if (!IsFile(file)) continue;
      ++record.files;
      AddFile(file, hash, record, sum);
    }
  } else {
    AddFile(path, hash, record, sum);
  }
  if (hash) record.sha256 = Hexadecimal(sum.Finish());
  return record;
}

}  // namespace sslcd
