# SPDX-License-Identifier: BSD-3-Clause
"""A map of one session, for the tests of sslcd_run's maps in files."""
import json
import os
import shutil

from cli_case import CliCase, call


class MapCase(CliCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = cls.root + '/made.db'
        done = call('run', cls.good, '--map', cls.made, '--session', 'first')
        assert done.returncode == 0, done.stderr

    def setUp(self):
        super().setUp()
        self.map = os.path.dirname(self.data) + '/site.db'

    def copy(self):
        """A map of one session that has ended."""
        shutil.copy(self.made, self.map)

    def add(self, *args, **kwargs):
        return call('run', self.data, '--map', self.map, *args, **kwargs)

    def info(self):
        told = call('map', 'info', self.map, '--json')
        self.assertEqual(told.returncode, 0, told.stderr)
        return json.loads(told.stdout)

    def sound(self):
        verified = call('map', 'verify', self.map)
        self.assertEqual(verified.returncode, 0, verified.stderr)
