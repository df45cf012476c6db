// SPDX-License-Identifier: BSD-3-Clause
#include "store/new_session.h"

#include <algorithm>
#include <limits>

#include "core/utc_time.h"
#include "sslcd/core/error.h"
#include "store/journal.h"

namespace sslcd {

void CheckSessionName(const std::string& name) {
  const bool printable = std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) >= ' ' && c != '/' && c != '\x7f';
  });
  if (name.empty() || name == "." || name == ".." || !printable)
    throw Error(ErrorKind::kUsage, "'" + name +
                                       "' cannot be the name of a session: give it a name "
                                       "without slashes and control characters");
}

SessionInfo NewSession(const MapInfo& info, const std::string& path,
                       const SessionRequest& request) {
  CheckSessionName(request.name);
  SessionInfo session;
  for (const SessionInfo& other : info.sessions) {
    if (!other.ended)
      throw Error(ErrorKind::kUsage, path + ": session '" + other.name +
                                         "' has not been ended; go on with it (--resume), or end "
                                         "it as it is (`sslcd_run map end`)");
    if (other.name == request.name)
      throw Error(ErrorKind::kUsage, path + ": has a session '" + request.name +
                                         "' already; give this one another name (--session)");
    if (other.last_frame == std::numeric_limits<int>::max())
      throw Error(ErrorKind::kUsage, path + ": session '" + other.name +
                                         "' has the largest number that a frame can have; begin "
                                         "another map for this one");
    if (other.last_frame) session.frame_offset = *other.last_frame + 1;
  }
  session.id = info.sessions.empty() ? 1 : info.sessions.back().id + 1;
  session.name = request.name;
  session.checksum = FirstChecksum();
  session.dataset = request.dataset;
  session.command = request.command;
  session.program = request.program;
  session.started = UtcTime();
  return session;
}

}  // namespace sslcd
