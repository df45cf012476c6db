// SPDX-License-Identifier: BSD-3-Clause
#include "store/journal.h"

#include <map>

#include "core/sha256.h"
#include "sslcd/core/error.h"
#include "store/frame_bytes.h"

namespace sslcd {
namespace {

struct InputKindRow {
  InputKind kind;
  const char* name;
};
constexpr InputKindRow kInputKinds[] = {{InputKind::kFrame, "frame"},
                                        {InputKind::kSequence, "sequence"},
                                        {InputKind::kRefinement, "refinement"}};

const char* NameOf(InputKind kind) {
  for (const InputKindRow& row : kInputKinds)
    if (row.kind == kind) return row.name;
  return "";
}

InputKind KindNamed(const std::string& name) {
  for (const InputKindRow& row : kInputKinds)
    if (row.name == name) return row.kind;
  return InputKind::kFrame;  // a checksum tells
}

}  // namespace

std::string FirstChecksum() { return std::string(kSha256Bytes, '\0'); }

std::string NextChecksum(const std::string& before, InputKind kind, const std::string& content) {
  return Sha256().Add(before).Add(NameOf(kind)).Add(content).Finish();
}

Frame FrameIn(const StoredInput& input, const std::string& path) {
  try {
    return FrameOf(input.content);
  } catch (const Error& error) {
    ThrowDamaged(path, error.what());
  }
}

void AppendInputs(Database& database, const std::vector<StoredInput>& inputs) {
  Statement insert(database, "INSERT INTO input (session, kind, content) VALUES (?, ?, ?)");
  for (const StoredInput& input : inputs)
    insert.Bind(input.session).BindText(NameOf(input.kind)).BindBlob(input.content).Run();
}

std::vector<std::string> ReadInputs(Database& database, const std::vector<SessionInfo>& sessions,
                                    const std::function<void(const StoredInput&)>& take) {
  struct Found {
    int inputs = 0;
    std::string checksum = FirstChecksum();
  };
  std::map<int, Found> found;
  Statement row(database, "SELECT session, kind, content FROM input ORDER BY id");
  while (row.Step()) {
    const StoredInput input{row.Int(0), KindNamed(row.Text(1)), row.Blob(2)};
    Found& session = found[input.session];
    ++session.inputs;
    session.checksum = NextChecksum(session.checksum, input.kind, input.content);
    take(input);
  }
  std::vector<std::string> problems;
  for (const SessionInfo& session : sessions) {
    const Found& have = found[session.id];
    if (have.inputs != session.inputs)
      problems.push_back("session '" + session.name + "' has " + std::to_string(have.inputs) +
                         " of " + std::to_string(session.inputs) + " inputs");
    else if (have.checksum != session.checksum)
      problems.push_back("session '" + session.name +
                         "' does not have its checksum: its inputs were changed");
  }
  return problems;
}

}  // namespace sslcd
