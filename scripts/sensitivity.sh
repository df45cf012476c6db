#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Halves and doubles each number of the loop options, as far as its range allows, and prints what
# that does to loops, wrong loops, recall and ATE. An option is marked where fewer than nine tenths
# of the loops are left, or where a loop is wrong that was not there with the defaults. Exit status
# 1 if one is marked or a run fails.
#   scripts/sensitivity.sh [--options 'loop.tracks.*'] [--sets 'victoria-park,k_suburb,...']
#                          [--seeds 1] [--jobs 2] [--out runs/sensitivity]
# The worlds among the sets count together. Options of the printed finder and of images are left
# out, since these sets have neither, and so are values that do not fit the other defaults. The
# table is also in OUT/sensitivity.md.
# SSLCD_BUILD_DIR, SSLCD_DATA_DIR, SSLCD_TOOLS_DIR: as for scripts/trust.sh. Needs python3 with
# NumPy.
set -euo pipefail
cd "$(dirname "$0")/.."
data=${SSLCD_DATA_DIR:-../shared/data}
exec python3 -B scripts/measure/sensitivity.py --build "${SSLCD_BUILD_DIR:-build/release}" \
  --data "$data" --tools "${SSLCD_TOOLS_DIR:-$data/../tools}" "$@"
