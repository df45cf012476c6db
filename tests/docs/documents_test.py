# SPDX-License-Identifier: BSD-3-Clause
"""Links of the documents lead somewhere, the options and the sources that they name exist, and
the pages that are read first stay short."""
import glob
import os
import re
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..')
LINK = re.compile(r'\]\(([^)\s]+)\)')
SOURCE = re.compile(r'(?<![\w./])((?:[a-z_0-9]+/)+[a-z_0-9]+\.(?:cc|h|py|sh))\b')
FILE_ENDINGS = {'cc', 'csv', 'geojson', 'h', 'json', 'md', 'npy', 'ply', 'txt', 'yaml'}


def read(path):
    with open(os.path.join(ROOT, path), encoding='utf-8') as file:
        return file.read()


def anchors(text):
    """The anchors of a page's headings, as GitHub names them."""
    headings = re.findall(r'^#+ (.*)$', text, re.MULTILINE)
    plain = [re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', heading).lower() for heading in headings]
    return {re.sub(r'[^\w\- ]', '', heading).replace(' ', '-') for heading in plain}


def broken_links(page, text):
    broken = []
    for link in LINK.findall(text):
        if re.match(r'https?://', link):
            continue
        path, _, anchor = link.partition('#')
        target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        if path and not os.path.exists(os.path.join(ROOT, target)):
            broken.append(link)
        elif anchor and target.endswith('.md'):
            if anchor not in anchors(text if target == page else read(target)):
                broken.append(link)
    return broken


def option_keys(yaml):
    """All keys of a configuration, as `section.key`."""
    keys, path = set(), []
    for indent, name in re.findall(r'^( *)([a-z_0-9]+):', yaml, re.MULTILINE):
        path = path[:len(indent) // 2] + [name]
        keys.add('.'.join(path))
    return keys


def unknown_options(text, keys):
    """Names in code spans that begin with a section of the configuration but are no key of it."""
    sections = {key for key in keys if '.' not in key}
    named = [name for span in re.findall(r'`([^`\n]+)`', text)
             for name in re.findall(r'(?<![\w./])([a-z_]+(?:\.[a-z_0-9]+)+)', span)]
    return [name for name in named if name.split('.')[0] in sections and name not in keys
            and name.split('.')[-1] not in FILE_ENDINGS]


def missing_sources(text):
    """Sources in code spans that are in none of the folders that the documents leave out."""
    named = [name for span in re.findall(r'`([^`\n]+)`', text)
             for name in SOURCE.findall(span)]
    return [name for name in named
            if not any(os.path.exists(os.path.join(ROOT, folder, name))
                       for folder in ('', 'src', 'tests', 'include', 'include/sslcd', 'apps'))]


class Documents(unittest.TestCase):
    def test_broken_links_are_seen(self):
        text = '# A `b` c\n[1](#a-b-c) [2](#other) [3](none.md) [4](https://x.y/z)\n'
        self.assertEqual(broken_links('docs/made_up.md', text), ['#other', 'none.md'])

    def test_files_of_cues_are_described(self):
        files = re.findall(r'"(\w+\.npy)"', read('include/sslcd/core/cue.h'))
        self.assertIn('colours.npy', files)
        formats = read('docs/formats.md')
        self.assertEqual([name for name in files if f'| `{name}` |' not in formats], [])

    def test_links_lead_somewhere(self):
        pages = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'examples/README.md']
        pages += [os.path.relpath(p, ROOT)
                  for p in glob.glob(os.path.join(ROOT, 'docs/**/*.md'), recursive=True)]
        self.assertGreater(len(pages), 10)
        broken = {page: broken_links(page, read(page)) for page in pages}
        self.assertEqual({page: links for page, links in broken.items() if links}, {})

    def test_unknown_options_are_seen(self):
        keys = option_keys('loop:  # text\n  views:\n    enabled: true\nmap:\n  memory_m: 60\n')
        self.assertEqual(keys, {'loop', 'loop.views', 'loop.views.enabled', 'map', 'map.memory_m'})
        text = '`loop.views.enabled: false` `map.json` `--set map.memory=1` `loop.look` `a.b`'
        self.assertEqual(unknown_options(text, keys), ['map.memory', 'loop.look'])

    def test_options_that_are_named_exist(self):
        keys = option_keys(read('config/default.yaml'))
        self.assertGreater(len(keys), 50)
        pages = ['README.md', 'CONTRIBUTING.md']
        pages += [os.path.relpath(p, ROOT) for p in glob.glob(os.path.join(ROOT, 'docs/*.md'))]
        unknown = {page: unknown_options(read(page), keys) for page in pages}
        self.assertEqual({page: names for page, names in unknown.items() if names}, {})

    def test_there_are_few_keys_and_fewer_of_every_day(self):
        keys = re.findall(r'^ *[a-z_0-9]+: \S', re.sub(r' *#.*', '', read('config/default.yaml')),
                          re.MULTILINE)
        self.assertGreater(len(keys), 100)
        self.assertLessEqual(len(keys), 150)
        everyday = read('docs/configuration.md').split('## Everyday')[1].split('## All keys')[0]
        rows = re.findall(r'^\| `', everyday, re.MULTILINE)
        self.assertGreater(len(rows), 10)
        self.assertLessEqual(len(rows), 30)

    def test_missing_sources_are_seen(self):
        self.assertEqual(missing_sources('`docs/documents_test.py` `loop/none.cc` `x/y.h`'),
                         ['loop/none.cc', 'x/y.h'])

    def test_sources_that_are_named_exist(self):
        pages = ['CONTRIBUTING.md', 'docs/architecture.md', 'docs/conventions.md',
                 'docs/paper_map.md', 'docs/results.md']
        missing = {page: missing_sources(read(page)) for page in pages}
        self.assertEqual({page: names for page, names in missing.items() if names}, {})

    def test_all_files_name_one_version_which_the_changelog_has(self):
        wanted = {'CMakeLists.txt': r'^project\(sslcd VERSION ([\d.]+)',
                  'package.xml': r'<version>([\d.]+)<', 'CITATION.cff': r'^version: ([\d.]+)'}
        found = {page: re.search(pattern, read(page), re.MULTILINE).group(1)
                 for page, pattern in wanted.items()}
        self.assertEqual(len(set(found.values())), 1, found)
        self.assertIn(f'## [{found["CMakeLists.txt"]}]', read('CHANGELOG.md'))

    def test_pages_that_are_read_first_are_short(self):
        lines = read('README.md').split('\n')
        self.assertLessEqual(len(lines), 121)
        self.assertLess(lines.index('## Quick start'), 25)
        self.assertLessEqual(read('docs/results.md').count('\n'), 400)

    def test_the_site_lists_all_pages(self):
        pages = {os.path.basename(page) for page in glob.glob(os.path.join(ROOT, 'docs/*.md'))}
        listed = set(re.findall(r' (\w+\.md)$', read('mkdocs.yml'), re.MULTILINE))
        self.assertEqual(pages - {'api.md'}, listed - {'CONTRIBUTING.md'})

    def test_examples_are_short_and_listed(self):
        programs = sorted(glob.glob(os.path.join(ROOT, 'examples/*.cc')))
        self.assertGreater(len(programs), 5)
        listed = read('examples/README.md')
        for program in programs:
            self.assertLessEqual(read(program).count('\n'), 60, program)
            self.assertIn(f'| `{os.path.basename(program)[:-3]}', listed)


if __name__ == '__main__':
    unittest.main()
