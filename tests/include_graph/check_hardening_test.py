# SPDX-License-Identifier: BSD-3-Clause
"""check_hardening_test.py COMPILER: each flag that is missing is a breach."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from check_hardening import breaches

SOURCE = """
#include <cstdio>
#include <cstring>
int main(int count, char** words) {
  char text[64];
  std::strcpy(text, words[count - 1]);
  std::puts(text);
}
"""
GOOD = {
    "fortify": ["-O2", "-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=2"],
    "stack": ["-fstack-protector-strong"],
    "pie": ["-fPIE", "-pie"],
    "relro": ["-Wl,-z,relro"],
    "now": ["-Wl,-z,now"],
    "noexecstack": ["-Wl,-z,noexecstack"],
}
BAD = {
    "fortify": (["-O2", "-U_FORTIFY_SOURCE"], "_FORTIFY_SOURCE"),
    "stack": (["-fno-stack-protector"], "protected stacks"),
    "pie": (["-fno-PIE", "-no-pie"], "not PIE"),
    "relro": (["-Wl,-z,norelro"], "-z relro"),
    "now": (["-Wl,-z,lazy"], "-z now"),
    "noexecstack": (["-Wl,-z,execstack"], "stack that can be executed"),
}
COMPILER = sys.argv.pop()


class Hardening(unittest.TestCase):
    def breaches_with(self, flags):
        with tempfile.TemporaryDirectory() as folder:
            source, program = Path(folder, "a.cc"), Path(folder, "a")
            source.write_text(SOURCE, encoding="utf-8")
            subprocess.run([COMPILER, "-w", *sum(flags.values(), []), source, "-o", program], check=True)
            return breaches(program)

    def test_all_flags(self):
        self.assertEqual(self.breaches_with(GOOD), [])

    def test_each_flag(self):
        for name, (flags, message) in BAD.items():
            found = self.breaches_with({**GOOD, name: flags})
            self.assertEqual(len(found), 1, found)
            self.assertIn(message, found[0])


if __name__ == "__main__":
    if shutil.which("readelf") is None:
        print("skipped: no readelf")
        sys.exit(77)
    unittest.main()
