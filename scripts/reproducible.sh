#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the commit that is checked out twice, in two folders and at two times, and compares what is
# installed and the packages of cpack, byte by byte. Names the files that differ; exit code 1 if
# there are any. Takes 20 minutes of two cores.
#   scripts/reproducible.sh [options of cmake]    e.g. -DCMAKE_UNITY_BUILD=ON, in half of the time
# SSLCD_JOBS: processes at a time (2). SSLCD_WORK: where to build (default: a folder in /tmp that is
# removed); what is built there is not built again. The second build does not use ccache.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${SSLCD_JOBS:-2}
work=${SSLCD_WORK:-}
if [[ -z $work ]]; then
  work=$(mktemp -d -t sslcd_reproducible_XXXXXX)
  trap 'rm -rf "$work"' EXIT
fi
work=$(realpath -m "$work")
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
if [[ -n $(git status --porcelain --untracked-files=no) ]]; then
  echo "note: changes that are not committed are left out" >&2
fi

build() {  # FOLDER CCACHE_DISABLE <options>...
  local source=$1/sslcd disable=$2
  shift 2
  mkdir -p "$(dirname "$source")"
  [[ -d $source ]] || git clone -q . "$source"
  git -C "$source" fetch -q "$PWD" HEAD
  git -C "$source" checkout -q "$(git rev-parse HEAD)"
  (
    cd "$source"
    [[ $disable -eq 0 ]] || export CCACHE_DISABLE=1
    cmake --preset package "$@" >/dev/null
    nice -n 5 cmake --build build/package -j "$jobs" | tail -1
    rm -rf out
    DESTDIR=$source/out/installed cmake --install build/package >/dev/null
    (cd build/package && cpack -B "$source/out/packages" >/dev/null)
    rm -rf out/packages/_CPack_Packages
    (cd out && find . \( -type f -o -type l \) -print0 | sort -z | xargs -0 sha256sum) >"$source.sums"
  )
}
build "$work/one" 0 "$@"
sleep 2
build "$work/two/in/a/longer/path" 1 "$@"
one=$work/one/sslcd.sums two=$work/two/in/a/longer/path/sslcd.sums
if ! diff "$one" "$two" >"$work/differences"; then
  echo "these files differ:"
  awk '/^[<>]/ {print "  " $3}' "$work/differences" | sort -u
  exit 1
fi
echo "$(wc -l <"$one") files are the same; sha256 of all: $(sha256sum <"$one" | cut -d' ' -f1)"
