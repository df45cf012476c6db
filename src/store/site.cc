// SPDX-License-Identifier: BSD-3-Clause
#include "store/site.h"

#include <limits>
#include <sstream>

#include "sslcd/config/config.h"
#include "sslcd/core/error.h"

namespace sslcd {
namespace {

std::string AxisText(const Vec3& axis) {
  std::ostringstream text;
  text << "(" << axis.x() << " " << axis.y() << " " << axis.z() << ")";
  return text.str();
}

// The first line of `there` that differs from `here`, for a message.
std::string Difference(const std::string& there, const std::string& here) {
  std::istringstream a(there), b(here);
  std::string line_a, line_b;
  while (std::getline(a, line_a) && std::getline(b, line_b))
    if (line_a != line_b) return "'" + line_a + "' there, '" + line_b + "' here";
  return "one has more keys than the other";
}

void ReadSite(Database& database, MapInfo& info) {
  Statement row(database,
                "SELECT up_x, up_y, up_z, config, created, fx, fy, cx, cy, offset_x, offset_y, "
                "offset_z, width, height FROM site");
  if (!row.Step()) return;
  info.up_axis = Vec3(row.Finite(0), row.Finite(1), row.Finite(2));
  info.config = row.Text(3);
  info.created = row.Text(4);
  if (row.IsNull(5)) return;
  info.camera = Camera{row.Real(5),
                       row.Real(6),
                       row.Real(7),
                       row.Real(8),
                       Vec3(row.Real(9), row.Real(10), row.Real(11)),
                       row.Int(12),
                       row.Int(13)};
}

std::vector<SessionInfo> ReadSessions(Database& database) {
  std::vector<SessionInfo> sessions;
  Statement row(database,
                "SELECT id, name, state, frame_offset, frames, last_frame, inputs, checksum, "
                "dataset, command, program, started FROM session ORDER BY id");
  while (row.Step()) {
    SessionInfo session;
    session.id = row.Int(0);
    session.name = row.Text(1);
    session.ended = row.Text(2) == "ended";
    session.frame_offset = row.Int(3);
    session.frames = row.Int(4);
    if (!row.IsNull(5)) session.last_frame = row.Int(5);
    session.inputs = row.Int(6);
    session.checksum = row.Blob(7);
    session.dataset = row.Text(8);
    session.command = row.Text(9);
    session.program = row.Text(10);
    session.started = row.Text(11);
    sessions.push_back(std::move(session));
  }
  return sessions;
}

}  // namespace

MapInfo ReadInfo(Database& database) {
  MapInfo info;
  ReadSite(database, info);
  Statement label(database, "SELECT name, symmetry FROM label");
  while (label.Step())
    if (const auto symmetry = ParseSymmetry(label.Text(1)))
      info.labels.Set(label.Text(0), {*symmetry});
  for (const CueRow& row : kCueRows) {
    Statement cue(database, "SELECT length FROM cue WHERE name = ?");
    cue.BindText(row.name);
    info.vector_length[row.cue] = cue.Step() ? cue.Int(0) : 0;
  }
  info.sessions = ReadSessions(database);
  info.file_bytes = database.Integer("PRAGMA page_count") * database.Integer("PRAGMA page_size");
  return info;
}

void WriteNewSite(Database& database, const MapInfo& info) {
  Statement row(database, "INSERT INTO site VALUES (1, ?,?,?, ?, ?,?,?,?, ?,?,?, ?,?, ?)");
  for (int i = 0; i < 3; ++i) row.Bind(info.up_axis[i]);
  row.BindText(info.config);
  if (const auto& camera = info.camera) {
    row.Bind(camera->fx).Bind(camera->fy).Bind(camera->cx).Bind(camera->cy);
    for (int i = 0; i < 3; ++i) row.Bind(camera->offset[i]);
    row.Bind(camera->width).Bind(camera->height);
  } else {
    constexpr int kCameraColumns = 9;
    for (int i = 0; i < kCameraColumns; ++i) row.BindNull();
  }
  row.BindText(info.created).Run();
  for (const auto& [name, label] : info.labels.entries()) WriteLabel(database, name, label);
}

void WriteLabel(Database& database, const std::string& name, const LabelInfo& label) {
  Statement(database, "INSERT OR IGNORE INTO label VALUES (?, ?)")
      .BindText(name)
      .BindText(ToString(label.symmetry))
      .Run();
}

void WriteVectorLength(Database& database, Cue cue, int length) {
  for (const CueRow& row : kCueRows)
    if (row.cue == cue)
      Statement(database, "INSERT OR IGNORE INTO cue VALUES (?, ?)")
          .BindText(row.name)
          .Bind(length)
          .Run();
}

void WriteSession(Database& database, const SessionInfo& session) {
  Statement row(database,
                "INSERT INTO session VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12) "
                "ON CONFLICT (id) DO UPDATE SET state = ?3, frames = ?5, last_frame = ?6, "
                "inputs = ?7, checksum = ?8");
  row.Bind(session.id).BindText(session.name).BindText(session.ended ? "ended" : "open");
  row.Bind(session.frame_offset).Bind(session.frames);
  if (session.last_frame)
    row.Bind(*session.last_frame);
  else
    row.BindNull();
  row.Bind(session.inputs).BindBlob(session.checksum).BindText(session.dataset);
  row.BindText(session.command).BindText(session.program).BindText(session.started).Run();
}

std::string ConfigText(Options options) {
  return DumpConfig([&](FieldVisitor& visitor) { DescribeFields(visitor, options); }, false);
}

Options OptionsOf(const MapInfo& info, const std::string& path) {
  Options options;
  LoadConfigText(info.config, path + " (options of the map)",
                 [&](FieldVisitor& visitor) { DescribeFields(visitor, options); });
  return options;
}

bool IsSame(const Camera& a, const Camera& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && a.offset == b.offset &&
         a.width == b.width && a.height == b.height;
}

void CheckBelongs(const MapInfo& info, const std::string& path, const MapperContext& context,
                  const std::optional<Options>& options) {
  constexpr double kSameAxis = 1e-6;  // rounding
  if ((context.gravity.up - info.up_axis).norm() > kSameAxis)
    throw Error(
        ErrorKind::kBadInput,
        path + ": is the map of another site: up is " + AxisText(info.up_axis) + " there, and " +
            AxisText(context.gravity.up) +
            " in this drive; name the right map, or the right up_axis in sequence.yaml, or begin "
            "another map");
  for (const auto& [name, label] : context.labels.entries()) {
    const auto known = info.labels.entries().find(name);
    if (known == info.labels.entries().end() || known->second.symmetry == label.symmetry) continue;
    throw Error(ErrorKind::kBadInput,
                path + ": is the map of another site: label '" + name + "' has the symmetry '" +
                    ToString(known->second.symmetry) + "' there, and '" + ToString(label.symmetry) +
                    "' in this drive; name the right map, or begin another one");
  }
  if (!options) return;
  if (const std::string given = ConfigText(*options); given != info.config)
    throw Error(ErrorKind::kUsage,
                path + ": was made with other options: " + Difference(info.config, given) +
                    "; leave the options out to use those of the map, or begin another one");
}

int NumberInMap(int frame, const SessionInfo& session, const std::string& path) {
  if (frame < 0 || session.frame_offset < 0 ||
      frame > std::numeric_limits<int>::max() - session.frame_offset)
    throw Error(ErrorKind::kBadInput,
                path + ": frame " + std::to_string(frame) + " of session '" + session.name +
                    "' has a number out of range: frames count from 0, in all sessions together");
  return frame + session.frame_offset;
}

void CheckVectorLengths(const MapInfo& info, const std::string& path, const Frame& frame) {
  PerCue<int> lengths = info.vector_length;
  for (const Detection& detection : frame.detections)
    for (const CueRow& row : kCueRows) {
      const int length = static_cast<int>(detection.appearance[row.cue].size());
      int& known = lengths[row.cue];
      if (length == 0) continue;
      if (known == 0) known = length;
      if (length != known)
        throw Error(ErrorKind::kBadInput,
                    path + ": frame " + std::to_string(frame.index) + " has a " + row.name +
                        " of " + std::to_string(length) + " numbers, those of the map have " +
                        std::to_string(known) +
                        ": they come from another model; use the one that the map was made with");
    }
}

}  // namespace sslcd
