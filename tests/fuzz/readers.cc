// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/image_size.h"
#include "datasets/oxts.h"
#include "datasets/sequence_yaml.h"
#include "datasets/stamps.h"
#include "datasets/tracklets.h"
#include "eval/map_metrics.h"
#include "eval/sequence_metrics.h"
#include "formats/boxes.h"
#include "formats/calib.h"
#include "formats/g2o.h"
#include "formats/loops_csv.h"
#include "formats/map_json.h"
#include "formats/npy.h"
#include "formats/pairs.h"
#include "formats/run_json.h"
#include "input_file.h"
#include "sslcd/config/config.h"
#include "sslcd/formats/detections.h"
#include "sslcd/formats/poses.h"
#include "sslcd/pipeline/options.h"
#include "sslcd/retrieval/site_index.h"
#include "targets.h"

namespace sslcd::fuzz {
namespace {

// Reads what was written from what was read.
template <class Read, class Write>
Target ReadAndWrite(Read read, Write write) {
  return [=](const std::string& bytes) {
    const std::string text = write(read(FileWith(bytes)));
    MustSucceed("reading what was written", [&] { read(FileWith(text)); });
  };
}

template <class Read>
Target ReadOnly(Read read) {
  return [=](const std::string& bytes) { read(FileWith(bytes)); };
}

void LoadConfiguration(const std::string& text) {
  Options options;
  const Describe fields = [&](FieldVisitor& visitor) { DescribeFields(visitor, options); };
  LoadConfigText(text, "config.yaml", fields);
  Check(options);
  const std::string dump = DumpConfig(fields, false);
  MustSucceed("loading a dump", [&] { LoadConfigText(dump, "dump", fields); });
}

// Without the checksum of the content, as of a file that was made to deceive.
void ReadSites(const std::string& bytes) {
  const SiteIndex index(FileWith(bytes), SiteIndexCheck::kHeader);
  std::vector<SiteObject> stretch;
  for (int site = 0; site < index.size() && stretch.size() < 100; ++site)
    for (const SiteObject& object : index.ReadSite(site).objects) stretch.push_back(object);
  index.Find(stretch);
  for (int site = 0; site < index.size(); ++site) index.name(site);
}

// A setting per line.
void Set(const std::string& text) {
  std::vector<std::string> settings(1);
  for (const char c : text)
    if (c == '\n')
      settings.emplace_back();
    else
      settings.back() += c;
  Options options;
  ApplySettings(settings, [&](FieldVisitor& visitor) { DescribeFields(visitor, options); });
}

}  // namespace

Targets Readers() {
  return {
      {"boxes", ReadOnly(ReadBoxes)},
      {"calibration", ReadOnly([](const std::string& path) { ReadCalibration(path); })},
      {"calibration_grey",
       ReadOnly([](const std::string& path) { ReadCalibration(path, CameraPair::kGrey); })},
      {"config", LoadConfiguration},
      {"detections", ReadOnly([](const std::string& path) { ReadDetections(path); })},
      {"g2o", ReadAndWrite(ReadG2o, [](const G2oFile& file) { return G2oText(file.graph); })},
      {"image_size", ReadOnly(ReadImageSize)},
      {"labels", ReadOnly(ReadKittiTrackingLabels)},
      {"landmark_ids", ReadOnly(ReadLandmarkIds)},
      {"loops_csv", ReadAndWrite(ReadLoopsCsv, LoopsCsv)},
      {"map_json", ReadAndWrite(ReadMapJson, MapJson)},
      {"npy", ReadAndWrite(ReadNpy, NpyBytes)},
      {"oxts", ReadOnly(ReadOxts)},
      {"pairs", ReadOnly(ReadLayoutPairFile)},
      {"poses", ReadOnly([](const std::string& path) { ReadPoseFile(path); })},
      {"run_json", ReadAndWrite(ReadRunJson, RunJson)},
      {"sequence_yaml", ReadAndWrite(ReadSequenceYaml, SequenceYamlText)},
      {"settings", Set},
      {"sites", ReadSites},
      {"times", ReadOnly(ReadTimes)},
      {"timestamps", ReadOnly(ReadTimestamps)},
      {"tracklets", ReadOnly(ReadTracklets)},
  };
}

}  // namespace sslcd::fuzz
