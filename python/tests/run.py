# SPDX-License-Identifier: BSD-3-Clause
"""run.py [arguments of pytest]: runs the tests of this folder, or those named; exit code 77 where
something that they need is missing.
run.py --extras VENV: runs those of the extras."""

import importlib
import os
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
EXTRAS = ("test_bags.py", "test_docs.py", "test_notebooks.py", "test_plot.py")


def main():
    for needed in ("numpy", "pytest"):
        try:
            importlib.import_module(needed)
        except ImportError as problem:
            print(
                f"SKIPPED: {sys.executable}: {problem} (scripts/install_deps.sh test installs it)"
            )
            return 77
    if sys.argv[1:2] == ["--extras"]:
        return run_with_extras(sys.argv[2])
    import pytest

    return pytest.main(["-q", "-rs", "-p", "no:cacheprovider", *(sys.argv[1:] or [FOLDER])])


def run_with_extras(venv):
    """The tests of the extras, in a virtual environment with what they need from PyPI."""
    python = os.path.join(venv, "bin", "python")
    make = [sys.executable, "-m", "venv", "--system-site-packages", venv]
    # pybind11 of a distribution may know no newer NumPy than that of the distribution
    newest = int(importlib.import_module("numpy").__version__.split(".")[0])
    install = [python, "-m", "pip", "install", "--quiet", f"numpy<{newest + 1}"]
    install += ["rosbags", "matplotlib"]
    install += ["--retries", "1", "--timeout", "15"]  # without a network: soon
    for command in (make, install):
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=150)
            problem = (done.stdout + done.stderr).strip()[-500:] if done.returncode else ""
        except subprocess.TimeoutExpired:
            problem = "takes too long"
        if problem:
            print(f"SKIPPED: {' '.join(command)}: {problem}")
            return 77
    tests = [os.path.join(FOLDER, name) for name in EXTRAS]
    return subprocess.run([python, "-B", __file__, *tests]).returncode


if __name__ == "__main__":
    sys.exit(main())
