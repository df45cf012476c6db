#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run export: each format read back on its own, and what goes wrong. usage: see cli_case.main"""
import hashlib
import json
import os
import re
import struct
import xml.etree.ElementTree as ElementTree

from cli_case import CliCase, call, read, write, main


class ExportCase(CliCase):
    """The run of a street, with a loop that is added: the street is too short for one."""

    def setUp(self):
        super().setUp()
        self.assertEqual(self.run_data().returncode, 0)
        self.file = self.data + '/exported'
        self.replace('loops.csv', read(self.out + '/loops.csv') + '39,0,accepted,,9,0.99,0,0,180,0,0,5,0,1,0,0,\n')

    def replace(self, name, text):
        """Replaces a file of the run, which run.json knows."""
        write(f'{self.out}/{name}', text)
        record = json.loads(read(self.out + '/run.json'))
        for file in record['files']:
            if file['name'] == name:
                file.update(bytes=len(text.encode()), sha256=hashlib.sha256(text.encode()).hexdigest())
        write(self.out + '/run.json', json.dumps(record))

    def export(self, ending, *args):
        """The path of the file written."""
        result = call('export', self.out, '--out', self.file + ending, *args)
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, f'wrote {self.file + ending}\n', ''))
        return self.file + ending

    def objects(self):
        return [each for each in json.loads(read(self.out + '/map.json'))['objects'] if each['state'] == 'confirmed']


def read_ply(path):
    """{element: rows of fields as text}, and the header's lines."""
    header, body = read(path).split('end_header\n')
    rows, elements = body.splitlines(), {}
    for name, count in re.findall(r'element (\w+) (\d+)', header):
        elements[name], rows = [row.split() for row in rows[:int(count)]], rows[int(count):]
    assert not rows, 'more rows than the header says'
    return elements, header.splitlines()


def read_glb(path):
    """The JSON of a .glb file, and its accessors as lists of tuples."""
    with open(path, 'rb') as file:
        data = file.read()
    magic, version, length, size, kind = struct.unpack('<4sII I4s', data[:20])
    assert (magic, version, length, size % 4, kind) == (b'glTF', 2, len(data), 0, b'JSON')
    gltf, binary = json.loads(data[20:20 + size]), data[28 + size:]
    assert struct.unpack('<I4s', data[20 + size:28 + size]) == (len(binary), b'BIN\0')
    assert gltf['buffers'] == [{'byteLength': len(binary)}]
    values = []
    for accessor in gltf['accessors']:
        view = gltf['bufferViews'][accessor['bufferView']]
        row = struct.Struct({'VEC3': '<3f', 'SCALAR': '<I'}[accessor['type']])
        assert view['byteOffset'] % 4 == 0 and view['byteLength'] == row.size * accessor['count']
        values.append(list(row.iter_unpack(binary[view['byteOffset']:view['byteOffset'] + view['byteLength']])))
    return gltf, values


def turned(q, v):
    """v turned by the quaternion x y z w."""
    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    t = [2 * c for c in cross(q[:3], v)]
    return [a + q[3] * b + c for a, b, c in zip(v, t, cross(q[:3], t))]


