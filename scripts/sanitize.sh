#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds and runs the tests with sanitizers, a part at a time, so that two cores and 8 GB suffice.
#   scripts/sanitize.sh asan                    # AddressSanitizer and UBSan: every part
#   scripts/sanitize.sh tsan                    # ThreadSanitizer: the parts that start threads
#   scripts/sanitize.sh asan formats store cli  # these parts, which are the folders of tests/
# Prints a row for each part: tests, passed, skipped, failed, reports of the sanitizers, seconds of
# the clock. Exit code 1 if there is a failure or a report. Logs: build/asan/PART.log.
# SSLCD_JOBS: processes at a time (2). SSLCD_DATA_DIR: real data. SSLCD_SANITIZE_CTEST: more options
# of ctest, e.g. "-LE slow".
# Not run: tests/consumer (compiles outside projects against plain installs; its installs are those
# of the release build), tests/docs, tests/include_graph, tests/mutate (they run no C++), the Python
# package (the interpreter is not linked with sanitizers), cli.faults and house.hardening (they
# judge plain binaries; faults has cli.mutated_inputs), KeyEffects (a drive for each key, minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:-}
only=()  # which tests
jobs=${SSLCD_JOBS:-2}
case "$kind" in
  asan)
    sanitizers=address,undefined,float-cast-overflow
    only=(-E 'KeyEffects')
    parts="lie core formats datasets config perception association map odometry pose_graph bundle
      loop refine closing change retrieval eval store map_export check report run_export inference
      detectors stereo ground visual_odometry lifting frontend sim render baselines fuzz cli faults
      vins_fusion ros_bridge ros1 examples benchmark pipeline browser" ;;
  tsan)
    sanitizers=thread
    # whole drives on one thread say nothing of races
    only=(-R '\.(unit|property)$|AsyncMapper|StalledMapper|CatchUp|Streaming|BridgeDrive')
    parts="core pipeline frontend loop retrieval benchmark ros_bridge" ;;
  *) sed -n '3,15s/^# \?//p' "$0" >&2; exit 2 ;;
esac
shift
[ $# -eq 0 ] || parts="$*"
build=build/$kind

# -O1: compiles in half of the time of -O2. Eight sources of the libraries at a time.
cmake --preset dev -B "$build" -DSSLCD_SANITIZE=$sanitizers -DSSLCD_BUILD_SHARED=OFF \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -DNDEBUG" >/dev/null

export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1:allocator_may_return_null=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=second_deadlock_stack=1

row() { printf '%-16s %6s %7s %8s %7s %8s %8s\n' "$@"; }
row part tests passed skipped failed reports seconds
all=0 passed=0 skipped=0 failed=0 reports=0
for part in $parts; do
  log=$build/$part.log
  start=$(date +%s)
  case "$part" in
    cli | faults | check | examples | browser | report) tools="sslcd_run sslcd_sim" ;;
    *) tools= ;;
  esac
  if ! nice -n 5 cmake --build "$build" -j "$jobs" --target $tools tests/"$part"/all >"$log" 2>&1; then
    echo "$part: does not build, see $log" >&2
    exit 1
  fi
  ctest --test-dir "$build/tests/$part" -j "$jobs" --timeout 1800 --output-on-failure \
    "${only[@]}" ${SSLCD_SANITIZE_CTEST:-} >"$log" 2>&1 || true
  n=$(grep -c '^ *[0-9]*/[0-9]* Test .*#' "$log" || true)
  s=$(grep -c '\*\*\*Skipped' "$log" || true)
  f=$(grep -cE '\*\*\*(Failed|Exception|Timeout|Not Run)|Subprocess (aborted|killed)' "$log" || true)
  ((n)) || { echo "$part: no test ran, see $log" >&2; exit 1; }
  r=$(grep -cE 'ERROR: (Address|Leak)Sanitizer|WARNING: ThreadSanitizer|: runtime error: ' "$log" || true)
  row "$part" "$n" $((n - s - f)) "$s" "$f" "$r" $(($(date +%s) - start))
  all=$((all + n)) passed=$((passed + n - s - f)) skipped=$((skipped + s)) failed=$((failed + f))
  reports=$((reports + r))
done
row all "$all" "$passed" "$skipped" "$failed" "$reports" ""
[ "$failed" -eq 0 ] && [ "$reports" -eq 0 ]
