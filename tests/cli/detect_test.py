#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run detect, and run from images. usage: see cli_case.main"""
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from cli_case import CliCase, binaries, call, main, read, write
from stereo_world import BASELINE, CALIB, CAR, HEIGHT, STEP, WIDTH, look, write_drive, write_png

FRAMES = 8
MODELS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'data', 'models')
SEQUENCE = ['calib.txt', 'colours.npy', 'config.yaml', 'detections.txt', 'odometry.txt', 'sequence.yaml', 'times.txt']


def objects(folder):
    return [o for o in json.loads(read(folder + '/map.json'))['objects'] if o['state'] == 'confirmed']


class DetectTest(CliCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix='sslcd_cli_')
        cls.good = cls.root + '/good'
        write_drive(cls.good, FRAMES)

    def setUp(self):
        super().setUp()
        self.boxes = self.data + '/boxes.txt'

    def detect(self, *args, **kwargs):
        return call('detect', self.data, '--out', self.out, *args, **kwargs)

    def detected(self, *args):
        result = self.detect(*args)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def detected_with_models(self, *args, **kwargs):
        """The result, or no test where there is no ONNX Runtime."""
        result = self.detect(*args, **kwargs)
        if 'which was not found' in result.stderr or 'this build cannot' in result.stderr:
            self.skipTest('skipped: no ONNX Runtime: ' + result.stderr)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, result, code, *messages):
        super().refused(result, code, *messages)
        self.assertFalse(os.path.exists(self.out + '/detections.txt'), 'a refused call must leave no detections')

    def count(self, result, what):
        rows = [line.split() for line in result.stdout.splitlines() if line.strip().startswith(what)]
        self.assertEqual(len(rows), 1, result.stdout)
        return int(rows[0][-1])

    def heading_walks(self):
        rows = read(self.out + '/config.yaml').splitlines()
        return [float(row.split()[-1]) for row in rows if row.strip().startswith('rotation_walk:')]

    # what works
    def test_a_sequence_that_runs(self):
        result = self.detected('--boxes', self.boxes, '--overlays')
        self.assertEqual(sorted(os.listdir(self.out)), sorted(SEQUENCE + ['overlays']))
        self.assertEqual(sorted(os.listdir(self.out + '/overlays')), [f'{i:06d}.jpg' for i in range(FRAMES)])
        self.assertEqual(result.stderr, '')
        self.assertEqual(self.count(result, 'boxes lifted'), FRAMES)
        for i, row in enumerate(read(self.out + '/detections.txt').splitlines()):
            row = row.split()
            self.assertEqual((row[0], row[2], row[-1]), (str(i), 'Car', '0.900'))
            x, y, z = map(float, row[13:16])
            self.assertAlmostEqual(x, 0, delta=0.4)
            self.assertAlmostEqual(y, 1.5, delta=0.1)  # it stands on the ground
            self.assertAlmostEqual(z - 0.5 * float(row[12]), CAR - STEP * i, delta=0.4)
        for i, row in enumerate(read(self.out + '/odometry.txt').splitlines()):
            self.assertAlmostEqual(float(row.split()[3]), STEP * i, delta=0.02 + 0.01 * i)
        self.assertIn('Car: {symmetry: pi}', read(self.out + '/sequence.yaml'))
        self.assertIn(f'image_size_px: [{WIDTH}, {HEIGHT}]', read(self.out + '/sequence.yaml'))
        self.assertLess(max(self.heading_walks()), 3e-4)  # rows of such images agree

        run = call('run', self.out, '--config', self.out + '/config.yaml', '--out', self.out + '/run')
        self.assertEqual((run.returncode, run.stderr), (0, ''))
        self.assertEqual([o['label'] for o in objects(self.out + '/run')], ['Car'])

    def test_detect_and_run_are_run_from_images_for_any_thread_count(self):
        self.detected('--boxes', self.boxes)
        call('run', self.out, '--config', self.out + '/config.yaml', '--out', self.out + '/run')
        expected = read(self.out + '/run/odometry_tum.txt')
        for threads in (1, 4):
            out = f'{self.out}{threads}'
            result = call('run', self.data, '--boxes', self.boxes, '--odometry', 'stereo', '--threads', threads, '--out', out)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(self.count(result, 'boxes lifted'), FRAMES)
            self.assertEqual(read(out + '/odometry_tum.txt'), expected)
            calibrated = read(self.out + '/config.yaml').replace('calibrate: false', 'calibrate: true')  # not yet
            self.assertEqual(read(out + '/config.yaml'), calibrated)
            # But for the digits that the file of detections does not have.
            for a, b in zip(objects(out), objects(self.out + '/run')):
                self.assertEqual(a['observations'], b['observations'])
                for i in range(7):
                    self.assertAlmostEqual(a['pose_world_object'][i], b['pose_world_object'][i], delta=1e-3)
            self.assertEqual(len(objects(out)), 1)
        for name in ('map.json', 'trajectory_tum.txt', 'graph.g2o'):
            self.assertEqual(read(f'{self.out}1/{name}'), read(f'{self.out}4/{name}'), name)

    def test_detect_for_any_thread_count(self):
        for threads in (1, 4):
            call('detect', self.data, '--boxes', self.boxes, '--out', f'{self.out}{threads}', '--threads', threads)
        for name in SEQUENCE:
            with open(f'{self.out}1/{name}', 'rb') as one, open(f'{self.out}4/{name}', 'rb') as four:
                self.assertEqual(one.read(), four.read(), name)

    @unittest.skipUnless(os.path.isdir('/proc/self/task'), 'skipped: no /proc')
    def test_one_thread_is_one(self):
        process = subprocess.Popen([binaries['run'], 'detect', self.data, '--boxes', self.boxes, '--out', self.out, '--threads', '1'],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        most = 0
        while process.poll() is None:
            try:
                most = max(most, len(os.listdir(f'/proc/{process.pid}/task')))
            except OSError:  # it has just ended
                pass
            time.sleep(0.002)
        self.assertEqual((process.returncode, most), (0, 1))

    def test_odometry_that_is_there_is_taken(self):
        poses = ''.join(f'{0.1 * i:.1f} 0 0 {i} 0 0 0 1\n' for i in range(FRAMES))
        write(self.data + '/odometry.txt', poses)
        self.detected('--boxes', self.boxes)
        self.assertEqual([float(row.split()[3]) for row in read(self.out + '/odometry.txt').splitlines()], list(range(FRAMES)))
        self.assertEqual(self.heading_walks(), [5e-4, 5e-3])  # as if there were no images
        self.detected('--boxes', self.boxes, '--force', '--odometry', 'stereo', '--max-frames', 3)
        self.assertEqual(len(read(self.out + '/odometry.txt').splitlines()), 3)
        self.assertAlmostEqual(float(read(self.out + '/odometry.txt').split()[-5]), 2 * STEP, delta=0.04)

    def test_ground_truth_goes_along(self):
        write(self.data + '/groundtruth.txt', ''.join(f'1 0 0 0 0 1 0 0 0 0 1 {STEP * i}\n' for i in range(FRAMES)))
        self.detected('--boxes', self.boxes)
        self.assertEqual(len(read(self.out + '/groundtruth.txt').splitlines()), FRAMES)
        run = call('run', self.out, '--json', '--out', self.out + '/run')
        self.assertEqual((run.returncode, run.stderr), (0, ''))
        self.assertLess(json.loads(run.stdout)['ate_se3_rmse_m'], 0.1)
        ev = call('eval', self.out + '/run', '--groundtruth', self.out + '/groundtruth.txt', '--json')
        self.assertAlmostEqual(json.loads(ev.stdout)['ate_se3_rmse_m'], json.loads(run.stdout)['ate_se3_rmse_m'], places=6)
        os.remove(self.data + '/groundtruth.txt')
        before = read(self.out + '/groundtruth.txt')
        result = call('detect', self.data, '--boxes', self.boxes, '--force', '--out', self.out)
        self.assertEqual(result.returncode, 2)
        self.assertIn('groundtruth.txt: would be of other frames', result.stderr)
        self.assertEqual(read(self.out + '/groundtruth.txt'), before, 'it cannot be made again')

    def test_a_camera_at_another_height_than_expected(self):
        for height, poor in ((1.2, False), (0.4, True), (6, True)):
            result = self.detected('--boxes', self.boxes, '--force', '--set', f'vision.lift.ground.height_m={height}')
            self.assertEqual('vision.lift.ground.height_m' in result.stderr, poor, result.stderr)
            if poor:
                self.assertAlmostEqual(float(result.stderr.split()[-2]), 1.5, delta=0.1)

    def test_grey_images_do_for_boxes(self):
        self.make_grey()
        result = self.detected('--boxes', self.boxes)
        self.assertGreaterEqual(self.count(result, 'boxes lifted'), FRAMES - 1, 'one heading is ambiguous')
        self.assertEqual(sorted(os.listdir(self.out)), sorted(set(SEQUENCE) - {'colours.npy'}))
        run = call('run', self.data, '--boxes', self.boxes, '--out', self.out + '/run')
        self.assertEqual((run.returncode, run.stderr), (0, ''))
        self.assertNotIn('colour', read(self.out + '/run/timing.json'), 'what is grey has no colour')

    # models
    def test_odometry_alone(self):
        for left, right in (('image_0', 'image_1'), ('image_l', 'image_r')):
            os.rename(self.data + '/image_2', f'{self.data}/{left}')
            os.rename(self.data + '/image_3', f'{self.data}/{right}')
            if left == 'image_l':  # rows without keys
                write(self.data + '/calib.txt', ''.join(row.split(': ')[1] + '\n' for row in CALIB.splitlines()))
            result = self.detect('--odometry', 'stereo', '--force')
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn('no detections', result.stdout)
            self.assertEqual(read(self.out + '/detections.txt'), '')
            ahead = [float(row.split()[3]) for row in read(self.out + '/odometry.txt').splitlines()]
            self.assertEqual(len(ahead), FRAMES)
            self.assertAlmostEqual(ahead[-1], (FRAMES - 1) * STEP, delta=0.05)
            os.rename(f'{self.data}/{left}', self.data + '/image_2')
            os.rename(f'{self.data}/{right}', self.data + '/image_3')

    def test_models(self):
        self.detected_with_models('--detector', MODELS + '/yolo_v8.yaml', '--embedder', MODELS + '/embedding.yaml')
        self.assertEqual(sorted(os.listdir(self.out)), sorted(SEQUENCE + ['embeddings.npy']))
        rows = len(read(self.out + '/detections.txt').splitlines())
        self.assertGreater(rows, 0)
        with open(self.out + '/embeddings.npy', 'rb') as file:
            self.assertIn(f"'shape': ({rows}, 5)".encode(), file.read(128))
        # What has been detected can be mapped where the models are not.
        write(self.out + '/config.yaml', read(self.out + '/config.yaml').replace(MODELS, '/nowhere'))
        run = call('run', self.out, '--config', self.out + '/config.yaml', '--out', self.out + '/run')
        self.assertEqual((run.returncode, run.stderr), (0, ''))

    def test_a_detector_named_by_the_configuration(self):
        write(self.data + '/c.yaml', f'vision:\n  detector: {MODELS}/yolo_v8.yaml\n')
        self.detected_with_models('--config', self.data + '/c.yaml')
        by_file = read(self.out + '/config.yaml')
        self.detected('--detector', MODELS + '/yolo_v8.yaml', '--force')
        self.assertEqual(by_file, read(self.out + '/config.yaml'))

    def test_paths_of_models(self):
        # In a file: relative to it, or else to the current folder. On the command line: to the current folder.
        models, here = self.data + '/conf/models', self.data + '/here'
        shutil.copytree(MODELS, models)
        os.mkdir(here)
        for path, args, folder in (('models/yolo_v8.yaml', (), here), ('conf/models/yolo_v8.yaml', (), self.data),
                                   ('none.yaml', ('--detector', 'yolo_v8.yaml'), models)):
            write(self.data + '/conf/c.yaml', f'vision: {{detector: {path}}}\n')
            self.detected_with_models('--config', self.data + '/conf/c.yaml', '--force', *args, cwd=folder)
            self.assertIn(f"detector: '{models}/yolo_v8.yaml'", read(self.out + '/config.yaml'), 'to be found from anywhere')
        shutil.rmtree(self.out, ignore_errors=True)
        write(self.data + '/conf/models/no_library.so', '')
        write(self.data + '/conf/c.yaml', 'vision: {detector: models/yolo_v8.yaml, inference: {library: models/no_library.so}}\n')
        result = self.detect('--config', self.data + '/conf/c.yaml', '--force', cwd=here)
        self.refused(result, 3, 'ONNX Runtime')
        if 'this build cannot' not in result.stderr:
            self.assertIn(models + '/no_library.so', result.stderr)
        for key in ('detector', 'embedder'):
            write(self.data + '/conf/c.yaml', f'vision: {{{key}: yolo_v8.yaml}}\n')
            args = () if key == 'detector' else ('--detector', models + '/yolo_v8.yaml')
            self.refused(self.detect('--config', self.data + '/conf/c.yaml', *args, cwd=here), 3, 'yolo_v8.yaml: no such file',
                         'current folder', self.data + '/conf if')
        self.refused(self.detect('--detector', 'models/yolo_v8.yaml', '--config', self.data + '/conf/c.yaml', cwd=here), 3,
                     'models/yolo_v8.yaml: no such file')

    def test_grey_images_and_a_detector_of_colours(self):
        self.detected_with_models('--detector', MODELS + '/yolo_v8.yaml')
        self.make_grey()
        shutil.rmtree(self.out)
        self.refused(self.detect('--detector', MODELS + '/yolo_v8.yaml'), 3, 'image_2/000000.png', 'grey')

    def test_models_that_are_not_there_or_wrong(self):
        self.refused(self.detect('--detector', 'none.yaml'), 3, 'none.yaml')
        write(self.data + '/m.yaml', read(MODELS + '/yolo_v8.yaml').replace('min_score', 'min_skore'))
        self.refused(self.detect('--detector', self.data + '/m.yaml'), 4, "m.yaml:11:3: unknown key 'min_skore'", 'min_score')
        write(self.data + '/m.yaml', read(MODELS + '/yolo_v8.yaml').replace('Truck', 'Large Truck'))
        self.refused(self.detect('--detector', self.data + '/m.yaml'), 4, 'Large Truck', 'one word')
        write(self.data + '/m.yaml', read(MODELS + '/yolo_v8.yaml'))  # without its .onnx file
        result = self.detect('--detector', self.data + '/m.yaml')
        self.refused(result, 3)
        self.assertRegex(result.stderr, 'yolo_v8.onnx|ONNX Runtime')

    def test_no_runtime_says_where_to_get_it(self):
        result = self.detect('--detector', MODELS + '/yolo_v8.yaml', env=dict(os.environ, SSLCD_ORT_LIB='/nowhere/lib.so'))
        self.refused(result, 3, 'ONNX Runtime')
        if 'this build cannot' not in result.stderr:
            self.assertIn('/nowhere/lib.so', result.stderr)
            self.assertIn('SSLCD_ORT_LIB', result.stderr)

    # images that are not there or not what they should be
    def test_images_missing_or_cut_off(self):
        os.remove(self.data + '/image_3/000002.png')
        with open(self.data + '/image_2/000005.png', 'r+b') as file:
            file.truncate(os.path.getsize(file.name) // 2)
        result = self.detected('--boxes', self.boxes)
        self.assertIn('frame 2 has no right image', result.stderr)
        self.assertIn('image_2/000005.png: no image that can be read', result.stderr)
        self.assertEqual(self.count(result, 'without images'), 2)
        self.assertEqual(self.count(result, 'odometry guessed'), 2)
        frames = [row.split()[0] for row in read(self.out + '/detections.txt').splitlines()]
        self.assertEqual(frames, [str(i) for i in range(FRAMES) if i not in (2, 5)])
        self.assertEqual(len(read(self.out + '/odometry.txt').splitlines()), FRAMES)
        self.assertAlmostEqual(float(read(self.out + '/odometry.txt').splitlines()[-1].split()[3]), 1.4, delta=0.1)

    def test_a_frame_without_images_does_not_shift_the_others(self):
        for folder in ('image_2', 'image_3'):
            os.remove(f'{self.data}/{folder}/000002.png')
        self.detected('--boxes', self.boxes)
        self.assertEqual(len(read(self.out + '/times.txt').splitlines()), FRAMES)
        self.assertEqual(read(self.out + '/detections.txt').splitlines()[-1].split()[0], str(FRAMES - 1))

    def test_no_pair(self):
        write_png(self.data + '/image_3/000003.png', look(0, 0)[:HEIGHT // 2])
        for threads in (1, 4):
            out = f'{self.out}{threads}'
            result = call('detect', self.data, '--boxes', self.boxes, '--out', out, '--threads', threads)
            self.refused(result, 3, 'image_2/000003.png', f'{WIDTH}x{HEIGHT}', f'{WIDTH}x{HEIGHT // 2}',
                         f'{out} holds the frames before it (3)')
            self.assertEqual(sorted(os.listdir(out)), SEQUENCE)
            self.assertEqual(len(read(out + '/odometry.txt').splitlines()), 3)
            self.assertEqual([row.split()[0] for row in read(out + '/detections.txt').splitlines()], ['0', '1', '2'])
            os.rename(self.data + '/image_3/000001.png', self.data + '/good.png')
            write_png(self.data + '/image_3/000001.png', look(0, 0)[:HEIGHT // 2])
            result = call('detect', self.data, '--boxes', self.boxes, '--out', out, '--threads', threads, '--force')
            self.refused(result, 3, 'image_2/000001.png', 'holds what it held before')
            self.assertEqual(len(read(out + '/odometry.txt').splitlines()), 3, 'better than what there is now')
            os.rename(self.data + '/good.png', self.data + '/image_3/000001.png')
            result = call('run', self.data, '--boxes', self.boxes, '--out', self.data + '/run', '--threads', threads)
            self.assertEqual(result.returncode, 3)
            self.assertIn('image_2/000003.png', result.stderr)
            self.assertEqual(len(read(self.data + '/run/trajectory_tum.txt').splitlines()), 3, 'the frames before it')

    def test_no_images(self):
        shutil.rmtree(self.data + '/image_3')
        self.refused(self.detect('--boxes', self.boxes), 3, 'odometry', 'image_3')
        write(self.data + '/times.txt', ''.join(f'{i}\n' for i in range(FRAMES)))
        self.refused(self.detect('--boxes', self.boxes, '--odometry', 'stereo'), 3, 'no frame has', 'image_3')
        shutil.rmtree(self.data + '/image_2')
        os.remove(self.data + '/times.txt')
        self.refused(self.detect('--boxes', self.boxes), 3, self.data)

    def test_calibration(self):
        for text, messages in ((CALIB.replace('P3', 'P4'), ('P3',)), ('', ('P2',)),
                               (CALIB.replace('P3: 200', 'P3: 210'), ('no rectified pair', 'calib.txt'))):
            write(self.data + '/calib.txt', text)
            self.refused(self.detect('--boxes', self.boxes), 3, *messages)
        os.remove(self.data + '/calib.txt')
        self.refused(self.detect('--boxes', self.boxes), 3, 'calib.txt', 'P3')

    # what is asked for
    def turn_the_right_camera(self):
        for i in range(FRAMES):  # a pixel further to the right and up than calibration says
            rows = [row[3:] + row[-3:] for row in look(BASELINE, i * STEP)]
            write_png(self.data + f'/image_3/{i:06d}.png', rows[:1] + rows[:-1])

    def test_calibration_that_is_off(self):
        self.turn_the_right_camera()
        few = ('--set', 'vision.odometry.window=4')
        result = self.detected('--boxes', self.boxes, *few)
        self.assertIn('calibration is off', result.stderr)
        self.assertIn('vision.odometry.calibrate', result.stderr, 'a way out')
        principal = [float(row.split()[3]) for row in read(self.out + '/calib.txt').splitlines()]
        self.assertEqual(principal[0], principal[2])
        self.assertAlmostEqual(principal[2] - principal[3], 1, delta=0.2)
        self.assertIn('calibrate: false', read(self.out + '/config.yaml'), 'done: runs of these need not look again')
        result = self.detected('--boxes', self.boxes, *few, '--force', '--set', 'vision.odometry.calibrate=false')
        self.assertNotIn('calibration is off', result.stderr)
        principal = [float(row.split()[3]) for row in read(self.out + '/calib.txt').splitlines()]
        self.assertEqual(principal[2], principal[3])

    def test_calibration_that_is_off_where_nothing_but_passes_needs_images(self):
        self.turn_the_right_camera()
        there_and_back = list(range(FRAMES)) + list(range(FRAMES))[::-1]
        for i, same in enumerate(there_and_back):
            for image in ('image_2', 'image_3'):
                if i >= FRAMES:
                    shutil.copy(f'{self.data}/{image}/{same:06d}.png', f'{self.data}/{image}/{i:06d}.png')
        poses = ''.join(f'{0.1 * i:.1f} 0 0 {STEP * place:.3f} 0 0 0 1\n' for i, place in enumerate(there_and_back))
        write(self.data + '/odometry.txt', poses)
        write(self.data + '/detections.txt', '')
        settings = ('every_m=0.4', 'gap_m=1', 'apart_m=0.5')
        near = [word for setting in settings for word in ('--set', 'loop.views.' + setting)]

        def warnings(*options):
            result = call('run', self.data, '--out', self.out, '--set', 'vision.odometry.window=4', *near, *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stderr.count('calibration is off')

        self.assertEqual(warnings(), 1)
        self.assertEqual(warnings('--set', 'vision.odometry.calibrate=false'), 0)
        self.assertEqual(warnings('--set', 'loop.views.enabled=false'), 0)
        self.assertEqual(warnings('--set', 'loop.views.gap_m=100'), 0, 'nothing to align')

    def test_no_odometry_is_no_success(self):
        os.rename(self.data + '/image_2', self.data + '/image')
        os.rename(self.data + '/image_3', self.data + '/image_2')
        os.rename(self.data + '/image', self.data + '/image_3')
        self.refused(call('run', self.data, '--boxes', self.boxes, '--out', self.out), 5, 'swapped')
        self.refused(self.detect('--boxes', self.boxes), 5, 'swapped')

    def test_aligned_images_say_nothing_of_the_scale_of_odometry_from_them(self):
        write(self.data + '/detections.txt', '')
        run = call('run', self.data, '--odometry', 'stereo', '--out', self.out)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn('scale_prior: 0.05', read(self.out + '/config.yaml'))

    def test_a_second_try_with_overlays(self):
        self.refused(self.detect('--boxes', self.boxes + 'none', '--overlays'), 3, 'none')
        self.detected('--boxes', self.boxes, '--overlays')

    def test_unknown_labels_are_named(self):
        write(self.boxes, '1 Teapot 0.9 100 80 200 120\n')
        self.assertIn('not lifted: Teapot', self.detected('--boxes', self.boxes).stderr)

    def test_input_is_not_overwritten(self):
        self.detected('--boxes', self.boxes)
        for option, name in (('--odometry', 'odometry_tum.txt'), ('--groundtruth', 'trajectory_tum.txt')):
            shutil.copy(self.out + '/odometry.txt', f'{self.out}/{name}')
            poses = read(f'{self.out}/{name}')
            run = call('run', self.out, option, name, '--max-frames', 3, '--out', self.out)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(f'{name}: is read', run.stderr)
            self.assertEqual(read(f'{self.out}/{name}'), poses)
        config = self.out + '/config.yaml'
        self.assertEqual(call('run', self.out, '--config', config, '--out', self.out).returncode, 2)
        self.assertEqual(self.detect('--boxes', self.boxes, '--config', config, '--force').returncode, 2)
        boxes = self.out + '/detections.txt'
        shutil.copy(self.boxes, boxes)
        self.assertEqual(self.detect('--boxes', boxes, '--force').returncode, 2)
        self.assertEqual(read(boxes), read(self.boxes))

    def test_an_image_that_claims_to_be_huge(self):
        self.detected('--boxes', self.boxes)
        os.remove(self.out + '/colours.npy')  # so that images are asked for colours
        shutil.copytree(self.data + '/image_2', self.out + '/image_2')
        with open(self.out + '/image_2/000000.png', 'r+b') as file:
            file.seek(16)
            file.write(b'\x00\x01\x00\x00' * 2)
        run = call('run', self.out, '--out', self.out + '/run')
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn('000000.png: no image that can be read', run.stderr)

    def test_bad_boxes(self):
        rows = read(self.boxes).splitlines()
        for row in ('4 Car 0.9 1 2 3', '4 Car 0.9 1 2 3 x', '-4 Car 0.9 1 2 3 4', '4 Car 1.9 1 2 3 4', '4 Car 0.9 3 2 1 4'):
            write(self.boxes, '\n'.join(rows[:4] + [row] + rows[5:]) + '\n')
            self.refused(self.detect('--boxes', self.boxes), 3, 'boxes.txt:5')
        self.refused(self.detect('--boxes', self.data + '/none.txt'), 3, 'none.txt')

    def test_usage(self):
        detector = ('--detector', MODELS + '/yolo_v8.yaml')
        self.refused(self.detect(), 2, '--detector', '--boxes')
        self.refused(self.detect('--boxes', self.boxes, *detector), 2, '--boxes')
        self.refused(call('detect', self.data, '--boxes', self.boxes), 2, '--out')
        self.refused(self.run_data('--embedder', MODELS + '/embedding.yaml'), 2, '--embedder', '--detector')
        self.refused(self.run_data('--boxes', self.boxes, '--detections', 'd.txt'), 2, '--detections', '--boxes')

    def test_a_folder_that_is_not_empty_is_kept(self):
        write(self.out + '/notes.txt', 'precious')
        self.refused(self.detect('--boxes', self.boxes, '--overlays'), 2, 'not empty', '--force')
        self.assertEqual(os.listdir(self.out), ['notes.txt'])
        self.detected('--boxes', self.boxes, '--force')
        self.assertEqual(read(self.out + '/notes.txt'), 'precious')
        before = read(self.out + '/detections.txt')
        write_png(self.data + '/image_3/000000.png', look(0, 0)[:HEIGHT // 2])
        self.assertEqual(self.detect('--boxes', self.boxes, '--force').returncode, 3)
        self.assertEqual(read(self.out + '/detections.txt'), before, 'a run without any frame must leave what was there')

    def test_overlays_of_an_earlier_run_go(self):
        self.detected('--boxes', self.boxes, '--overlays')
        mine = ['00007.jpg', '000007.png', '000007a.jpg', 'notes.txt']
        for name in mine:
            write(f'{self.out}/overlays/{name}', 'precious')
        self.detected('--boxes', self.boxes, '--overlays', '--force', '--max-frames', 3)
        self.assertEqual(sorted(os.listdir(self.out + '/overlays')), sorted(mine + [f'{i:06d}.jpg' for i in range(3)]))
        self.detected('--boxes', self.boxes, '--force')
        self.assertEqual(sorted(os.listdir(self.out + '/overlays')), sorted(mine), 'they showed other detections')
        for name in mine:
            os.remove(f'{self.out}/overlays/{name}')
        write(self.out + '/overlays/000000.jpg', 'old')
        self.detected('--boxes', self.boxes, '--force')
        self.assertEqual(sorted(os.listdir(self.out)), SEQUENCE)

    def test_interrupt_leaves_nothing_half_done(self):
        for folder in ('image_2', 'image_3'):
            for i in range(FRAMES, 400):
                os.symlink(f'{i % FRAMES:06d}.png', f'{self.data}/{folder}/{i:06d}.png')
        process = subprocess.Popen([binaries['run'], 'detect', self.data, '--boxes', self.boxes, '--out', self.out, '--overlays'],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        until = time.monotonic() + 30
        while not os.path.exists(self.out + '/overlays/000002.jpg') and time.monotonic() < until:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn('interrupted', stderr)
        self.assertEqual(os.listdir(self.out), ['overlays'])

    def make_grey(self):
        for index, folder in enumerate(('image_2', 'image_3')):
            for i in range(FRAMES):
                rows = [row[1::3] for row in look(BASELINE * index, STEP * i)]
                write_png(f'{self.data}/{folder}/{i:06d}.png', rows, channels=1)


if __name__ == '__main__':
    main()
