#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds fleets of simulated drives and measures what they cost. Prints JSON.
    fleet_bench.py sites SSLCD_SIM    60 drives of 6 sites: one worker, two workers, two of which three are killed
    fleet_bench.py many SSLCD_SIM     500 small drives in one go: memory
    fleet_bench.py merge SSLCD_SIM    the cost of a site by the number of its drives
PYTHONPATH names the Python package. Drives are kept in $SSLCD_FLEET_DRIVES, if that is set."""
import contextlib
import hashlib
import io
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time

SITES = {'lot-a': ('4', 'lot', '16'), 'lot-b': ('4', 'lot', '17'), 'lot-c': ('4', 'lot', '18'),
         'street-a': ('2', 'street', '14'), 'street-b': ('4', 'street', '19'), 'street-c': ('2', 'street', '20')}
VISITS = 10
SMALL_SITES, SMALL_VISITS = 125, 4
KILLS = {('map', 15), ('verify', 10), ('solve', 1)}  # after so many tasks of a stage
WORKERS = 2


def make_drives(folder, sim, names):
    """Drives by name: the arguments of `sslcd_sim halv`."""
    for name, arguments in names.items():
        if not os.path.exists(f'{folder}/{name}/sequence.yaml'):
            subprocess.run([sim, 'halv', '--out', f'{folder}/{name}', '--force', *arguments], check=True,
                           stdout=subprocess.DEVNULL)
    return [f'{folder}/{name}' for name in names]


def sixty():
    return {f'{site}-{visit}': ['--size', '0.5', '--case', case, '--layout', layout, '--seed', seed, '--visit', str(visit)]
            for site, (case, layout, seed) in SITES.items() for visit in range(VISITS)}


def five_hundred():
    kinds = (['--case', '4', '--layout', 'lot', '--size', '0.3'], ['--case', '2', '--layout', 'street', '--size', '0.4'])
    return {f'site{site:03}-{visit}': [*kinds[site % 2], '--seed', str(1000 + site), '--visit', str(visit), '--ate-m', '0']
            for site in range(SMALL_SITES) for visit in range(SMALL_VISITS)}


def site_of(drive):
    return drive.rsplit('-', 1)[0]


def judge(report, drives):
    """Sites by their true names: right if a map has all of its drives and no others."""
    true = {}
    for drive in drives:
        true.setdefault(site_of(os.path.basename(drive)), set()).add(os.path.basename(drive))
    found = [set(site['drives']) for site in report.sites]
    mixed = sum(len({site_of(drive) for drive in site}) > 1 for site in found)
    return {'sites': len(true), 'right': sum(one in found for one in true.values()), 'maps': len(found),
            'wrong_merges': mixed, 'left_out': len(report.quarantined)}


def export_hash(report, out):
    """Over the files that the maps of all sites are exported to."""
    import sslcd
    made = hashlib.sha256()
    for site in report.sites:
        with tempfile.TemporaryDirectory() as folder:
            sslcd.Map(f'{out}/{site["map"]}').export(folder + '/map')
            for root, folders, names in os.walk(folder):
                folders.sort()
                for name in sorted(names):
                    with open(f'{root}/{name}', 'rb') as file:
                        made.update(f'{os.path.relpath(root, folder)}/{name}'.encode() + file.read())
    return made.hexdigest()


def makespan(tasks, workers):
    """Time of tasks that are handed to the next free worker, in their order [s]."""
    free = [0.0] * workers
    for seconds in tasks:
        free[free.index(min(free))] += seconds
    return max(free)


class Watch:
    """Keeps the processor times of all tasks, and kills workers on the way."""

    def __init__(self, client, kills):
        self.client, self.kills, self.killed = client, set(kills), 0
        self.times = {}
        self.random = random.Random(1)

    def __call__(self, stage, record):
        times = self.times.setdefault(stage, [])
        times.append(record['cpu_s'])
        if (stage, len(times)) in self.kills:
            pids = sorted(self.client.run(os.getpid).values())
            os.kill(self.random.choice(pids), signal.SIGKILL)
            self.killed += 1


def build(drives, workers, kills=()):
    from sslcd.fleet import build_fleet, find_drives
    from sslcd.fleet.cluster import local_client
    with tempfile.TemporaryDirectory(prefix='sslcd-bench-') as out, local_client(workers) as client:
        watch = Watch(client, kills)
        begin = time.monotonic()
        with contextlib.redirect_stderr(io.StringIO()):
            report = build_fleet(find_drives(drives, {}), out, client, watch=watch)
        wall = time.monotonic() - begin
        figures = {**judge(report, drives), 'wall_s': wall, 'killed': watch.killed, 'export': export_hash(report, out)}
        figures['stages'] = {stage.stage: {'tasks': stage.tasks, 'skipped': stage.skipped, 'cpu_s': stage.cpu_s,
                                           'longest_s': stage.longest_s, 'bytes': stage.bytes}
                             for stage in report.stages}
        cpu = sum(sum(times) for times in watch.times.values())
        figures['cpu_s'] = cpu
        figures['speedup_by_cpu'] = cpu / sum(makespan(times, 2) for times in watch.times.values())
        return figures


def sites(folder, sim):
    drives = make_drives(folder, sim, sixty())
    one = build(drives, 1)
    two = build(drives, WORKERS)
    killed = build(drives, WORKERS, KILLS)
    return {'one': one, 'two': two, 'killed': killed, 'load': os.getloadavg()[0]}


class Memory:
    """The largest sum of the memory of this process and its children [bytes]."""

    def __enter__(self):
        self.most, self._over = 0, threading.Event()
        self._thread = threading.Thread(target=self._look)
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        self._thread.join()

    def _look(self):
        import psutil
        own = psutil.Process()
        while not self._over.wait(0.5):
            total = 0
            for process in [own, *own.children(recursive=True)]:
                with contextlib.suppress(psutil.Error):
                    total += process.memory_info().rss
            self.most = max(self.most, total)


def many(folder, sim):
    drives = make_drives(folder, sim, five_hundred())
    with Memory() as memory:
        figures = build(drives, WORKERS)
    return {**figures, 'memory_bytes': memory.most}


def merge(folder, sim):
    """Processor time of merging n drives of one site, each time into a new map."""
    import sslcd
    names = {name: arguments for name, arguments in sixty().items() if site_of(name) in ('lot-a', 'street-a')}
    rows = []
    with tempfile.TemporaryDirectory() as work:
        maps = {}
        for drive in make_drives(folder, sim, names):
            made = sslcd.Map(f'{work}/{os.path.basename(drive)}.db')
            begin = time.process_time()
            made.add(sslcd.load_dataset(drive))
            maps.setdefault(site_of(os.path.basename(drive)), []).append((made, time.process_time() - begin))
        for site, made in maps.items():
            for count in (1, 2, 4, 6, 8, 10):
                begin = time.process_time()
                out = f'{work}/{site}-of-{count}.db'
                if count > 1:
                    made[0][0].merge([one for one, _ in made[1:count]], out=out, refine_once=True)
                seconds = time.process_time() - begin if count > 1 else made[0][1]
                path = out if count > 1 else made[0][0].path
                frames = sum(session.frames for session in sslcd.Map(path).sessions)
                rows.append({'site': site, 'drives': count, 'frames': frames, 'cpu_s': seconds,
                             'bytes': os.path.getsize(path)})
    return rows


def main():
    os.environ.setdefault('OMP_NUM_THREADS', '1')
    what, sim = sys.argv[1:3]
    kept = os.environ.get('SSLCD_FLEET_DRIVES')
    with tempfile.TemporaryDirectory() as folder:
        print(json.dumps({'sites': sites, 'many': many, 'merge': merge}[what](kept or folder, sim)))


if __name__ == '__main__':
    main()
