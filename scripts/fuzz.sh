#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzz targets with clang, runs each of them with random inputs (libFuzzer, ASan, UBSan),
# and prints what was found (docs/trust.md).
#   scripts/fuzz.sh [--seconds 60] [--runs N] [--list] [TARGET...]     default: all but onnx
# A target ends after so many seconds or executions. Exit status 1 if an input crashes it, takes
# longer than a second of CPU time (mapper, async_mapper: 5) or ten seconds of the clock, or makes it
# take more than 1 GB. Such inputs are kept in build/fuzz/found, interesting ones in
# build/fuzz/corpus, from which the next run goes on.
# Needs scripts/install_deps.sh fuzz.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=60 runs=-1
targets=()
while (($#)); do
  case "$1" in
    --seconds) seconds=$2; shift ;;
    --runs) runs=$2; shift ;;
    --list) targets=(--list) ;;
    -*) sed -n '3,11s/^# //p' "$0" >&2; exit 2 ;;
    *) targets+=("$1") ;;
  esac
  shift
done

build=build/fuzz
compiler=$(command -v clang++-14 || command -v clang++) ||
  { echo "no clang: scripts/install_deps.sh fuzz" >&2; exit 1; }
mkdir -p build
cmake --preset fuzz -DCMAKE_CXX_COMPILER="$compiler" >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 1; }
cmake --build --preset fuzz --target sslcd_fuzz >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 1; }
fuzzer=$build/tests/fuzz/sslcd_fuzz
mapfile -t all < <(env -u SSLCD_FUZZ_TARGET "$fuzzer")
if [[ ${targets[*]} == --list ]]; then printf '%s\n' "${all[@]}"; exit; fi
if ((!${#targets[@]})); then
  for target in "${all[@]}"; do
    [[ $target == onnx ]] || targets+=("$target")  # its memory is that of ONNX Runtime
  done
fi

# Files of the targets: in memory where they can be, since an SQLite file waits for the disk.
memory=/dev/shm
[[ -w $memory ]] || memory=${TMPDIR:-/tmp}
TMPDIR=$(mktemp -d "$memory/sslcd_fuzz_XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
stat_of() { sed -n "s/^stat::$1: *//p" "$2"; }
status=0
printf '%-18s %12s %8s %8s %8s %6s %8s\n' target executions 'per s' crashes hangs memory 'peak MB'
for target in "${targets[@]}"; do
  if [[ " ${all[*]} " != *" $target "* ]]; then
    echo "no target $target; scripts/fuzz.sh --list names them" >&2
    exit 2
  fi
  corpus=$build/corpus/$target found=$build/found/$target log=$build/$target.log
  mkdir -p "$corpus" "$found"
  limit=1
  if [[ $target == mapper || $target == async_mapper ]]; then limit=5; fi
  # -entropic=0: to choose inputs by how rare their features are costs more than running them.
  SSLCD_FUZZ_TARGET=$target SSLCD_FUZZ_SECONDS=$limit "$fuzzer" -max_total_time="$seconds" -runs="$runs" \
    -entropic=0 -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=1000 -print_final_stats=1 -artifact_prefix="$found/" "$corpus" \
    "tests/data/fuzz/$target" >"$log" 2>&1 || status=1
  if grep -q '^too slow:' "$log"; then
    slow=$(sed -n 's/.*Test unit written to //p' "$log" | tail -1)
    if [[ -f $slow && $slow == *crash-* ]]; then mv "$slow" "${slow/crash-/timeout-}"; fi
  fi
  printf '%-18s %12s %8s %8s %8s %6s %8s\n' "$target" "$(stat_of number_of_executed_units "$log")" \
    "$(stat_of average_exec_per_sec "$log")" \
    "$(find "$found" \( -name 'crash-*' -o -name 'leak-*' \) | wc -l)" \
    "$(find "$found" -name 'timeout-*' | wc -l)" "$(find "$found" -name 'oom-*' | wc -l)" \
    "$(stat_of peak_rss_mb "$log")"
done
exit $status
