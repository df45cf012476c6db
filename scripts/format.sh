#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Formats every C++ file with clang-format 14. With --check it only lists the files that differ
# (exit code 1; 77 without clang-format-14).
set -eu
cd "$(dirname "$0")/.."
if ! command -v clang-format-14 >/dev/null; then
  echo "skipped: no clang-format-14"
  exit 77
fi
case "${1:-}" in
  "") mode="-i" ;;
  --check) mode="--dry-run -Werror" ;;
  *) echo "usage: scripts/format.sh [--check]" >&2; exit 2 ;;
esac
find include src apps python tests bench examples integrations third_party/lie \( -name '*.h' -o -name '*.cc' \) -print0 2>/dev/null |
  xargs -0 clang-format-14 $mode
