// SPDX-License-Identifier: BSD-3-Clause
#include "formats/boxes.h"

#include <cmath>

#include "formats/text_rows.h"

namespace sslcd {

std::map<int, std::vector<ImageDetection>> ReadBoxes(const std::string& path) {
  std::map<int, std::vector<ImageDetection>> frames;
  TextRows row(path);
  while (row.Next()) {
    if (row.size() != 7)
      row.Fail("found " + std::to_string(row.size()) +
               " columns, expected 'frame label score left top right bottom'");
    const int frame = row.Integer(0);
    if (frame < 0) row.Fail("frame " + std::to_string(frame) + ": frames count from 0");
    ImageDetection detection;
    detection.label = row.Text(1);
    detection.score = row.Number(2);
    detection.box = {row.Number(3), row.Number(4), row.Number(5), row.Number(6)};
    if (!(detection.score >= 0 && detection.score <= 1)) row.Fail("the score must lie in [0, 1]");
    if (!std::isfinite(detection.box.Area()) || !(detection.box.Area() > 0))
      row.Fail("a box without area: expected left < right and top < bottom");
    frames[frame].push_back(detection);
  }
  return frames;
}

}  // namespace sslcd
