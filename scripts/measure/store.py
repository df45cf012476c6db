# SPDX-License-Identifier: BSD-3-Clause
"""docs/figures.json: the measured figures with their code and inputs."""
import hashlib
import json
import os
import subprocess

# The files that a figure depends on: a commit that changes none of these keeps it valid.
CODE = ['CMakeLists.txt', 'apps', 'cmake', 'config', 'include', 'src', 'third_party']


class Store:
    """The figures of each set, kept in a JSON file that is rewritten whole after each set."""

    def __init__(self, path):
        self.path = path
        self.sets = {}
        if os.path.exists(path):
            with open(path, encoding='utf-8') as file:
                self.sets = json.load(file)['sets']

    def put(self, name, entry):
        self.sets[name] = entry
        document = {'written_by': 'scripts/measure.sh', 'sets': dict(sorted(self.sets.items()))}
        with open(self.path + '.new', 'w', encoding='utf-8') as file:
            json.dump(document, file, indent=1)
            file.write('\n')
        os.replace(self.path + '.new', self.path)


def git(*arguments):
    """The output of git, or None on failure and without git."""
    try:
        done = subprocess.run(['git', *arguments], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None


def last_code_commit(built):
    """The last commit up to `built` that changed the code. `built` is what the program was built
    from, as cmake/WriteCommit.cmake has it. The name ends in -dirty if there are changes of the
    code that are in no commit."""
    commit = built.split('-')[0]
    code = git('log', '-1', '--format=%H', commit, '--', *CODE)
    if not code:
        return 'unknown'
    changed = built != commit and git('diff', '--quiet', commit, '--', *CODE) is None
    return code[:12] + ('-dirty' if changed else '')


def same_code(first, second):
    """Whether two commits have the same code. Unknown for uncommitted changes."""
    if 'dirty' in first + second or 'unknown' in first + second:
        return False
    return first == second or git('diff', '--quiet', first, second, '--', *CODE) is not None


def fingerprint(paths, *words):
    """Hash of the contents of files, of folders with all their files, and of further words."""
    digest = hashlib.sha256()
    for path in sorted(paths):
        files = [path]
        if os.path.isdir(path):
            files = sorted(os.path.join(folder, name)
                           for folder, _, names in os.walk(path) for name in names)
        for name in files:
            digest.update(os.path.basename(name).encode() + b'\0')
            with open(name, 'rb') as file:
                digest.update(file.read())
    for word in words:
        digest.update(str(word).encode() + b'\0')
    return digest.hexdigest()[:16]
