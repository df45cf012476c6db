# SPDX-License-Identifier: BSD-3-Clause
"""The Python code of docs/python.md runs."""

import re

import numpy as np
import pytest

import sslcd
from conftest import SOURCE

BLOCKS = re.findall(r"^```python\n(.*?)^```", (SOURCE / "docs/python.md").read_text(), re.M | re.S)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: block.split("\n")[0])
def test_the_code_runs(block, drive, pair, tmp_path, monkeypatch, capsys):
    (tmp_path / "tests").symlink_to(SOURCE / "tests")
    monkeypatch.chdir(tmp_path)
    names = {"sslcd": sslcd, "drive": drive, "stamp": 0.0, "T_odom_cam": np.eye(4), **pair}
    names["embeddings"] = np.ones((2, 8))
    if "sslcd.plot" in block:
        pytest.importorskip("matplotlib").use("Agg")
    if "sslcd.bags" in block:
        pytest.importorskip("rosbags")
        from bag_case import record

        record("drive.bag", drive)
    exec(compile(block, "docs/python.md", "exec"), names)
    if "ate" in block:
        lines = capsys.readouterr().out.splitlines()
        assert len(lines) > 3 and 0 < float(lines[-1]) < 0.3


def test_the_error_of_the_guide():
    text = (SOURCE / "docs/python.md").read_text()
    call, _, message = re.search(
        r">>> (sslcd\.Mapper.*)\n(sslcd\.errors\.\w+): (.*)", text
    ).groups()
    with pytest.raises(sslcd.BadConfigError) as caught:
        eval(call)
    assert str(caught.value) == message


def test_the_tables_of_the_guide_name_what_there_is():
    text = (SOURCE / "docs/python.md").read_text()
    for name in re.findall(r"sslcd\.(\w+)\(", text):
        assert name in sslcd.__all__
    for name in re.findall(r"^\| `(\w+Error)` \| `(\w+)`", text, re.M):
        assert issubclass(getattr(sslcd, name[0]), eval(name[1]))
