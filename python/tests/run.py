# SPDX-License-Identifier: BSD-3-Clause
"""run.py [arguments of pytest]: runs the tests of this folder, or those named; exit code 77 where
something that they need is missing."""

import importlib
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))


def main():
    for needed in ("numpy", "pytest"):
        try:
            importlib.import_module(needed)
        except ImportError as problem:
            print(
                f"SKIPPED: {sys.executable}: {problem} (scripts/install_deps.sh test installs it)"
            )
            return 77
    import pytest

    return pytest.main(["-q", "-rs", "-p", "no:cacheprovider", *(sys.argv[1:] or [FOLDER])])


if __name__ == "__main__":
    sys.exit(main())
