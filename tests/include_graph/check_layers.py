# SPDX-License-Identifier: BSD-3-Clause
"""Checks includes against the link lists of the CMake files.

    check_layers.py SOURCE_DIR

The link list of each sslcd_module() (the library) and sslcd_room() (what stands above it) is the rule:
- modules are listed lowest first, and link only modules listed before them;
- a module includes headers of itself and of the modules it links, and links no module that it does not include;
- libraries from outside are for the modules that link them, in src/ only, and these use them;
- public headers include the standard library, Eigen, lie/ and sslcd/ only, but for the opt-in ones listed below;
- what is above the library is not seen by it;
- tools, benchmarks and tests see private headers of the modules that their CMakeLists.txt names (ROOMS,
  sslcd_use_rooms) and of what these link; a test also those of the module of its name. They use all that they name.
Prints one line a breach; exit code 1 if there is any.
"""
import re
import sys
from collections import namedtuple
from pathlib import Path

OPT_IN = {"include/sslcd/perception/opencv_image.h": {"opencv2"}}
# First part of an include path -> what the module's PRIVATE list has to name (part of it is enough).
OUTSIDE = {"ceres": "ceres", "opencv2": "opencv", "flann": "flann", "yaml-cpp": "yaml_cpp", "nlohmann": "nlohmann",
           "pugixml.hpp": "pugixml", "onnxruntime_c_api.h": "onnx", "embree3": "embree", "embree4": "embree",
           "sqlite3.h": "sqlite"}
UMBRELLA = "include/sslcd/sslcd.h"  # includes all modules of the library
PROGRAMS = ("apps", "bench", "python", "tests")
NOT_OURS = {"benchmark/benchmark.h"}  # named as one of ours
# links: as listed; reachable: these and what they link; outside: first parts of the includes of outside libraries
Module = namedtuple("Module", "file links reachable outside is_library")


def words_after(words, keyword, keywords):
    """The words between `keyword` and the next one of `keywords`."""
    found, inside = [], False
    for word in words:
        if word in keywords:
            inside = word == keyword
        elif inside:
            found.append(word)
    return found


def read_modules(source_dir):
    """{name: Module}, and the breaches of the order."""
    modules, breaches = {}, []
    lists = [source_dir / "CMakeLists.txt"]
    top = lists[0].read_text(encoding="utf-8")
    lists += [source_dir / folder / "CMakeLists.txt" for folder in re.findall(r"add_subdirectory\((src/\w+)\)", top)]
    for path in lists:
        file = path.relative_to(source_dir).as_posix()
        for kind, body in re.findall(r"^ *sslcd_(module|room)\(([^)]*)\)", path.read_text(encoding="utf-8"), re.M):
            name, *words = body.split()
            links = words_after(words, "LINK", ("LINK", "PRIVATE"))
            named = " ".join(words_after(words, "PRIVATE", ("LINK", "PRIVATE"))).lower()
            for link in links:
                if link not in modules:
                    breaches.append(f"{file}: {name} links {link}, which is not listed before it")
            known = [link for link in links if link in modules]
            reachable = {name}.union(*(modules[link].reachable for link in known))
            outside = {prefix for prefix, part in OUTSIDE.items() if part in named or kind == "room"}
            modules[name] = Module(file, known, reachable, outside, kind == "module")
    return modules, breaches


