# SPDX-License-Identifier: BSD-3-Clause
"""check_sizes.py SOURCE_DIR: no source file has more than 400 lines, and each starts with its licence line."""
import sys
from pathlib import Path

MAX_LINES = 400
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause"

root = Path(sys.argv[1])
breaches = []
for folder in ("include", "src", "apps", "tests", "third_party"):
    for path in sorted((root / folder).rglob("*")):
        if path.suffix not in (".h", ".cc"):
            continue
        lines = path.read_text(encoding="utf-8").splitlines()
        if len(lines) > MAX_LINES:
            breaches.append(f"{path.relative_to(root)}: {len(lines)} lines, more than {MAX_LINES}")
        if lines[:1] != [LICENCE]:
            breaches.append(f"{path.relative_to(root)}:1: is not '{LICENCE}'")
print("\n".join(breaches) if breaches else "sizes: ok")
sys.exit(1 if breaches else 0)
