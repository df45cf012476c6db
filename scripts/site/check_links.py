# SPDX-License-Identifier: BSD-3-Clause
"""Prints the links of a site's pages that lead to no file or to no place in it; exit code 1 if there
are any. usage: check_links.py SITE"""
import os
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], {''}
        with open(path, encoding='utf-8') as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ('href', 'src') and value:
                self.links.append(value)
            elif name in ('id', 'name') and value:
                self.places.add(value)


def pages_of(site):
    for folder, folders, names in os.walk(site):
        folders[:] = [name for name in folders if name != 'api']  # Doxygen checks its own
        for name in names:
            if name.endswith('.html') and name != '404.html':
                path = os.path.join(folder, name)
                yield path, Page(path)


def main():
    pages = dict(pages_of(sys.argv[1]))
    broken = 0
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = path
            if parts.path:
                target = os.path.normpath(os.path.join(os.path.dirname(path), unquote(parts.path)))
            there = os.path.exists(target)
            if there and target in pages:
                there = unquote(parts.fragment) in pages[target].places
            if not there:
                broken += 1
                print(f'{os.path.relpath(path, sys.argv[1])}: {link} leads nowhere', file=sys.stderr)
    print(f'{len(pages)} pages, {broken} links that lead nowhere')
    return 1 if broken or not pages else 0


if __name__ == '__main__':
    sys.exit(main())
