# SPDX-License-Identifier: BSD-3-Clause
"""check_surface.py SOURCE_DIR: what a host has to compile stays small: the installed headers, and those behind mapper.h."""
import sys
from pathlib import Path

from check_layers import includes_of, sources_of

MAX_INSTALLED = 51
MAX_BEHIND_MAPPER = 20

include = Path(sys.argv[1]) / "include"


def behind(header):
    """The header and all of ours that it includes."""
    found, left = set(), [header]
    while left:
        one = left.pop()
        if one not in found:
            found.add(one)
            left += [name for _, name in includes_of(include / one) if name.startswith("sslcd/")]
    return found


installed = len(sources_of(include))
mapper = len(behind("sslcd/pipeline/mapper.h"))
print(f"{installed} installed headers (at most {MAX_INSTALLED}), {mapper} behind mapper.h (at most {MAX_BEHIND_MAPPER})")
sys.exit(1 if installed > MAX_INSTALLED or mapper > MAX_BEHIND_MAPPER else 0)
