# SPDX-License-Identifier: BSD-3-Clause
"""symbols_test.py INCLUDE_DIR LIBRARY...: the shared libraries show what the installed headers declare, and nothing else.

A symbol of Ceres, Eigen or the standard library would be shared with a host, which may have another version of them.
"""
import re
import subprocess
import sys
from pathlib import Path

# Private functions of sslcd::sslcd that sslcd::vision calls.
FOR_VISION = {"ProjectCuboid", "ReadBoxes", "ReadFileBytes", "ReadNpy", "RequireRegularFile"}
# Private functions and classes of sslcd::sslcd that sslcd::store uses.
FOR_STORE = {"Explain", "FileLock", "Gallery", "Hexadecimal", "RequireRegularFile", "Sha256", "Sightings", "UtcTime"}
OURS = re.compile(r"_Z(N|NK|TIN|TSN|TVN)5sslcd")  # the symbol's name: in namespace sslcd, or typeinfo or vtable of it


def output(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout


def is_declared(mangled, plain):
    """Whether the headers have the names of a symbol: its class, if any, and its own."""
    names = set(re.findall(r"\w+", re.search(r"sslcd::(\w+(::[\w~]+)?)", plain).group(1))) if OURS.match(mangled) else ()
    return bool(names) and (names <= DECLARED or names <= FOR_VISION or bool(names & FOR_STORE))


headers = "\n".join(path.read_text(encoding="utf-8") for path in sorted(Path(sys.argv[1]).rglob("*.h")))
DECLARED = set(re.findall(r"\w+", re.sub(r"//.*", "", headers))) - {"Impl"}
failed = False
for library in sys.argv[2:]:
    rows = [line.split() for line in output("nm", "--dynamic", "--defined-only", library).splitlines()]
    mangled = sorted({name.split("@")[0] for _, kind, name in rows if kind != "A"})  # A: the version itself
    plain = output("c++filt", input="\n".join(mangled)).splitlines()
    strange = [name for symbol, name in zip(mangled, plain) if not is_declared(symbol, name)]
    print(f"{library}: {len(mangled)} symbols, {len(strange)} that no installed header declares")
    print("\n".join(strange))
    failed |= bool(strange) or not mangled
sys.exit(1 if failed else 0)
