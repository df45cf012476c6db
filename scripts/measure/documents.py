#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the tables of docs/figures.json into the documents. Called by scripts/figures_to_docs.sh in
the repository's root. --check writes nothing and ends with exit code 1 if a document differs."""
import re
import sys

from store import Store
from tables import TABLES

FIGURES = 'docs/figures.json'
DOCUMENTS = ['README.md', 'docs/results.md', 'docs/hosts.md', 'docs/sessions.md', 'docs/change.md',
             'docs/scale.md', 'docs/properties.md']
MARK = re.compile(r'(<!-- figures (\w+) -->\n)(.*?)(<!-- /figures -->)', re.DOTALL)


def with_tables(text, sets):
    """Replaces the tables between the marks of `text` by those of `sets`. Raises ValueError for a mark
    without a table or without an end."""
    def replaced(found):
        begin, name, _, end = found.groups()
        if name not in TABLES:
            raise ValueError(f"no table '{name}'; there are {', '.join(TABLES)}")
        return begin + TABLES[name](sets) + end

    if len(MARK.findall(text)) != text.count('<!-- figures '):
        raise ValueError("a mark '<!-- figures NAME -->' without '<!-- /figures -->'")
    return MARK.sub(replaced, text)


def main():
    check = sys.argv[1:] == ['--check']
    sets = Store(FIGURES).sets
    stale = 0
    for path in DOCUMENTS:
        with open(path, encoding='utf-8') as file:
            text = file.read()
        try:
            new = with_tables(text, sets)
        except (KeyError, ValueError) as problem:
            raise SystemExit(f'{path}: {problem}') from problem
        if new == text:
            continue
        stale += 1
        if check:
            print(f'{path} is out of date: run scripts/figures_to_docs.sh')
        else:
            with open(path, 'w', encoding='utf-8') as file:
                file.write(new)
            print(f'wrote {path}')
    sys.exit(1 if check and stale else 0)


if __name__ == '__main__':
    main()
