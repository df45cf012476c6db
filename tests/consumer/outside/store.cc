// SPDX-License-Identifier: BSD-3-Clause
#include <sslcd/store/map_session.h>

// A map of one frame, written and read.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  sslcd::MapSession session = sslcd::MapSession::Begin(argv[1], {"first"}, {}, std::nullopt);
  session.AddFrame({});
  session.End();
  const sslcd::MapStore store(argv[1]);
  return store.Verify().empty() && store.Results().paths.size() == 1 ? 0 : 1;
}
