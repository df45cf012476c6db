// SPDX-License-Identifier: BSD-3-Clause
#include "check_dataset.h"

#include "sslcd/core/log.h"

namespace sslcd::apps {

check::CheckReport CheckDataset(const DatasetRequest& request, const Dataset& dataset) {
  const std::string& path = dataset.detections_path;
  const bool is_xml = path.size() > 4 && path.substr(path.size() - 4) == ".xml";  // tracklets
  DetectionFile file;
  if (!path.empty() && !is_xml) file = ReadDetections(path, request.detection_options);
  return check::CheckSequence(check::MakeSequence(dataset, file));
}

check::CheckReport WarnOfMistakes(const DatasetRequest& request, const Dataset& dataset) {
  check::CheckReport report = CheckDataset(request, dataset);
  for (const auto& line : report.lines)
    if (const auto& mistake = line.outcome.mistake)
      Log(LogLevel::kWarning, "check: " + mistake->id + ": " + mistake->evidence +
                                  ". Try: " + check::MistakeOf(mistake->id).fix);
  return report;
}

}  // namespace sslcd::apps
