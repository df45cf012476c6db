# SPDX-License-Identifier: BSD-3-Clause
"""Options as nested dicts, with the keys of docs/configuration.md."""

import os
import re
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy as np

from . import _core
from .errors import BadConfigError, BadInputError, UsageError

Options = Mapping[str, Any]


def default_options(mode: str = "robust") -> Dict[str, Any]:
    """All options with their defaults, as nested dicts. `mode`: "robust", or "paper": the equations
    as printed."""
    return _core.options([f"mode={mode}"])


def complete_options(options: Optional[Options] = None) -> Dict[str, Any]:
    """All options: those given, and the defaults of the others. Raises BadConfigError with all
    problems at once."""
    return _core.options(settings(options))


def read_options(path: Union[str, "os.PathLike[str]"]) -> Dict[str, Any]:
    """All options of a YAML file, e.g. config.yaml of a run folder. The section `vision` is left
    out: this package takes no images. Raises BadConfigError with line and column of all problems.
    """
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except (OSError, UnicodeDecodeError) as problem:
        raise BadInputError(f"{path}: {problem}") from None
    vision = re.compile(r"^vision:[ \t]*\n(?:[ \t]+.*\n|\n)*", re.MULTILINE)
    lines_kept = vision.sub(
        lambda section: "\n" * section[0].count("\n"), text
    )  # messages have line numbers
    return _core.read_options(lines_kept, os.fspath(path))


def settings(options: Optional[Options]) -> List[str]:
    """`section.key=value` of nested dicts, as `sslcd_run --set` takes them. A key may name its
    sections itself: {"loop.layout.every_m": 3}."""
    if options is None:
        return []
    found: Dict[str, str] = {}
    _flatten(options, "", found)
    return [f"{key}={value}" for key, value in found.items()]


def _flatten(options: Any, section: str, found: Dict[str, str]) -> None:
    if not isinstance(options, Mapping):
        raise UsageError(
            f"options is {options!r}, expected a dict such as {{'loop': {{'enabled': False}}}}"
        )
    for key, value in options.items():
        if not isinstance(key, str) or not key:
            raise UsageError(f"options has the key {key!r}, expected a text")
        path = section + key
        if isinstance(value, Mapping) and (value or _is_section(path)):
            _flatten(value, path + ".", found)
        elif path in found:
            raise BadConfigError(f"{path}: given twice")
        else:
            found[path] = _text(path, value)


def _is_section(path: str) -> bool:
    here: Any = default_options()
    for key in path.split("."):
        here = here.get(key) if isinstance(here, dict) else None
    return isinstance(here, dict)


def _text(path: str, value: Any) -> str:
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return value
    if isinstance(value, Mapping):  # an empty one that is no section
        return ""
    raise BadConfigError(f"{path}: is {value!r}, must be a number, a text, True or False")
