# SPDX-License-Identifier: BSD-3-Clause
"""The package as a whole: version, documentation, stubs, symbols."""

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import sslcd
from conftest import SOURCE
from sslcd import _core

PACKAGE = Path(sslcd.__file__).parent


def test_the_version_is_that_of_cmake():
    text = (SOURCE / "CMakeLists.txt").read_text()
    assert sslcd.__version__ == re.search(r"project\(sslcd VERSION (\S+)", text)[1]


def test_everything_public_is_documented():
    assert sorted(sslcd.__all__) == sslcd.__all__
    for name in sslcd.__all__:
        thing = getattr(sslcd, name)
        assert inspect.getdoc(thing), name
        if not inspect.isclass(thing):
            continue
        for member, value in vars(thing).items():
            if not member.startswith("_") and (
                inspect.isfunction(value) or isinstance(value, property)
            ):
                simple = name in (
                    "Dataset",
                    "AsyncMapper",
                    "LoopClosure",
                    "FilterReport",
                    "MatchResult",
                ) and member in (
                    "name",
                    "closed",
                    "accepted",
                    "dropped",
                )  # their names say it
                assert simple or inspect.getdoc(value), f"{name}.{member}"


def test_what_has_parameters_has_types():
    for name in sslcd.__all__:
        thing = getattr(sslcd, name)
        functions = (
            [thing]
            if inspect.isfunction(thing)
            else [
                value
                for member, value in vars(thing).items()
                if inspect.isfunction(value) and not member.startswith("__")
            ]
        )
        for function in functions:
            signature = inspect.signature(function)
            assert signature.return_annotation is not signature.empty, function
            for parameter in list(signature.parameters.values())[0 if function is thing else 1 :]:
                assert parameter.annotation is not parameter.empty, (function, parameter)


def parameters(function):
    """The names of the parameters in the first line of pybind11's documentation."""
    inside = re.match(r"\w+\((.*)\) -> ", function.__doc__)[1]
    return re.findall(r"(?:^|, )(\w+): ", inside)


def test_the_stubs_agree_with_the_module():
    stubs = ast.parse((PACKAGE / "_core.pyi").read_text())
    named = {
        node.name: node for node in stubs.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))
    }
    assert set(named) == {name for name in dir(_core) if not name.startswith("_")}
    for name, node in named.items():
        if isinstance(node, ast.FunctionDef):
            assert [each.arg for each in node.args.args] == parameters(getattr(_core, name)), name
            continue
        members = vars(getattr(_core, name))
        stubbed = {each.name: each for each in node.body if isinstance(each, ast.FunctionDef)}
        fields = {each.target.id for each in node.body if isinstance(each, ast.AnnAssign)}
        public = {each for each in members if not each.startswith("_") or each in ("__len__",)}
        assert set(stubbed) - {"__init__"} | fields == public, name
        for member, stub in stubbed.items():
            given = parameters(members[member])
            assert len(given) == len(stub.args.args) and all(
                a == b for a, b in zip(given[1:], [each.arg for each in stub.args.args][1:])
            ), f"{name}.{member}"


def test_type_checkers_agree():
    pytest.importorskip("mypy")
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "mypy",
            "--ignore-missing-imports",
            "--cache-dir=/dev/null",
            SOURCE / "python" / "sslcd",
        ],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
    assert (PACKAGE / "py.typed").exists()


def test_the_module_shows_nothing_but_its_entry():
    table = subprocess.run(
        ["nm", "-DC", "--defined-only", _core.__file__], capture_output=True, text=True, check=True
    )
    assert [line.split()[-1] for line in table.stdout.splitlines()] == ["PyInit__core"]


def test_errors_are_typed():
    kinds = {
        sslcd.UsageError,
        sslcd.BadInputError,
        sslcd.BadConfigError,
        sslcd.NoSolutionError,
        sslcd.OutputError,
    }
    assert all(issubclass(kind, sslcd.Error) for kind in kinds)
    text = (SOURCE / "include" / "sslcd" / "core" / "error.h").read_text()
    assert {kind.__name__[: -len("Error")] for kind in kinds} == set(
        re.findall(r"^  k(\w+),", text, re.MULTILINE)
    )
