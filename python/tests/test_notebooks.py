# SPDX-License-Identifier: BSD-3-Clause
import os
import subprocess
import sys

import pytest

from conftest import SOURCE

NOTEBOOKS = sorted((SOURCE / "python" / "notebooks").glob("*.py"))


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook, tmp_path):
    if "sslcd.plot" in notebook.read_text():
        pytest.importorskip("matplotlib")
    environment = {**os.environ, "MPLBACKEND": "Agg"}
    command = [sys.executable, "-B", notebook]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "loops" in done.stdout