def includes_of(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if match:
            yield number, match.group(1)


def sources_of(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cc"))


def module_of(include, modules, source_dir):
    """(the module whose header this is, is it private); (None, False) for all other includes."""
    parts = include.split("/")
    if len(parts) > 2 and parts[0] == "sslcd":
        return parts[1], False
    if len(parts) > 1 and parts[0] in modules and (source_dir / "src" / include).exists():  # not <map>
        return parts[0], True
    return None, False


def check_include(include, name, relative, modules, source_dir):
    """None, or what is wrong with this include of a module's source."""
    public, module = relative.startswith("include/"), modules[name]
    first = include.split("/")[0]
    target, private = module_of(include, modules, source_dir)
    if target and not private and not (source_dir / "include" / include).exists():
        return f"there is no include/{include}"
    if target and public and private:
        return f"a public header includes the private {include}"
    if target:
        return None if target == name or target in module.links else f"{name} does not link {target}"
    if first in OUTSIDE:
        if public:
            return None if first in OPT_IN.get(relative, ()) else f"a public header includes {first}"
        return None if first in module.outside else f"{name} does not link {first}"
    if public and first not in ("Eigen", "lie") and not re.fullmatch(r"[a-z_]+", include):
        return f"a public header includes {include}: only the standard library, Eigen, lie/ and sslcd/"
    return None


def check_modules(modules, source_dir):
    breaches, used, shown = [], {name: set() for name in modules}, {name: set() for name in modules}
    for top in ("include/sslcd", "src"):
        for path in sources_of(source_dir / top):
            relative = path.relative_to(source_dir).as_posix()
            name = path.relative_to(source_dir / top).parts[0]
            if relative == UMBRELLA:  # check_surface.py
                continue
            if name not in modules:
                breaches.append(f"{relative}: no CMakeLists.txt has sslcd_module({name} ...)")
                continue
            for number, include in includes_of(path):
                names = {module_of(include, modules, source_dir)[0], include.split("/")[0]}
                used[name] |= names
                shown[name] |= names if path.suffix == ".h" else set()
                wrong = check_include(include, name, relative, modules, source_dir)
                if wrong:
                    breaches.append(f"{relative}:{number}: {wrong}")
    for name, module in modules.items():
        unused = [link for link in module.links if link not in used[name]]
        if module.is_library:  # one library may be found under several names, or through a header of a module linked
            needed = used[name].union(*(shown[link] for link in module.links))
            unused += sorted({OUTSIDE[prefix] for prefix in module.outside}
                             - {OUTSIDE[prefix] for prefix in needed & set(OUTSIDE)})
        breaches += [f"{module.file}: {name} links {link}, which it does not include" for link in unused]
    return breaches


def check_program(folder, modules, source_dir):
    """The private headers that a folder with a CMakeLists.txt of its own includes."""
    lists = folder / "CMakeLists.txt"
    text = lists.read_text(encoding="utf-8") if lists.exists() else ""
    rooms, own = [], set()
    for call, body in re.findall(r"sslcd_(use_rooms|test_module)\(([^)]*)\)", text):
        name, *words = body.split()
        rooms += words if call == "use_rooms" else words_after(
            words, "ROOMS", ("EACH", "LINK", "ROOMS", "PROPERTY", "REGRESSION", "SLOW"))
        own |= {name} if call == "test_module" else set()
    # tools that a program links hand on what they see themselves
    handed_on = [tool for tool in re.findall(r"sslcd_(\w+)_(?:lib|headers)\b", text) if tool in modules]
    seen = set().union(*(modules[room].reachable for room in {*rooms, *handed_on, *own} if room in modules))
    breaches, used = [], set()
    for path in sources_of(folder):
        relative = path.relative_to(source_dir).as_posix()
        for number, include in includes_of(path):
            target, private = module_of(include, modules, source_dir)
            looked_in = [source_dir / "src", source_dir / "tests", source_dir / "tests/support", path.parent]
            if include.split("/")[0] in modules and "/" in include and include not in NOT_OURS and not any(
                    (place / include).exists() for place in looked_in):
                breaches.append(f"{relative}:{number}: there is no {include}")
            if private:
                used.add(target)
                if target not in seen:
                    breaches.append(f"{relative}:{number}: {include} is private to {target}, which is not named")
    where = lists.relative_to(source_dir).as_posix()
    breaches += [f"{where}: {room} is named, but none of its private headers is included"
                 for room in sorted(set(rooms) - used)]
    return breaches


def check(source_dir):
    modules, breaches = read_modules(source_dir)
    if not modules or not sources_of(source_dir / "src"):
        return [f"{source_dir}: no sslcd_module() or no sources found"]
    breaches += check_modules(modules, source_dir)
    for top in PROGRAMS:
        folder = source_dir / top
        folders = sorted(p for p in folder.iterdir() if p.is_dir()) if top == "tests" and folder.exists() else [folder]
        for one in folders:
            breaches += check_program(one, modules, source_dir)
    return breaches


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = check(Path(sys.argv[1]))
    print("\n".join(found) if found else "include graph: ok")
    sys.exit(1 if found else 0)
