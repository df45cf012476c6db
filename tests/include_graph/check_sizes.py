# SPDX-License-Identifier: BSD-3-Clause
"""check_sizes.py SOURCE_DIR: source files, functions and lists of parameters are short, and each file starts with its
licence line. Limits: as below. Functions are measured by their layout, which house.format holds: the brace that closes
a block stands under the first character of the line that begins it."""
import re
import statistics
import sys
from pathlib import Path

MAX_LINES = 350
MAX_MEDIAN = 70  # lines, over the product's files
MAX_FUNCTION = 60  # lines, from the line that names it to its closing brace
MAX_PARAMETERS = 6
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause"
PRODUCT = ("include", "src", "apps", "python")
ALSO = ("tests", "bench", "examples", "integrations", "third_party/lie")
NO_FUNCTION = re.compile(r"(namespace|class|struct|union|enum|template <[^>]*> (class|struct))\b")


def code_of(text):
    """The text without comments, directives and what strings hold; lines stay where they are."""
    def blank(match):
        return '""' + "\n" * match[0].count("\n") if match[0][0] in "R\"'" else "\n" * match[0].count("\n")
    # of a string over several lines, the rest of its last line goes, too: it may stand anywhere
    raw = r'R"([^(\n]*)\([^\n]*?\)\1"|R"([^(\n]*)\(.*?\)\2"[^\n]*'
    tokens = raw + r'|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])*\''
    return re.sub(r"^#(?:.*\\\n)*.*$", blank, re.sub(tokens, blank, text, flags=re.S), flags=re.M)


def parameters_of(header):
    """How many parameters the first brackets of a function's header hold."""
    header = re.sub(r"\boperator\W+?(?=\()", "operator", header.replace("operator()", "operator"))
    while re.search(r"<[^<>]*>", header):
        header = re.sub(r"<[^<>]*>", "", header)
    depth, count, held = 0, 0, ""
    for character in header[header.find("("):]:
        depth += (character in "({[") - (character in ")}]")
        if depth == 0:
            break
        count += character == "," and depth == 1
        held += character
    return count + 1 if held[1:].strip() else 0


def blocks(text):
    """(line number, lines, header) of each block but those of namespaces and types, and of initialisers."""
    begins = {}  # indent -> the last line that stands there
    lines = code_of(text).splitlines()
    for i, line in enumerate(lines):
        if not line.strip():
            continue
        indent = len(line) - len(line.lstrip())
        if line.strip()[0] == "}" and indent in begins:
            first = begins[indent]
            header = " ".join(lines[first:i + 1]).replace("{}", "").split("{")[0].strip()
            if "(" in header and not NO_FUNCTION.match(header) and not header.endswith("="):
                yield first + 1, i - first + 1, header
        begins = {at: where for at, where in begins.items() if at < indent}
        begins[indent] = i


def breaches_in(name, text):
    lines = text.splitlines()
    if len(lines) > MAX_LINES:
        yield f"{name}: {len(lines)} lines, more than {MAX_LINES}"
    if lines[:1] != [LICENCE]:
        yield f"{name}:1: is not '{LICENCE}'"
    for number, length, header in blocks(text):
        if length > MAX_FUNCTION:
            yield f"{name}:{number}: a function of {length} lines, more than {MAX_FUNCTION}"
        if parameters_of(header) > MAX_PARAMETERS:
            yield f"{name}:{number}: {parameters_of(header)} parameters, more than {MAX_PARAMETERS}"


def main(root):
    files = {folder: [path for path in sorted((root / folder).rglob("*")) if path.suffix in (".h", ".cc")]
             for folder in PRODUCT + ALSO}
    breaches = [breach for paths in files.values() for path in paths
                for breach in breaches_in(path.relative_to(root), path.read_text(encoding="utf-8"))]
    median = statistics.median(len(path.read_text(encoding="utf-8").splitlines())
                               for folder in PRODUCT for path in files[folder])
    if median > MAX_MEDIAN:
        breaches.append(f"the median file has {median:g} lines, more than {MAX_MEDIAN}")
    print("\n".join(breaches) if breaches else "sizes: ok")
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
