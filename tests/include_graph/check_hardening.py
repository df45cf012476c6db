# SPDX-License-Identifier: BSD-3-Clause
"""check_hardening.py BINARY...: programs and shared libraries are built with the flags of SSLCD_HARDEN.

Exit code 1 and a line for each breach; 77 without readelf.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path


def breaches(binary):
    """What a program or a library lacks."""
    text = subprocess.run(["readelf", "-hldW", "--dyn-syms", binary], capture_output=True, text=True, check=True).stdout
    found = []
    if not re.search(r"^\s+Type:\s+DYN", text, re.M):
        found.append("is loaded at a fixed address: not PIE")
    if "GNU_RELRO" not in text:
        found.append("has no read-only relocations: -z relro")
    if not re.search(r"\(FLAGS\).*BIND_NOW|\(FLAGS_1\).*NOW|\(BIND_NOW\)", text):
        found.append("resolves symbols late: -z now")
    if re.search(r"GNU_STACK.* RWE ", text) or "GNU_STACK" not in text:
        found.append("has a stack that can be executed")
    if "(TEXTREL)" in text:
        found.append("has relocations in its code")
    if "__stack_chk_fail" not in text:
        found.append("has no protected stacks: -fstack-protector-strong")
    is_program = "INTERP" in text  # a small library may have no buffer to check
    if is_program and not re.search(r"__\w+_chk@", text.replace("__stack_chk", "")):
        found.append("checks no buffers: _FORTIFY_SOURCE")
    return found


def main():
    if shutil.which("readelf") is None:
        print("skipped: no readelf")
        return 77
    lines = [f"{Path(binary).name} {what}" for binary in sys.argv[1:] for what in breaches(binary)]
    print("\n".join(lines) if lines else f"{len(sys.argv) - 1} binaries are hardened")
    return 1 if lines or len(sys.argv) == 1 else 0


if __name__ == "__main__":
    sys.exit(main())
