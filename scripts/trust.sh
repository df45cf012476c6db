#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs worlds that repeat themselves, whose odometry fails or is exact, and real sequences with true
# poses, and writes what may be trusted: wrong loops, harm to trajectories, recall, reliability of
# scores, and covariances of loops.
#   scripts/trust.sh [--worlds 'b2_*,h_*'] [--seeds 1,2,3] [--jobs 2] [--out runs/trust]
# Exit status 1 if a loop is wrong or a trajectory is worse than its odometry (by 2 % and 2 cm;
# in all, horizontally or in height).
# SSLCD_BUILD_DIR: where sslcd_run was built (default build/release). SSLCD_DATA_DIR: real data
# (default ../shared/data). SSLCD_TOOLS_DIR: the generator aliased_worlds.py and the judge
# eval_sequence.py (default: tools beside the data). Needs python3 with NumPy.
set -euo pipefail
cd "$(dirname "$0")/.."
data=${SSLCD_DATA_DIR:-../shared/data}
exec python3 -B scripts/measure/trust.py --build "${SSLCD_BUILD_DIR:-build/release}" \
  --data "$data" --tools "${SSLCD_TOOLS_DIR:-$data/../tools}" "$@"
