#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures the figures of README.md and docs/results.md and writes them into docs/figures.json.
# scripts/figures_to_docs.sh then puts them into the documents, and tests hold runs to them.
#   scripts/measure.sh [--only loops,kitti,pairs,city,halv,sessions,relocalise,retrieval,change,fleet,stream,bench,
#                             properties,soak,worlds]
#                      [--force] [--list]
# Skips a set if its code and inputs have not changed since its measurement. Measures `city`
# (two minutes), `halv` (one minute), `sessions` (ten minutes), `relocalise`, `retrieval` and
# `change` (a quarter of an hour each), `fleet` (half an hour), `stream` (six minutes, on a machine with two free cores) and
# `bench` (a quarter of an hour),
# `properties` and `soak` (five minutes each) and `worlds` (20 minutes, goes on where it was
# interrupted) only if they are named. SSLCD_BUILD_DIR: where sslcd_run was built
# (default build/release). SSLCD_DATA_DIR: real data (default ../shared/data); reports and skips sets
# without data. Needs python3; new pairs of layouts need NumPy, `sessions`, `relocalise`,
# `retrieval`, `change` and `stream` -DSSLCD_BUILD_BENCH=ON,
# `fleet` -DSSLCD_BUILD_PYTHON=ON and Dask, `properties` the tests, `soak` -DSSLCD_BUILD_BENCH=ON.
set -euo pipefail
cd "$(dirname "$0")/.."
exec python3 -B scripts/measure/measure.py --build "${SSLCD_BUILD_DIR:-build/release}" \
  --data "${SSLCD_DATA_DIR:-../shared/data}" "$@"
