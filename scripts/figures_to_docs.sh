#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the tables of README.md, docs/results.md, docs/hosts.md, docs/sessions.md and docs/scale.md between
# `<!-- figures NAME -->` and `<!-- /figures -->` from docs/figures.json. With --check it writes
# nothing and ends with exit code 1 if a table is out of date.
#   scripts/figures_to_docs.sh [--check]
set -euo pipefail
cd "$(dirname "$0")/.."
exec python3 -B scripts/measure/documents.py "$@"
