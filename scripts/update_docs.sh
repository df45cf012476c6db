#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes config/default.yaml and docs/configuration.md from the field tables of the program, and the
# schema of docs/store.md and the table of docs/check.md from their sources. With --check it only compares them (exit code 1 if they
# are out of date).
#   scripts/update_docs.sh SSLCD_RUN [--check]
set -euo pipefail
run=$(realpath "${1:?usage: scripts/update_docs.sh SSLCD_RUN [--check]}")
[[ -x $run ]] || { echo "$1: no program: build it first" >&2; exit 2; }
cd "$(dirname "$0")/.."

configuration() {
  cat <<'TEXT'
# Configuration

`sslcd_run run` starts from the defaults of its mode (`--mode robust|paper`, or `mode:` in the
file), then applies the file given with `--config`, then each `--set section.key=value`. What a file
leaves out keeps its default. Everything is strict, and all problems are reported at once, with exit
code 4:
```
error: config/mine.yaml:3:3: unknown key 'max_iteratons' in 'ba' - did you mean 'max_iterations'?
config/mine.yaml:7:12: 'correlation' is 1000, must be in [1, 100]
```
`sslcd_run check-config FILE` checks a file, `sslcd_run dump-config` prints the configuration that a
run would use; every run folder holds its own as `config.yaml`. `config/default.yaml` holds all
defaults, `config/paper.yaml` what `mode: paper` changes. Units are the suffix of a key (`_m`, `_s`,
`_rad`, `_px`, `_mps`).

Paths in a file (`vision.detector`, `vision.embedder`, `vision.lift.classes`,
`vision.inference.library`) are relative to that file, or else to the current folder; on the command
line they are relative to the current folder. The `config.yaml` of a run names what was found by its
absolute path. A file in the data set must not name a library, whose code would run: give it with
`--set` or in the environment's `SSLCD_ORT_LIB`.

This page is written by `scripts/update_docs.sh` from the same field tables that load the files.

TEXT
  "$run" dump-config --markdown
}

defaults() {
  echo "# The defaults (sslcd_run dump-config). Keys that a file leaves out keep these values."
  "$run" dump-config
}

store() {
  sed '/^<!-- schema -->$/q' docs/store.md
  echo '```sql'
  sed -n '/R"sql(/,/^)sql"/p' src/store/schema_sql.h | sed '1d;$d'
  echo '```'
  sed -n '/^<!-- \/schema -->$/,$p' docs/store.md
}

mistakes() {
  sed '/^<!-- mistakes -->$/q' docs/check.md
  "$run" check --mistakes
  sed -n '/^<!-- \/mistakes -->$/,$p' docs/check.md
}

if [[ ${2:-} == --check ]]; then
  diff <(configuration) docs/configuration.md && diff <(defaults) config/default.yaml &&
    diff <(store) docs/store.md && diff <(mistakes) docs/check.md ||
    { echo "out of date: run scripts/update_docs.sh"; exit 1; }
  exit 0
fi
configuration >docs/configuration.md
page=$(store)
echo "$page" >docs/store.md
page=$(mistakes)
echo "$page" >docs/check.md
defaults >config/default.yaml
