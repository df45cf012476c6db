#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mutation test: do the unit tests notice a small wrong edit of the code that decides?

  scripts/mutate.py                     all mutants of all subjects below (an hour or two)
  scripts/mutate.py --sample 6 drift    six of each file of the subject `drift`
  scripts/mutate.py --list motion       the edits; nothing is built
  scripts/mutate.py --source src/a.cc --target sslcd_a_tests --filter 'A.*'

A mutant is one edit of one source file: a comparison, an arithmetic or logical operator, a
constant, a sign, a dropped `!`, min for max, true for false. It is written to a temporary folder,
compiled there with the build folder's flags but not optimised, and linked before the library into a
copy of the test binary: sources and build folder stay as they are. The headers are compiled once. If
the build folder compiles several sources at a time, those beside the mutant are compiled one by one.
Killed: a test fails, crashes or takes ten times as long. The same seed picks the same sample. Exit
status 1 if fewer than --min-killed percent of the mutants that compile are killed.
"""
import argparse
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# The code that decides: subject -> source, target and gtest filter of the tests that should notice.
SUBJECTS = {
    "decision": [("src/loop/decision.cc", "sslcd_loop_tests", "Decide*:EvidenceOnTrack*:ApplyGraphVerdict*:IsWithdrawn*"),
                 ("src/loop/layout_match.cc", "sslcd_loop_tests", "MatchLayouts*")],
    "likelihood": [("src/loop/layout_likelihood.cc", "sslcd_loop_tests", "LayoutLikelihood*:AlignPoints*"),
                   ("src/loop/heading_density.cc", "sslcd_loop_tests", "*Heading*:LayoutLikelihood*"),
                   ("src/loop/semantic_evidence.cc", "sslcd_loop_tests", "SemanticEvidence*:LayoutLikelihood*"),
                   ("src/loop/view_hull.cc", "sslcd_loop_tests", "ViewHull*:LayoutLikelihood*")],
    "tracks": [("src/loop/pose_tracks.cc", "sslcd_loop_tests", "PoseTracks*")],
    "drift": [("src/loop/drift.cc", "sslcd_loop_tests", "Drift.*:FindStart.*"),
              ("src/loop/drift_problem.cc", "sslcd_loop_tests", "Drift*:FindStart.*")],
    "robust": [("src/pose_graph/robust.cc", "sslcd_pose_graph_tests", "Robust*:Warm*:Chi2*"),
               ("src/pose_graph/gnc.cc", "sslcd_pose_graph_tests", "Gnc*:Robust*")],
    "odometry": [("src/pose_graph/relative_covariance.cc", "sslcd_pose_graph_tests", "RelativeCovariances*"),
                 ("src/odometry/resighting.cc", "sslcd_odometry_tests", "FactorsFromResightings*"),
                 ("src/odometry/odometry_by_loops.cc", "sslcd_odometry_tests", "*Factors*:*ByLoops*"),
                 ("src/pipeline/corrected_odometry.cc", "sslcd_pipeline_tests", "CorrectedOdometry*"),
                 ("src/odometry/odometry_noise.cc", "sslcd_odometry_tests", "Odometry*:SigmasOf*")],
    "search": [("src/loop/pose_search.cc", "sslcd_loop_tests", "SearchPoses*")],
    "assignment": [("src/association/assignment.cc", "sslcd_association_tests", "*Assign*")],
    "motion": [("src/map/motion_test.cc", "sslcd_map_tests", "MotionTest*")],
    "map": [("src/map/object_map.cc", "sslcd_map_tests", "*"),
            ("src/map/map_landmark.cc", "sslcd_map_tests", "*"),
            ("src/map/noise_learning.cc", "sslcd_map_tests", "LearnNoise*"),
            ("src/association/associate.cc", "sslcd_association_tests", "Associat*"),
            ("src/perception/filter.cc", "sslcd_perception_tests", "Filter*")],
    "change": [("src/change/persistence.cc", "sslcd_change_tests", "Persistence*"),
               ("src/change/evidence.cc", "sslcd_change_tests", "Evidence*:Explain*"),
               ("src/change/looks.cc", "sslcd_change_tests", "Looks*:Explain*"),
               ("src/change/places.cc", "sslcd_change_tests", "Places*:Explain*"),
               ("src/change/detection_rate.cc", "sslcd_change_tests", "DetectionRate*"),
               ("src/change/views.cc", "sslcd_change_tests", "Views*:Explain*"),
               ("src/change/learning.cc", "sslcd_change_tests", "LearnChanges*")],
    "retrieval": [("src/retrieval/site_fit.cc", "sslcd_retrieval_tests", "SiteFit*"),
                  ("src/retrieval/pose_votes.cc", "sslcd_retrieval_tests", "PoseVotes*"),
                  ("src/retrieval/constellation_key.cc", "sslcd_retrieval_tests", "Constellation*"),
                  ("src/retrieval/find_site.cc", "sslcd_retrieval_tests", "*Site*:HighestScores*")],
    "closing": [("src/closing/loop_ledger.cc", "sslcd_closing_tests", "LoopLedger*"),
                ("src/closing/loop_corrector.cc", "sslcd_closing_tests", "*Loop*:CorrectTrajectory*:FuseMatched*:LayoutChange*"),
                ("src/closing/loop_meter.cc", "sslcd_closing_tests", "*LoopMeter*:Viewpoint*"),
                ("src/closing/track_finder.cc", "sslcd_closing_tests", "TrackFinder*"),
                ("src/closing/loop_prior.cc", "sslcd_closing_tests", "OdometryPrior*"),
                ("src/closing/trajectory_uncertainty.cc", "sslcd_closing_tests", "TrajectoryUncertainty*"),
                ("src/closing/resightings.cc", "sslcd_closing_tests",
                 "ResightingsOf*:LargestTiltFactor*:LearnOdometryInSight*"),
                ("src/closing/loop_graph.cc", "sslcd_closing_tests", "BuildLoopGraph*:WithRefinedSteps*"),
                ("src/closing/mean_place.cc", "sslcd_closing_tests", "Drive*"),
                ("src/closing/loop_closer.cc", "sslcd_closing_tests", "LoopCloser*:SecondSearch*:Review*:Adjustment*"),
                ("src/closing/global_layout.cc", "sslcd_closing_tests", "GlobalLayout*"),
                ("src/closing/loop_changes.cc", "sslcd_closing_tests", "LoopChanges*:LoopLedger*"),
                ("src/closing/parts.cc", "sslcd_closing_tests", "JoinParts*:Place*"),
                ("src/closing/path_graph.cc", "sslcd_closing_tests", "PathGraph*"),
                ("src/closing/split_fused.cc", "sslcd_closing_tests", "SplitFused*"),
                ("src/closing/loop_heights.cc", "sslcd_closing_tests", "HeightsByLoops*"),
                ("src/closing/view_ties.cc", "sslcd_closing_tests", "TieViews*:ViewAligner*"),
                ("src/closing/pass_map.cc", "sslcd_closing_tests", "PassMap*"),
                ("src/closing/remeasure.cc", "sslcd_closing_tests", "ReviewLoops*:ByViews*:LearnOdometry*")],
    "fusion": [("src/refine/fuse.cc", "sslcd_refine_tests", "Fuse*:SeenTogether*:PathSegments*")],
    "refinement": [("src/refine/refine_map.cc", "sslcd_refine_tests", "RefineMap*"),
                   ("src/refine/improvement.cc", "sslcd_refine_tests", "*Odometry*:Probability*"),
                   ("src/refine/trajectory_correction.cc", "sslcd_refine_tests", "Move*:SelectKeyframes*"),
                   ("src/bundle/path_variance.cc", "sslcd_bundle_tests", "PathVariances*"),
                   ("src/pipeline/final_trajectory.cc", "sslcd_pipeline_tests", "FinalTrajectory*"),
                   ("src/pipeline/gravity_aligner.cc", "sslcd_pipeline_tests", "GravityAligner*")],
}

SWAPS = {  # binary operators; the house format puts a blank on both sides of them and of no others
    "<": [("boundary", "<="), ("comparison", ">=")], "<=": [("boundary", "<"), ("comparison", ">")],
    ">": [("boundary", ">="), ("comparison", "<=")], ">=": [("boundary", ">"), ("comparison", "<")],
    "==": [("comparison", "!=")], "!=": [("comparison", "==")],
    "&&": [("logic", "||")], "||": [("logic", "&&")],
    "+": [("arithmetic", "-")], "-": [("arithmetic", "+")],
    "*": [("arithmetic", "/")], "/": [("arithmetic", "*")],
    "+=": [("arithmetic", "-=")], "-=": [("arithmetic", "+=")], "*=": [("arithmetic", "/=")],
}
WORDS = {"std::min": "std::max", "std::max": "std::min", "minCoeff": "maxCoeff",
         "maxCoeff": "minCoeff", "true": "false", "false": "true", "any_of": "all_of",
         "all_of": "any_of"}
# Where the boundary counts: between whole numbers. No two real results are equal but by design.
COUNTS = re.compile(r"size\(\)|static_cast|count|agree|sightings|[<>]=? \d+\b(?!\.)")
# Unit tests need no data; no mutant is compiled twice.
ENVIRONMENT = {**os.environ, "SSLCD_DATA_DIR": "/nonexistent", "CCACHE_DISABLE": "1"}
GUARD = 1e-6  # constants this small guard against rounding: no edit of them can be noticed


def blank(text, spans):
    """The text with the spans blanked; lines and columns stay where they are."""
    chars = list(text)
    for begin, end in spans:
        for i in range(begin, end):
            if chars[i] != "\n":
                chars[i] = " "
    return "".join(chars)


def deciding_code(text):
    """Without comments, includes, strings and the messages they are part of, option tables,
    headers of counting loops, template arguments and indices."""
    tokens = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|'
                        r'^[ \t]*#(?:[^\n\\]|\\.)*', re.S | re.M)
    found = [m.span() for m in tokens.finditer(text)]
    strings = [(b, e) for b, e in found if text[b] == '"' and not text.startswith("#", b)]
    code = blank(text, found)
    messages = []
    for begin, end in strings:
        left = max(code.rfind(c, 0, begin) for c in ";{}") + 1
        for m in re.finditer(r"(?<![=!<>])=(?!=)|\breturn\b|[?:]", code[:begin]):
            left = max(left, m.end())
        right = code.find(";", end)
        messages.append((left, right if right >= 0 else end))
    code = blank(code, messages)
    for pattern in (r"^void DescribeFields\(.*?^}",
                    r"\bfor \([^;()]*= \d+; \w+ <=? [^;]*;",  # a read past the end is undefined
                    r"\[[\w.]*\]", *3 * [r"(?<=\w)<[^<>;(){}]*>"]):  # template arguments: nested
        code = blank(code, [m.span() for m in re.finditer(pattern, code, re.S | re.M)])
    return code


def constants(number):
    if re.fullmatch(r"\d+", number):
        return [str(int(number) + 1)]
    value = float(number.rstrip("fF"))
    if value == 0:
        return ["1."]
    return [] if abs(value) <= GUARD or abs(value) >= 1 / GUARD else [repr(2 * value)]


def mutants(text):
    """All (offset, length, replacement, kind) of a source text, in order."""
    code = deciding_code(text)
    found = []
    for m in re.finditer(r"(?<=\s)([<>=!]=|[-+*/]=|&&|\|\||[-<>+*/])(?=\s)", code):
        if m.group(1)[0] in "*/" and re.match(r" -?1\b(?!\.\d)", code[m.end():]):
            continue  # the same times one as by one
        line = code[code.rfind("\n", 0, m.start()) + 1:code.find("\n", m.start())]
        for kind, swapped in SWAPS.get(m.group(1), []):
            if kind != "boundary" or COUNTS.search(line):
                found.append((m.start(), len(m.group(1)), swapped, kind))
    for m in re.finditer(r"(?:(?<=[(\[{!])|(?<=[=,?:*/+<>&|-] )|(?<=return ))-(?=[\w(])", code):
        found.append((m.start(), 1, "", "sign"))
    for m in re.finditer(r"!(?=[\w(])", code):
        found.append((m.start(), 1, "", "not"))
    for m in re.finditer(r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?[fF]?|\.\d+)(?![\w.])", code):
        for edit in constants(m.group(1)):
            found.append((m.start(), len(m.group(1)), edit, "constant"))
    for m in re.finditer(r"std::(?:min|max)(?=[(<])|\b(?:%s)\b" % "|".join(
            w for w in WORDS if ":" not in w), code):
        found.append((m.start(), len(m.group(0)), WORDS[m.group(0)], "word"))
    return sorted(found)


def sample(found, count, seed):
    """`count` of them, or all if None; the same ones wherever and whenever it runs."""
    def rank(mutant):
        return hashlib.sha256(f"{seed} {mutant}".encode()).hexdigest()
    return found if count is None else sorted(sorted(found, key=rank)[:count])


class Library:
    """How the build folder compiles a source file, and what must be linked in place of the rest."""
    def __init__(self, build, folder):
        self.build, self.folder, self.objects = build, Path(folder), {}
        commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
        self.entries = {}  # source -> flags, sources of the same object
        for entry in commands:
            file = Path(entry["directory"], entry["file"]).resolve()
            flags = shlex.split(entry["command"].split(" -o ")[0])  # -o OBJECT -c SOURCE come last
            sources = [file]
            if file.parent.name == "Unity":
                text = file.read_text(encoding="utf-8")
                sources = [Path(s).resolve() for s in re.findall(r'^#include "(.*)"', text, re.M)]
            self.entries.update({source: (flags, sources) for source in sources})

    def flags(self, source):
        if source not in self.entries:
            sys.exit(f"{self.build} does not compile {source}")
        return list(self.entries[source][0])

    def neighbours(self, source):
        """Objects of the sources that the build folder compiles together with this one."""
        flags, sources = self.entries[source]
        missing = [s for s in sources if s not in self.objects and s != source]
        objects = {s: self.folder / f"{len(self.objects) + i}_{s.name}.o"
                   for i, s in enumerate(missing)}

        def compile_one(other):
            subprocess.run([*flags, "-O1", "-w", "-o", str(objects[other]), "-c", str(other)],
                           cwd=self.build, check=True)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(compile_one, missing))
        self.objects.update(objects)
        return [str(self.objects[s]) for s in sources if s != source]


class Bench:
    """Builds one source file anew, in a folder of its own, and runs the tests on it."""
    def __init__(self, root, library, source, target, gtest_filter, folder):
        build = library.build
        self.build, self.filter, self.folder = build, gtest_filter, Path(folder)
        self.copy = self.folder / Path(source).name
        self.binary, self.limit_s = self.folder / target, None
        source = (root / source).resolve()
        flags = library.flags(source)
        flags += ["-O0", "-w", "-iquote", str(source.parent)]
        headers = self.folder / "headers.h"
        headers.write_text("\n".join(re.findall(r"^#include .*", source.read_text("utf-8"), re.M)))
        subprocess.run([*flags, "-x", "c++-header", str(headers), "-o", f"{headers}.gch"],
                       cwd=build, check=True, env=ENVIRONMENT)
        self.compile = [*flags, "-include", str(headers), "-o", f"{self.copy}.o", "-c",
                        str(self.copy)]
        lines = subprocess.run(["ninja", "-C", str(build), "-t", "commands", target], check=True,
                               capture_output=True, text=True).stdout.splitlines()
        link = re.search(r"(?:^: && |^)(\S*(?:\+\+|cc)\S* .*?)(?: && .*)?$", lines[-1]).group(1)
        self.link = shlex.split(link)
        output = self.link.index("-o") + 1
        self.link[output:output + 1] = [str(self.binary), f"{self.copy}.o",
                                        *library.neighbours(source)]

    def verdict(self, text):
        """(killed, survived or did not compile; what the tests or the compiler said)"""
        self.copy.write_text(text, encoding="utf-8")
        for command in (self.compile, self.link):
            done = subprocess.run(command, cwd=self.build, capture_output=True, text=True,
                                  env=ENVIRONMENT)
            if done.returncode != 0:
                return "did not compile", done.stderr
        command = [str(self.binary), f"--gtest_filter={self.filter}", "--gtest_fail_fast"]
        start = time.monotonic()
        try:
            done = subprocess.run(command, cwd=self.build, capture_output=True, text=True,
                                  errors="replace", timeout=self.limit_s, env=ENVIRONMENT)
        except subprocess.TimeoutExpired:
            return "killed", "too slow"
        if self.limit_s is None:
            self.limit_s = 10 * (time.monotonic() - start) + 5
        return ("survived" if done.returncode == 0 else "killed"), done.stdout


def run_subject(root, library, subject, options, rows):
    """One source file; appends (verdict, place, kind, before, after) to rows."""
    source, target, gtest_filter = subject
    text = (root / source).read_text(encoding="utf-8")
    chosen = sample(mutants(text), options.sample, options.seed)
    with tempfile.TemporaryDirectory(prefix="mutate-") as folder:
        bench = None
        if not options.list:
            bench = Bench(root, library, source, target, gtest_filter, folder)
            verdict, said = bench.verdict(text)
            if verdict != "survived" or "[  PASSED  ] 0 tests" in said:
                sys.exit(f"error: {source} as it is: {verdict}, {target} {gtest_filter}\n{said}")
        for offset, length, edit, kind in chosen:
            begin = text.rfind("\n", 0, offset) + 1
            end = text.find("\n", offset)
            after = text[begin:offset] + edit + text[offset + length:end]
            verdict = "listed"
            if bench is not None:
                verdict = bench.verdict(text[:offset] + edit + text[offset + length:])[0]
            place = f"{source}:{text.count(chr(10), 0, offset) + 1}"
            rows.append((verdict, place, kind, text[begin:end].strip(), after.strip()))
            print("\t".join(rows[-1]), flush=True)


def summary(rows):
    """Lines of text, one per source, kind of edit and for all; and the share killed, in percent."""
    lines = []
    for name in [*sorted({r[1].split(":")[0] for r in rows}), *sorted({r[2] for r in rows}), "all"]:
        some = [r[0] for r in rows if name in ("all", r[1].split(":")[0], r[2])]
        killed, survived = some.count("killed"), some.count("survived")
        percent = 100 * killed / max(1, killed + survived)
        lines.append(f"{name}: {percent:.0f} % killed; {killed} killed, {survived} survived, "
                     f"{len(some) - killed - survived} did not compile")
    return lines, percent


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("subjects", nargs="*", help=f"of {', '.join(SUBJECTS)}; none: all")
    parser.add_argument("--build", type=Path, default=ROOT / "build/release",
                        help="build folder made by Ninja (default: build/release)")
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    parser.add_argument("--sample", type=int, metavar="N", help="N mutants of each file")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: 1)")
    parser.add_argument("--list", action="store_true", help="list the mutants, build nothing")
    parser.add_argument("--out", type=Path, help="write the table there as well")
    parser.add_argument("--min-killed", type=float, default=85, metavar="PERCENT")
    for name in ("source", "target", "filter"):
        parser.add_argument(f"--{name}", help="a subject that is not among those")
    options = parser.parse_args()
    for name in set(options.subjects) - set(SUBJECTS):
        parser.error(f"no subject '{name}': {', '.join(SUBJECTS)}")
    chosen = [s for name in options.subjects or SUBJECTS for s in SUBJECTS[name]]
    if options.source:
        chosen = [(options.source, options.target, options.filter or "*")]
    build, rows, start = options.build.resolve(), [], time.monotonic()
    if not options.list:
        subprocess.run(["ninja", "-C", build, *{s[1] for s in chosen}], check=True,
                       stdout=subprocess.DEVNULL)
    with tempfile.TemporaryDirectory(prefix="mutate-") as folder:
        library = None if options.list else Library(build, folder)
        try:
            for subject in chosen:
                run_subject(options.root, library, subject, options, rows)
        except KeyboardInterrupt:
            print("interrupted")
    if options.list:
        return 0
    lines, percent = summary(rows)
    lines.append(f"{(time.monotonic() - start) / max(1, len(rows)):.1f} s for each")
    print("\n".join(lines))
    if options.out:
        table = ["\t".join(row) for row in rows]
        options.out.write_text("\n".join([*table, "", *lines, ""]), encoding="utf-8")
    return 0 if percent >= options.min_killed else 1


if __name__ == "__main__":
    sys.exit(main())
