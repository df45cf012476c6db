# SPDX-License-Identifier: BSD-3-Clause
"""check_surface.py SOURCE_DIR: the installed headers.

- What a host has to compile stays small: their number, and those behind mapper.h.
- Each marks its namespace as visible in a shared library (core/export.h).
- sslcd.h includes all of sslcd::sslcd.
"""
import re
import sys
from pathlib import Path

from check_layers import OPT_IN, includes_of, sources_of

MAX_INSTALLED = 60  # two of them are for convenience: sslcd.h, and export.h with the marks
MAX_BEHIND_MAPPER = 20

source = Path(sys.argv[1])
include = source / "include"


def behind(header):
    """The header and all of ours that it includes."""
    found, left = set(), [header]
    while left:
        one = left.pop()
        if one not in found and (include / one).exists():  # version.h is made by CMake
            found.add(one)
            left += [name for _, name in includes_of(include / one) if name.startswith("sslcd/")]
    return found


def of_the_library():
    """The headers of sslcd::sslcd: of the modules before its sslcd_library()."""
    top = (source / "CMakeLists.txt").read_text(encoding="utf-8").split("\nsslcd_library(sslcd)")[0]
    modules = re.findall(r"^sslcd_module\((\w+)", top, re.M)
    return {path.relative_to(include).as_posix() for module in modules
            for path in sources_of(include / "sslcd" / module)} - {name.removeprefix("include/") for name in OPT_IN}


breaches = []
installed = {path.relative_to(include).as_posix() for path in sources_of(include)}
for name in sorted(installed - {"sslcd/sslcd.h", "sslcd/core/export.h"}):
    namespaces = re.findall(r"^namespace (.*) {$", (include / name).read_text(encoding="utf-8"), re.M)
    if not namespaces or set(namespaces) != {"SSLCD_EXPORT sslcd"}:
        breaches.append(f"include/{name}: its namespace is not `namespace SSLCD_EXPORT sslcd {{`")
    if "sslcd/core/export.h" not in [include for _, include in includes_of(include / name)]:
        breaches.append(f"include/{name}: does not include sslcd/core/export.h")
left_out = of_the_library() - behind("sslcd/sslcd.h")
breaches += [f"include/sslcd/sslcd.h: does not include {name}" for name in sorted(left_out)]
if len(installed) > MAX_INSTALLED:
    breaches.append(f"{len(installed)} installed headers, at most {MAX_INSTALLED}")
mapper = len(behind("sslcd/pipeline/mapper.h"))
if mapper > MAX_BEHIND_MAPPER:
    breaches.append(f"{mapper} headers behind mapper.h, at most {MAX_BEHIND_MAPPER}")
print("\n".join(breaches) if breaches else f"{len(installed)} installed headers, {mapper} behind mapper.h")
sys.exit(1 if breaches else 0)
