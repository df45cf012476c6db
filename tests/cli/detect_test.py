#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run detect, and run from images. usage: see cli_case.main"""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

from cli_case import binaries, call, main, read, write
from detect_case import FRAMES, SEQUENCE, DetectCase
from stereo_world import CALIB, CAR, HEIGHT, STEP, WIDTH, look, write_png

MODELS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'data', 'models')


def objects(folder):
    return [o for o in json.loads(read(folder + '/map.json'))['objects'] if o['state'] == 'confirmed']


class DetectTest(DetectCase):
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
            self.assertAlmostEqual(y, 1.5, delta=0.1)  # it is on the ground
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

    def test_a_cue_that_only_some_detections_have(self):
        self.make_grey(range(FRAMES // 2))
        result = self.detected('--boxes', self.boxes)
        rows = len(read(self.out + '/detections.txt').splitlines())
        self.assertRegex(result.stderr, rf'\d+ of {rows} detections have no colour .*: no colours.npy')
        self.assertFalse(os.path.exists(self.out + '/colours.npy'))

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
        own = os.path.dirname(self.data) + '/own.yaml'  # a library is not taken from a file of the data set
        at = 'data/conf/models'
        write(own, f'vision: {{detector: {at}/yolo_v8.yaml, inference: {{library: {at}/no_library.so}}}}\n')
        result = self.detect('--config', own, '--force', cwd=here)
        self.refused(result, 3, 'ONNX Runtime')
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
        self.assertIn('/nowhere/lib.so', result.stderr)
        self.assertIn('SSLCD_ORT_LIB', result.stderr)

    # what is asked for
    def test_aligned_images_say_nothing_of_the_scale_of_odometry_from_them(self):
        write(self.data + '/detections.txt', '')
        run = call('run', self.data, '--odometry', 'stereo', '--out', self.out)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn('scale_prior: 0.05', read(self.out + '/config.yaml'))

    def test_a_second_try_with_overlays(self):
        self.refused(self.detect('--boxes', self.boxes + 'none', '--overlays'), 3, 'none')
        self.detected('--boxes', self.boxes, '--overlays')

    def test_input_is_not_overwritten(self):
        self.detected('--boxes', self.boxes)
        other = self.out + '_run'
        os.mkdir(other)
        for option, name in (('--odometry', 'odometry_tum.txt'), ('--groundtruth', 'trajectory_tum.txt')):
            path = f'{other}/{name}'
            shutil.copy(self.out + '/odometry.txt', path)
            poses = read(path)
            run = call('run', self.out, option, path, '--max-frames', 3, '--out', other, '--force')
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(f'{name}: is read, and would be overwritten', run.stderr)
            self.assertEqual(read(path), poses)
        config = self.out + '/config.yaml'
        self.assertEqual(call('run', self.out, '--config', config, '--out', self.out).returncode, 2)
        self.assertEqual(self.detect('--boxes', self.boxes, '--config', config, '--force').returncode, 2)
        boxes = self.out + '/detections.txt'
        shutil.copy(self.boxes, boxes)
        self.assertEqual(self.detect('--boxes', boxes, '--force').returncode, 2)
        self.assertEqual(read(boxes), read(self.boxes))

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

    def test_overlays_follow_no_link(self):
        others = self.out + '_others'
        write(others + '/000000.jpg', 'precious')
        os.makedirs(self.out)
        os.symlink(others, self.out + '/overlays')
        result = self.detect('--boxes', self.boxes, '--overlays', '--force')
        self.assertEqual(result.returncode, 1)
        self.assertIn('overlays: is a link', result.stderr)
        os.remove(self.out + '/overlays')
        os.mkdir(self.out + '/overlays')
        os.symlink(others + '/000000.jpg', self.out + '/overlays/000000.jpg')
        self.detected('--boxes', self.boxes, '--overlays', '--force')
        self.assertEqual(read(others + '/000000.jpg'), 'precious')

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


if __name__ == '__main__':
    main()
