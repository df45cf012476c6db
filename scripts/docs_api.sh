#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Writes the reference of the installed headers with Doxygen (apt: doxygen). Warnings are errors.
#   scripts/docs_api.sh [OUT]     default build/api; start reading at OUT/html/index.html
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-build/api}
command -v doxygen >/dev/null || { echo "doxygen is missing: apt install doxygen" >&2; exit 77; }
version=$(sed -n 's/^project(sslcd VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
mkdir -p "$out"
doxygen - <<CONFIG
PROJECT_NAME           = sslcd
PROJECT_NUMBER         = $version
OUTPUT_DIRECTORY       = $out
INPUT                  = include/sslcd docs/api.md
USE_MDFILE_AS_MAINPAGE = docs/api.md
RECURSIVE              = YES
STRIP_FROM_PATH        = .
STRIP_FROM_INC_PATH    = include
GENERATE_LATEX         = NO
EXTRACT_ALL            = YES
HIDE_UNDOC_RELATIONS   = YES
JAVADOC_AUTOBRIEF      = YES
SORT_MEMBER_DOCS       = NO
ENABLE_PREPROCESSING   = YES
MACRO_EXPANSION        = YES
EXPAND_ONLY_PREDEF     = YES
PREDEFINED             = SSLCD_EXPORT= SSLCD_HIDDEN=
HAVE_DOT               = NO
QUIET                  = YES
WARNINGS               = YES
WARN_AS_ERROR          = ${SSLCD_DOXYGEN_WARNINGS:-FAIL_ON_WARNINGS}
CONFIG
echo "wrote $out/html/index.html"
