#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Copies snippets of examples/*.cc into the documents, between `<!-- example FILE NAME -->` and
`<!-- /example -->`. A snippet begins after the line `// snippet: NAME` and ends before an empty line,
or a line that is indented less. Documents have no other C++.
    scripts/snippets_to_docs.py [--check]
With --check it writes nothing and ends with exit code 1 if a document is out of date."""
import glob
import os
import re
import sys

PAGES = ['README.md', 'CONTRIBUTING.md', 'docs/*.md', 'examples/*.md']
MARK = re.compile(r'<!-- example (\S+) (\S+) -->\n(.*?)<!-- /example -->', re.DOTALL)


def snippet_of(source, name):
    """The lines of a snippet, without their common indent. Raises ValueError where there is none."""
    lines = source.split('\n')
    begins = [i for i, line in enumerate(lines) if line.strip() == f'// snippet: {name}']
    if len(begins) != 1:
        raise ValueError(f"{len(begins)} lines '// snippet: {name}'")
    indent = len(lines[begins[0]]) - len(lines[begins[0]].lstrip())
    found = []
    for line in lines[begins[0] + 1:]:
        if not line.strip() or len(line) - len(line.lstrip()) < indent:
            break
        found.append(line[indent:] + '\n')
    if not found:
        raise ValueError(f"snippet '{name}' is empty")
    return ''.join(found)


def with_snippets(text, read):
    """The text of a page with the snippets of read(path). Raises ValueError for a mark that is wrong,
    or C++ that is in no mark."""
    def replaced(found):
        path, name, _ = found.groups()
        return (f'<!-- example {path} {name} -->\n```cpp\n// {path}\n'
                f'{snippet_of(read(path), name)}```\n<!-- /example -->')

    if len(MARK.findall(text)) != text.count('<!-- example '):
        raise ValueError("a mark '<!-- example FILE NAME -->' without '<!-- /example -->'")
    if '```cpp' in MARK.sub('', text):
        raise ValueError('C++ that is not from an example')
    return MARK.sub(replaced, text)


def main():
    check = sys.argv[1:] == ['--check']
    os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))

    def read(path):
        with open(path, encoding='utf-8') as file:
            return file.read()

    stale = 0
    for path in sorted(page for pattern in PAGES for page in glob.glob(pattern)):
        try:
            new = with_snippets(read(path), read)
        except (OSError, ValueError) as problem:
            raise SystemExit(f'{path}: {problem}') from problem
        if new == read(path):
            continue
        stale += 1
        if check:
            print(f'{path} is out of date: run scripts/snippets_to_docs.py')
        else:
            with open(path, 'w', encoding='utf-8') as file:
                file.write(new)
            print(f'wrote {path}')
    sys.exit(1 if check and stale else 0)


if __name__ == '__main__':
    main()
