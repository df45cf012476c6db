#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run on people's own folders of images and on models without a description. usage: see cli_case.main"""
import functools
import json
import os
import shutil
import struct

from cli_case import call, main, read
from detect_case import FRAMES, DetectCase
from stereo_world import BASELINE, HEIGHT, STEP, WIDTH, look

MODELS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../data/models')
FIRST, PERIOD = 1403636579763000000, 100000000  # stamps [ns]
QUICK = ('--max-frames', 3, '--no-check', '--set', 'vision.odometry.calibrate=false')


look = functools.lru_cache(maxsize=None)(look)


def bmp(rows):
    """Rows of bytes B G R as a BMP; their length is a multiple of four."""
    info = struct.pack('<IiiHHIIIIII', 40, WIDTH, HEIGHT, 1, 24, 0, 0, 0, 0, 0, 0)
    return b'BM' + struct.pack('<III', 0, 0, 14 + len(info)) + info + b''.join(reversed(rows))


def tiff(rows, compression=1):
    """Rows of bytes B G R as a TIFF of one strip."""
    pixels = bytearray(b''.join(rows))
    pixels[0::3], pixels[2::3] = pixels[2::3], pixels[0::3]
    fields = [(256, 3, 1, WIDTH), (257, 3, 1, HEIGHT), (258, 3, 3, 8), (259, 3, 1, compression), (262, 3, 1, 2),
              (273, 4, 1, 14), (277, 3, 1, 3), (278, 3, 1, HEIGHT)]
    directory = b''.join(struct.pack('<HHII', *field) for field in fields)
    return b'II*\0' + struct.pack('<I', 14 + len(pixels)) + struct.pack('<HHH', 8, 8, 8) + pixels + \
        struct.pack('<H', len(fields)) + directory + bytes(4)


class OwnImagesTest(DetectCase):
    def as_people_store_them(self, write, ending):
        """left/ and right/ with stamps as names instead of image_2/ and image_3/."""
        for index, (old, name) in enumerate((('image_2', 'left'), ('image_3', 'right'))):
            shutil.rmtree(f'{self.data}/{old}')
            os.makedirs(f'{self.data}/{name}')
            for i in range(FRAMES):
                with open(f'{self.data}/{name}/{FIRST + PERIOD * i}.{ending}', 'wb') as file:
                    file.write(write(look(BASELINE * index, STEP * i)))

    def test_bmp_and_tiff_with_stamps_as_names_give_what_png_gives(self):
        self.detected('--boxes', self.boxes, *QUICK)
        expected = read(self.out + '/detections.txt')
        for write, ending in ((bmp, 'bmp'), (tiff, 'TIF')):
            with self.subTest(ending):
                shutil.rmtree(self.data)
                shutil.copytree(self.good, self.data)
                self.as_people_store_them(write, ending)
                self.detected('--boxes', self.boxes, '--force', *QUICK)
                self.assertEqual(read(self.out + '/detections.txt'), expected)
                stamps = [float(row) for row in read(self.out + '/times.txt').split()]
                self.assertAlmostEqual(stamps[0], 1403636579.763, delta=1e-5)
                self.assertAlmostEqual(stamps[-1] - stamps[0], 0.1 * (len(stamps) - 1), delta=1e-5)

    def test_a_tiff_that_is_not_read_says_why(self):
        self.as_people_store_them(lambda rows: tiff(rows, compression=5), 'tif')
        result = self.detect('--boxes', self.boxes, *QUICK)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn(f'left/{FIRST}.tif: is a compressed TIFF; save it as PNG', result.stderr)

    def test_one_camera(self):
        shutil.rmtree(self.data + '/image_3')
        result = call('run', self.data, '--boxes', self.boxes, '--out', self.out)
        self.refused(result, 3, 'one camera shows no distances', 'right', 'odometry in metres and 3D detections')

    # models
    def inspect(self, model, *args):
        result = call('model', 'inspect', model, *args)
        if 'which was not found' in result.stderr:
            self.skipTest('skipped: no ONNX Runtime: ' + result.stderr)
        return result

    def test_a_description_is_written_that_detect_takes(self):
        model, yaml = MODELS + '/yolox.onnx', self.data + '/conf/yolox.yaml'
        os.makedirs(self.data + '/conf')
        result = self.inspect(model, '--out', yaml)
        self.assertEqual(result.returncode, 0, result.stderr)
        for text in ('input images', '1x3x64x64', '1x84x8', 'fits layout yolox', 'class 0 (car) -> Car', '--overlays'):
            self.assertIn(text, result.stdout)
        self.assertIn("labels: {0: 'Car', 2: 'Truck'}", read(yaml))
        self.detected('--detector', yaml, *QUICK)
        again = self.inspect(model, '--out', yaml)
        self.assertEqual(again.returncode, 2)
        self.assertIn('is there already', again.stderr)
        self.assertEqual(self.inspect(model, '--out', yaml, '--force').returncode, 0)

    def test_as_json(self):
        result = self.inspect(MODELS + '/yolox.onnx', '--json')
        found = json.loads(result.stdout)
        self.assertEqual(found['inputs'], [{'name': 'images', 'type': 'float32', 'shape': [1, 3, 64, 64]}])
        self.assertEqual([row['layout'] for row in found['layouts']], ['yolox'])

    def test_a_choice_is_left_to_people(self):
        model, yaml = MODELS + '/yolo_v5.onnx', self.data + '/y.yaml'
        result = self.inspect(model, '--out', yaml)
        self.assertEqual(result.returncode, 2)
        self.assertIn('--layout: yolo_v5, yolo_v8', result.stderr)
        self.assertFalse(os.path.exists(yaml))
        self.assertEqual(self.inspect(model, '--out', yaml, '--layout', 'yolo_v5').returncode, 0)
        self.assertIn('layout: yolo_v5', read(yaml))
        self.assertIn('but yolo_v5, yolo_v8', self.inspect(model, '--out', yaml, '--layout', 'yolox').stderr)
        self.assertEqual(self.inspect(model, '--layout', 'yolo_v').returncode, 2)
        self.assertIn('--layout yolo_v8', self.inspect(model, '--layout', 'yolo_v8').stdout)

    def test_what_cannot_be_described(self):
        self.assertIn('Protobuf', self.inspect(MODELS + '/yolox.yaml').stderr)
        any_size = self.inspect(MODELS + '/any_size.onnx')
        self.assertEqual(any_size.returncode, 3)
        self.assertIn('--width and --height', any_size.stderr)
        no_layout = self.inspect(MODELS + '/any_size.onnx', '--width', '64', '--height', '32')
        self.assertEqual(no_layout.returncode, 3)
        for text in ('fits no layout', '1x3x32x64', 'yolo_v8: 1 x (4 + classes) x rows', 'embedding: batch x length'):
            self.assertIn(text, no_layout.stderr)

    def test_a_model_without_a_description(self):
        result = call('run', self.data, '--detector', MODELS + '/yolox.onnx', '--out', self.out)
        self.refused(result, 4, 'yolox.onnx: is a model', 'sslcd_run model inspect', '--out yolox.yaml')


if __name__ == '__main__':
    main()
