// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include <cmath>
#include <utility>

namespace sslcd::apps {
namespace {

constexpr double kEvery = 0.1;  // [s]

std::string Duration(double seconds) {
  if (seconds < 100) return Number("%.0f", std::ceil(seconds)) + " s";
  if (seconds < 6000) return Number("%.0f", std::ceil(seconds / 60)) + " min";
  return Number("%.1f", seconds / 3600) + " h";
}

}  // namespace

Progress::Progress(const Console& console, std::string what)
    : console_(console), what_(std::move(what)) {}

void Progress::Report(int done, int total) {
  const Clock::time_point now = Clock::now();
  if (last_ == 0 || done <= last_) {
    start_ = now;
    first_ = done;
  }
  last_ = done;
  if (done != total && now - shown_ < std::chrono::duration<double>(kEvery)) return;
  shown_ = now;
  console_.Status(Line(done, total, std::chrono::duration<double>(now - start_).count()));
}

std::string Progress::Line(int done, int total, double seconds) const {
  std::string line = what_ + " " + std::to_string(done) + "/" + std::to_string(total);
  if (!(seconds > 0) || done == first_) return line;
  const double rate = (done - first_) / seconds;
  line += rate >= 1 ? ", " + Number(rate < 10 ? "%.1f " : "%.0f ", rate) + what_ + "s/s"
                    : ", " + Number("%.1f", 1 / rate) + " s each";
  return done < total ? line + ", " + Duration((total - done) / rate) + " left" : line;
}

}  // namespace sslcd::apps
