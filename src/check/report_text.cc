// SPDX-License-Identifier: BSD-3-Clause
#include "check/report_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "formats/json_text.h"

namespace sslcd::check {
namespace {

const char* ResultText(Outcome::Status status) {
  switch (status) {
    case Outcome::Status::kOk: return "ok";
    case Outcome::Status::kNotTestable: return "not testable";
    case Outcome::Status::kMistake: return "MISTAKE";
  }
  return "";
}

std::string Padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

}  // namespace

std::string ReportText(const CheckReport& report) {
  std::size_t width = 0;
  for (const CheckReport::Line& line : report.lines) width = std::max(width, line.check.size());
  std::string text;
  for (const CheckReport::Line& line : report.lines) {
    text += "  " + Padded(line.check, width) + "  " + Padded(ResultText(line.outcome.status), 12) +
            "  ";
    if (const auto& mistake = line.outcome.mistake) {
      const std::string indent = "\n" + std::string(width + 18, ' ');
      const MistakeInfo& info = MistakeOf(mistake->id);
      text += mistake->id + ": " + info.meaning + indent + mistake->evidence + indent +
              "try: " + info.fix;
    } else {
      text += line.outcome.text;
    }
    text += "\n";
  }
  const int count = report.mistakes();
  return text + (count == 0 ? "no mistake found"
                            : std::to_string(count) + (count == 1 ? " mistake" : " mistakes"));
}

std::vector<CheckRecord> Records(const CheckReport& report) {
  std::vector<CheckRecord> records;
  for (const CheckReport::Line& line : report.lines) {
    const auto& mistake = line.outcome.mistake;
    CheckRecord& record = records.emplace_back();
    record.check = line.check;
    record.result = mistake ? "mistake" : ResultText(line.outcome.status);
    record.text = line.outcome.text;
    if (!mistake) continue;
    record.mistake = mistake->id;
    record.fix = MistakeOf(mistake->id).fix;
  }
  return records;
}

std::string ReportJson(const CheckReport& report) {
  nlohmann::ordered_json root, checks = nlohmann::ordered_json::array();
  for (const CheckRecord& record : Records(report)) {
    nlohmann::ordered_json one = {
        {"check", record.check}, {"result", record.result}, {"text", record.text}};
    if (!record.mistake.empty()) {
      one["mistake"] = record.mistake;
      one["fix"] = record.fix;
    }
    checks.push_back(std::move(one));
  }
  root["mistakes"] = report.mistakes();
  root["checks"] = std::move(checks);
  return JsonText(root, root["checks"]);
}

std::string MistakesMarkdown() {
  std::string text =
      "| test | measures | needs | mistake | the data have | try | `--fix` |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Check& check : Checks()) {
    std::string first =
        std::string("| ") + check.name + " | " + check.statistic + " | " + check.samples + " ";
    for (const MistakeInfo& mistake : check.mistakes) {
      text += first + "| `" + mistake.id + "` | " + mistake.meaning + " | " + mistake.fix + " | " +
              (mistake.repairable ? "yes" : "no") + " |\n";
      first = "| | | ";
    }
  }
  return text;
}

}  // namespace sslcd::check