class FormatsTest(ExportCase):
    def test_ply(self):
        elements, header = read_ply(self.export('.ply'))
        self.assertEqual(header[:2], ['ply', 'format ascii 1.0'])
        vertices = elements['vertex']
        self.assertEqual({len(row) for row in vertices}, {6})
        for face in elements['face']:
            self.assertEqual(len(face), 1 + int(face[0]))
            self.assertLess(max(map(int, face[1:])), len(vertices))
        for edge in elements['edge']:
            self.assertEqual(vertices[int(edge[0])][3:], edge[2:], 'edges have the colour of their ends')
        self.assertGreaterEqual(len(elements['face']), 6 * len(self.objects()))
        self.assertEqual(len(elements['edge']), 3 * 39 + 1, 'odometry, corrected trajectory, truth, and a loop')
        self.assertEqual(elements['edge'][-1][2:], ['254', '232', '56'], 'of the opposite direction')

    def test_glb(self):
        gltf, values = read_glb(self.export('.glb'))
        for mesh in gltf['meshes']:
            for primitive in mesh['primitives']:
                position = primitive['attributes']['POSITION']
                columns = list(zip(*values[position]))
                self.assertEqual(gltf['accessors'][position]['min'], [min(c) for c in columns])
                self.assertEqual(gltf['accessors'][position]['max'], [max(c) for c in columns])
                self.assertEqual({len(values[a]) for a in primitive['attributes'].values()}, {len(values[position])})
                if 'indices' in primitive:
                    self.assertEqual({i for i, in values[primitive['indices']]}, set(range(len(values[position]))))
        nodes = {node['name']: node for node in gltf['nodes']}
        path = values[gltf['meshes'][nodes['corrected trajectory']['mesh']]['primitives'][0]['attributes']['POSITION']]
        self.assertEqual((len(path), path[0]), (40, (0, 0, 0)))
        self.assertEqual(nodes['loops']['extras']['names'], ['loop 39 to 0'])
        back = gltf['nodes'][0]['extras']['T_world_file']
        for each in self.objects():
            node, pose = nodes[f'{each["label"]} {each["id"]}'], each['pose_world_object']
            self.assertEqual(node['scale'], each['dimensions_lwh'])
            for corner in ((.5, .5, .5), (-.5, .5, -.5)):
                size = [c * d for c, d in zip(corner, node['scale'])]
                there = [a + b for a, b in zip(turned(node['rotation'], size), node['translation'])]
                found = [sum(r * c for r, c in zip(row, [*there, 1])) for row in back[:3]]
                for a, b, c in zip(found, turned(pose[:4], size), pose[4:]):
                    self.assertAlmostEqual(a, b + c, 3)

    def test_kml(self):
        text = read(self.out + '/map.json')
        label = self.objects()[0]['label']
        self.replace('map.json', text.replace(f'"{label}"', '"<b>&\\"\\u0001\\uffff \u00fc"'))
        name = '{http://www.opengis.net/kml/2.2}%s'
        root = ElementTree.parse(self.export('.kml', '--origin', '-33.8,151.2', '--heading', '-90')).getroot()
        self.assertEqual(root.tag, name % 'kml')
        folders = {each.find(name % 'name').text: each for each in root[0].iterfind(name % 'Folder')}
        self.assertEqual(list(folders), ['paths', 'objects', 'loops'])
        self.assertEqual([each.text for each in folders['paths'].iterfind('./*/' + name % 'name')],
                         ['odometry', 'corrected trajectory', 'ground truth'])
        self.assertIn('<b>&" \u00fc', [each.text for each in folders['objects'].iterfind('./*/' + name % 'name')])
        self.assertEqual(len(list(folders['objects'].iter(name % 'Polygon'))), len(self.objects()))
        self.assertEqual(folders['loops'].find('.//' + name % 'Placemark')[0].text, 'loop 39 to 0')
        points = [[float(n) for n in point.split(',')] for point in folders['paths'].find('.//' + name % 'coordinates').text.split()]
        self.assertEqual((len(points), points[0]), (40, [151.2, -33.8]))
        self.assertLess(points[-1][0], 151.2, 'the drive goes ahead, to the west')
        self.assertLess(abs(points[-1][1] + 33.8), .3 * (151.2 - points[-1][0]))

    def test_geojson(self):
        features = json.loads(read(self.export('.geojson', '--origin', '49,8.4,115')))['features']
        kinds = [each['geometry']['type'] for each in features]
        self.assertEqual(kinds, ['LineString'] * 3 + ['Polygon'] * len(self.objects()) + ['LineString'])
        self.assertEqual(features[1]['geometry']['coordinates'][0], [8.4, 49, 115])
        self.assertGreater(features[1]['geometry']['coordinates'][-1][1], 49, 'to the north, where no heading is given')
        self.assertEqual({each['properties']['landmark'] for each in features[3:-1]}, {each['id'] for each in self.objects()})

    def test_json(self):
        path = self.file + '.ply'
        shown = json.loads(call('export', self.out, '--out', path, '--json').stdout)
        self.assertEqual(shown, {'run': self.out, 'frames': 40, 'objects': len(self.objects()), 'loops': 1,
                                 'written': [{'path': path, 'bytes': os.path.getsize(path)}]})

    def test_g2o(self):
        graph = self.export('.g2o')
        self.assertEqual(read(graph), read(self.out + '/graph.g2o'))
        solved = json.loads(call('graph', graph, '--out', self.data + '/solved.g2o', '--json').stdout)
        self.assertEqual((solved['vertices'], solved['edges'] >= 39, solved['converged']), (40, True, 1))


class RefusalsTest(ExportCase):
    def not_exported(self, code, *messages, run=None, ending='.ply', args=()):
        result = call('export', run or self.out, '--out', self.file + ending, *args)
        self.assertEqual((result.returncode, result.stdout, os.path.exists(self.file + ending)), (code, '', False), result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)

    def test_what_cannot_be_exported(self):
        self.not_exported(2, 'the ending chooses the format: .ply, .glb, .g2o, .kml, .geojson', ending='.obj')
        self.not_exported(2, 'the ending chooses the format', ending='')
        self.not_exported(3, 'holds no map.json', run=self.data)
        self.not_exported(3, 'holds no map.json', run=self.root + '/none', ending='.g2o')
        self.not_exported(2, 'give --origin LATITUDE,LONGITUDE', ending='.kml')
        self.not_exported(2, "'91,0' is no origin", 'at most 89', ending='.geojson', args=('--origin', '91,0'))
        self.not_exported(2, "'' is no origin", ending='.kml', args=('--origin', ''))
        self.not_exported(2, 'clockwise from north', ending='.kml', args=('--origin', '49,8', '--heading', 'nan'))
        self.not_exported(2, '--heading requires --origin', ending='.kml', args=('--heading', '9'))
        self.not_exported(2, '--origin is for .kml and .geojson', args=('--origin', '49,8'))
        before = read(self.out + '/map.ply')
        result = call('export', self.out, '--out', self.out + '/map.ply')
        self.assertEqual(result.returncode, 2)
        self.assertIn('map.ply: is read, and would be overwritten', result.stderr)
        self.assertEqual(read(self.out + '/map.ply'), before)
        self.assertEqual(call('export', self.out, '--out', self.root + '/none/a.ply').returncode, 1)
        write(self.out + '/graph.g2o', 'VERTEX_SE3:QUAT')
        self.not_exported(3, 'graph.g2o: is not the file', ending='.g2o')


if __name__ == '__main__':
    main()
