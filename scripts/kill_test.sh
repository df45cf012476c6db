#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Kills runs with a map at random moments, and checks that nothing is lost that was reported as
# stored and that the end is that of an uninterrupted run (tests/cli/kill_map.py).
#   scripts/kill_test.sh [KILLS [SEED]]      default: 200 kills, about six minutes
# SSLCD_BUILD_DIR: build folder of sslcd_run and sslcd_sim (default build/release).
set -euo pipefail
cd "$(dirname "$0")/.."
apps=${SSLCD_BUILD_DIR:-build/release}/apps
drive=$(mktemp -d)
trap 'rm -rf "$drive"' EXIT
"$apps/sslcd_sim" lot --out "$drive/lot" --seed 3 --frames 300 >/dev/null
python3 -B tests/cli/kill_map.py "$apps/sslcd_run" "$drive/lot" "${1:-200}" "${2:-7}"
