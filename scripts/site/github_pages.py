# SPDX-License-Identifier: BSD-3-Clause
"""Hooks of MkDocs: the documents are written for GitHub's Markdown, and link files beside docs/."""
import os
import re

from mkdocs.structure.files import File

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..'))
ITEM = re.compile(r' *([-*]|\d+\.) ')


def on_files(files, config):
    """Adds the pages and programs that stand beside docs/. The reference is Doxygen's."""
    def add(path):
        files.append(File(path, ROOT, config['site_dir'], config['use_directory_urls']))
    files.remove(files.get_file_from_path('api.md'))  # Doxygen's first page
    add('CONTRIBUTING.md')
    add('third_party/onnxruntime/LICENSE')
    for name in sorted(os.listdir(os.path.join(ROOT, 'examples'))):
        if name.endswith(('.md', '.cc')):
            add('examples/' + name)
    return files


def on_page_markdown(markdown, page, **_):
    source = page.file.src_path
    return python_markdown(here(markdown, source))


def here(markdown, source):
    """Links as seen from the site: docs/ is its root."""
    if source == 'CONTRIBUTING.md':
        return re.sub(r'\]\(docs/', '](', markdown)
    if source.startswith('examples/'):
        return markdown.replace('](../docs/', '](../')
    return re.sub(r'\]\(\.\./(CONTRIBUTING\.md|examples/|third_party/)', r'](\1', markdown)


def python_markdown(markdown):
    """Blank lines that Python-Markdown needs before lists and tables, and around comments."""
    lines, fenced, before = [], False, ''
    for line in markdown.split('\n'):
        if line.lstrip().startswith('```'):
            if not fenced and before.strip():
                lines.append('')
            fenced = not fenced
        elif not fenced and before.strip():
            starts_list = ITEM.match(line) and not ITEM.match(before) and not before.startswith('  ')
            starts_table = line.startswith('|') and not before.startswith('|')
            if starts_list or starts_table or '<!--' in line or before.endswith('-->'):
                lines.append('')
        lines.append(line)
        before = line
    return '\n'.join(lines)
