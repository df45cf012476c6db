# SPDX-License-Identifier: BSD-3-Clause
"""Checks the includes of include/ and src/ against the layers of the top-level CMakeLists.txt.

    check_layers.py SOURCE_DIR

The link list of each sslcd_module() is the rule:
- modules are listed lowest first, and link only modules listed before them;
- a module includes only headers of itself and of the modules it links, directly or through them;
- private headers (src/M) are for M and for sources of modules that link it: nobody else, and no host, can see them;
- libraries from outside are for the modules that link them, in src/ only;
- public headers include the standard library, Eigen, lie/ and sslcd/ only, but for the opt-in ones listed below.
Prints one line a breach; exit code 1 if there is any.
"""
import re
import sys
from pathlib import Path

OPT_IN = {"include/sslcd/perception/opencv_image.h": {"opencv2"}, "include/sslcd/optim/cost_functors.h": {"ceres"}}
# First part of an include path -> what the module's PRIVATE list has to name (part of it is enough).
OUTSIDE = {"ceres": "ceres", "opencv2": "opencv", "flann": "flann", "yaml-cpp": "yaml_cpp", "nlohmann": "nlohmann",
           "pugixml.hpp": "pugixml",
           "onnxruntime_c_api.h": "onnx", "embree3": "embree", "embree4": "embree"}
# Not modules of the library: these stand above it and may use all of it, and of each other what is named here.
ABOVE = {"sim": set(), "render": {"sim"}, "baselines": set(), "benchmark": {"sim", "baselines"}}


def read_modules(cmake_lists):
    """{module: (modules it may include, outside libraries it may include)}, and the breaches of the order."""
    modules, breaches = {}, []
    for body in re.findall(r"^ *sslcd_module\(([^)]*)\)", cmake_lists, re.M):
        name, *words = body.split()
        links, outside, other, into = [], [], [], None
        for word in words:
            if word in ("LINK", "PRIVATE", "WITHOUT"):
                into = {"LINK": links, "PRIVATE": outside, "WITHOUT": other}[word]
            else:
                into.append(word)
        reachable = {name}
        for link in links:
            if link == "sslcd_lie":
                continue
            below = link[len("sslcd_"):]
            if below in modules:
                reachable |= modules[below][0]
            else:
                breaches.append(f"CMakeLists.txt: {name} links {link}, which is not listed before it")
        named = " ".join(outside).lower()
        modules[name] = (reachable, {prefix for prefix, part in OUTSIDE.items() if part in named})
    return modules, breaches


def includes_of(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if match:
            yield number, match.group(1)


def check_include(include, module, relative, modules, source_dir):
    """None, or what is wrong with this include."""
    public = relative.startswith("include/")
    first = include.split("/")[0]
    may_include, may_use = modules[module]
    if first == "sslcd":
        target = include.split("/")[1]
        if not (source_dir / "include" / include).exists():
            return f"there is no include/{include}"
        return None if target in may_include else f"{module} is not above {target}"
    if "/" in include and first in modules:  # not <map>
        if public:
            return f"a public header includes the private {include}"
        return None if first in may_include else f"{include} is private to {first}, which {module} does not link"
    if first in OUTSIDE:
        if public:
            return None if first in OPT_IN.get(relative, ()) else f"a public header includes {first}"
        return None if first in may_use else f"{module} does not link {first}"
    if public and first not in ("Eigen", "lie") and not re.fullmatch(r"[a-z_]+", include):
        return f"a public header includes {include}: only the standard library, Eigen, lie/ and sslcd/"
    return None


def check(source_dir):
    modules, breaches = read_modules((source_dir / "CMakeLists.txt").read_text(encoding="utf-8"))
    folders = [source_dir / "include" / "sslcd", source_dir / "src"]
    files = sorted(path for folder in folders for path in folder.glob("*/**/*") if path.suffix in (".h", ".cc"))
    if not modules or not files:
        return [f"{source_dir}: no sslcd_module() or no sources found"]
    library = set(modules)
    modules.update({name: ({*library, name, *others}, set(OUTSIDE)) for name, others in ABOVE.items()})
    for path in files:
        relative = path.relative_to(source_dir).as_posix()
        module = relative.split("/")[2 if relative.startswith("include/") else 1]
        if module not in modules:
            breaches.append(f"{relative}: CMakeLists.txt has no sslcd_module({module} ...)")
            continue
        for number, include in includes_of(path):
            wrong = check_include(include, module, relative, modules, source_dir)
            if wrong:
                breaches.append(f"{relative}:{number}: {wrong}")
    return breaches


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = check(Path(sys.argv[1]))
    print("\n".join(found) if found else "include graph: ok")
    sys.exit(1 if found else 0)
