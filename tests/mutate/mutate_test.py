# SPDX-License-Identifier: BSD-3-Clause
"""mutate.py finds the edits of deciding code and no others, and tells a test that notices from one
that does not."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import mutate  # noqa: E402  (path above)

# Accepts from the limit on; Unused is called by no test.
SOURCE = """#include "tiny.h"
bool Accept(double score, double limit) { return score >= limit; }
double Unused(double x) { return x + 2.; }
"""
OTHER = """#include "tiny.h"
bool AcceptOne(double score) { return Accept(score, 1); }
"""
TEST = """#include "tiny.h"
int main() { return AcceptOne(1) && AcceptOne(2) && !AcceptOne(0) ? 0 : 1; }
"""
NINJA = """rule cc
  command = c++ -O2 -I.. -c $in -o $out
rule archive
  command = ar rcs $out $in
rule link
  command = : && c++ $in -o $out $library && :
build test.o: cc ../test.cc
build libtiny.a: archive %s
build tiny_tests: link test.o | libtiny.a
  library = libtiny.a
%s
"""


def edits(text):
    return [text[:offset] + edit + text[offset + length:]
            for offset, length, edit, _ in mutate.mutants(text)]


class Mutants(unittest.TestCase):
    def test_each_kind(self):
        for before, expected in {
            "a < b": ["a >= b"], "a.size() < b": ["a.size() <= b", "a.size() >= b"], "a == b": ["a != b"], "a && b": ["a || b"],
            "a + b": ["a - b"], "a / b": ["a * b"], "a += b": ["a -= b"], "(-a)": ["(a)"],
            "!a": ["a"], "f(3)": ["f(4)"], "f(0.5)": ["f(1.0)"], "f(0.)": ["f(1.)"],
            "std::max(a, b)": ["std::min(a, b)"], "return true;": ["return false;"],
        }.items():
            self.assertEqual(sorted(edits(before)), sorted(expected), before)

    def test_what_decides_nothing_is_left_alone(self):
        for text in ("// a < b\n", "/* a\n < b */", '#include <a-b.h>\n', "std::vector<int> a;",
                     "Eigen::Matrix<double, 6, 6> a;", "a[0]", "a = b;", "const T& a", "T&& a",
                     "f(1e-9)", "reason = \"a < b\" + Text(n + 1);", "i->frame",
                     "for (int i = 0; i < n; ++i) {", "++i",
                     "void DescribeFields(V& v, O& o) {\n  v.Real(o.a, 0, a + 1);\n}\n"):
            self.assertEqual(edits(text), [], text)

    def test_code_beside_a_message_is_kept(self):
        self.assertEqual(len(edits('if (a < b) reason = "a < b";')), 1)

    def test_subjects_are_sources(self):
        for source, *_ in [row for subject in mutate.SUBJECTS.values() for row in subject]:
            self.assertTrue((ROOT / source).is_file(), source)

    def test_the_same_seed_picks_the_same_sample(self):
        found = mutate.mutants(SOURCE)
        self.assertEqual(mutate.sample(found, 2, 1), mutate.sample(found, 2, 1))
        self.assertEqual(mutate.sample(found, None, 1), found)
        samples = {tuple(mutate.sample(found, 2, seed)) for seed in range(20)}
        self.assertGreater(len(samples), 1)


class Run(unittest.TestCase):
    def test_what_no_test_calls_survives(self):
        self.check_run(["../tiny.cc", "../other.cc"])

    def test_sources_that_are_compiled_together(self):
        self.check_run(["Unity/unity_0.cxx"])

    def check_run(self, compiled):
        """`compiled`: what the build folder compiles for the library, of which a file in Unity
        includes both of its sources."""
        with tempfile.TemporaryDirectory() as folder:
            root, build = Path(folder).resolve(), Path(folder).resolve() / "build"
            (build / "Unity").mkdir(parents=True)
            objects = [Path(source).stem + ".o" for source in compiled]
            rules = [f"build {o}: cc {source}" for o, source in zip(objects, compiled)]
            header = "bool Accept(double score, double limit);\nbool AcceptOne(double score);\n"
            for name, text in {
                    "tiny.h": header, "tiny.cc": SOURCE, "other.cc": OTHER, "test.cc": TEST,
                    "build/build.ninja": NINJA % (" ".join(objects), "\n".join(rules)),
                    "build/Unity/unity_0.cxx": f'#include "{root}/tiny.cc"\n\n'
                                               f'#include "{root}/other.cc"\n'}.items():
                (root / name).write_text(text, encoding="utf-8")
            entries = [{"directory": str(build), "file": source,
                        "command": f"c++ -O2 -I.. -o {o} -c {source}"}
                       for o, source in zip(objects, compiled)]
            (build / "compile_commands.json").write_text(json.dumps(entries), encoding="utf-8")
            table = root / "table.txt"
            command = [sys.executable, "-B", str(ROOT / "scripts/mutate.py"), "--root", str(root),
                       "--build", str(build), "--source", "tiny.cc", "--target", "tiny_tests",
                       "--out", str(table)]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)  # below 85 %
            rows = [row.split("\t") for row in table.read_text(encoding="utf-8").splitlines()]
            verdicts = {(row[0], row[1]) for row in rows if len(row) > 1}
            self.assertEqual(verdicts, {("killed", "tiny.cc:2"), ("survived", "tiny.cc:3")})
            self.assertEqual((root / "tiny.cc").read_text(encoding="utf-8"), SOURCE)
            self.assertIn("33 % killed; 1 killed, 2 survived, 0 did not compile", done.stdout)
            done = subprocess.run(command + ["--min-killed", "33"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
