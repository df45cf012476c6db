# SPDX-License-Identifier: BSD-3-Clause
"""Runs sslcd_run and measures its time and memory."""
import os
import re
import subprocess
import tempfile
import time


def rounded(value):
    """Six significant digits: more than any table shows, without the noise of the last bits."""
    return float(f'{value:.6g}') if isinstance(value, float) else value


class Program:
    """sslcd_run of a build folder."""

    def __init__(self, build):
        self.build = build
        self.path = os.path.join(build, 'apps', 'sslcd_run')
        self.built = 'unknown'
        header = os.path.join(build, 'apps', 'generated', 'sslcd_commit.h')
        if os.path.exists(header):
            with open(header, encoding='utf-8') as file:
                found = re.search(r'SSLCD_COMMIT "([^"]*)"', file.read())
            self.built = found.group(1) if found else 'unknown'

    def beside(self, path):
        """Another program of the build folder."""
        full = os.path.join(self.build, path)
        if not os.path.exists(full):
            raise SystemExit(f'no {full}: configure with -DSSLCD_BUILD_BENCH=ON and build it')
        return full

    def run(self, arguments):
        """Standard output, and {wall_s, cpu_s, memory_mib}. Raises if the run fails."""
        with tempfile.TemporaryFile('w+') as out:
            start = time.monotonic()
            child = subprocess.Popen([self.path, *arguments], stdout=out)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            wall = time.monotonic() - start
            if child.returncode != 0:
                raise SystemExit(f'{self.path} {" ".join(arguments)}: exit code {child.returncode}')
            out.seek(0)
            cost = {'wall_s': wall, 'cpu_s': used.ru_utime + used.ru_stime,
                    'memory_mib': used.ru_maxrss / 1024}
            return out.read(), {name: float(f'{value:.3g}') for name, value in cost.items()}


def processor():
    """The name and the number of the CPUs."""
    name = 'unknown'
    if os.path.exists('/proc/cpuinfo'):
        with open('/proc/cpuinfo', encoding='utf-8') as file:
            found = re.search(r'model name\s*: (.*)', file.read())
        name = found.group(1) if found else name
    return f'{os.cpu_count()} x {name}'
