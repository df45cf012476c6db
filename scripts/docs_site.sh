#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the documents as a site that any browser opens from its folder, without a server or a
# network, with the reference of the classes. Warnings and links that lead nowhere are errors.
#   scripts/docs_site.sh [OUT]     default build/site; start reading at OUT/index.html
# Browsers search the pages only where a server serves them: mkdocs serve, or python3 -m http.server.
# Needs MkDocs with its Material theme (apt: mkdocs-material), and Doxygen for the reference.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/site}")
if [[ $(mkdocs build --help 2>/dev/null) != *material* ]]; then
  echo "MkDocs or its Material theme is missing: apt install mkdocs-material" >&2
  exit 77
fi
mkdocs build --quiet --strict --site-dir "$out"
if command -v doxygen >/dev/null; then scripts/docs_api.sh "$out/api" >/dev/null; fi
python3 -B scripts/site/check_links.py "$out"
echo "$out/index.html"
