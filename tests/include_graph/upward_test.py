# SPDX-License-Identifier: BSD-3-Clause
"""The compiler finds the headers of what a module links, and no others: an upward include does not compile.

    upward_test.py SOURCE_DIR COMPILER INCLUDE_PATHS

INCLUDE_PATHS: a line `module|folder;folder;...` for each module, as its sources are compiled.
"""
import subprocess
import sys
import unittest
from pathlib import Path

from check_layers import read_modules, sources_of


def headers_of(name):
    """One public and one private header of a module, as they are included; where it has such."""
    public = [f"sslcd/{path.relative_to(ROOT / 'include/sslcd')}" for path in sources_of(ROOT / "include/sslcd" / name)]
    private = [str(path.relative_to(ROOT / "src")) for path in sources_of(ROOT / "src" / name) if path.suffix == ".h"]
    return public[:1] + private[:1]


def preprocess(text, folders):
    command = [COMPILER, "-std=c++17", "-E", "-P", "-x", "c++", "-", *(f"-I{folder}" for folder in folders)]
    return subprocess.run(command, input=text, capture_output=True, text=True, check=False)


class Upward(unittest.TestCase):
    def test_a_module_finds_the_headers_of_what_it_links_alone(self):
        modules, _ = read_modules(ROOT)
        missing = {name for name, module in modules.items() if module.is_library} - set(PATHS)
        self.assertLessEqual(missing, {"store"}, "built where there is SQLite")
        for name, folders in PATHS.items():
            headers = [(other, header) for other in modules for header in headers_of(other)]
            text = "".join(f'#if __has_include("{header}")\nfound {header}\n#endif\n' for _, header in headers)
            found = set(preprocess(text, folders).stdout.replace("found ", "").split())
            self.assertEqual(found, {header for other, header in headers if other in modules[name].reachable}, name)

    def test_an_upward_include_does_not_compile(self):
        self.assertEqual(preprocess('#include "sslcd/core/error.h"\n', PATHS["map"]).returncode, 0)
        upward = preprocess('#include "sslcd/pipeline/mapper.h"\n', PATHS["map"])
        self.assertNotEqual(upward.returncode, 0)
        self.assertIn("sslcd/pipeline/mapper.h", upward.stderr)


if __name__ == "__main__":
    ROOT, COMPILER = Path(sys.argv[1]), sys.argv[2]
    PATHS = dict(line.split("|") for line in Path(sys.argv[3]).read_text(encoding="utf-8").split("\n") if line)
    PATHS = {name: folders.split(";") for name, folders in PATHS.items()}
    unittest.main(argv=sys.argv[:1])
