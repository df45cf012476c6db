#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sslcd_run detect, and run from images, where images, calibration or boxes are not what they should be. usage: see cli_case.main"""
import os
import shutil

from cli_case import call, main, read, write
from detect_case import FRAMES, SEQUENCE, DetectCase
from stereo_world import CALIB, HEIGHT, STEP, WIDTH, look, write_png


class DetectInputTest(DetectCase):
    def test_a_file_of_classes(self):
        classes = self.data + '/classes.yaml'
        write(classes, 'Van: {length_m: 5, width_m: 2, height_m: 2, length_sigma_m: 1, width_sigma_m: 0.2,\n'
                       '      height_sigma_m: 0.2, overhang: 0.2, roof: 0.8}\n')
        result = self.detected('--boxes', self.boxes, '--set', f'vision.lift.classes={classes}')
        self.assertEqual(self.count(result, 'boxes unknown label'), FRAMES, 'they are cars')
        self.assertIn(': Car', result.stderr)
        self.assertIn(f"classes: '{classes}'", read(self.out + '/config.yaml'))
        write(classes, 'Car: {length_m: 4}\n')
        result = self.detect('--boxes', self.boxes, '--force', '--set', f'vision.lift.classes={classes}')
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn("classes.yaml:1:1: class 'Car' lacks width_m", result.stderr)
        missing = self.detect('--boxes', self.boxes, '--force', '--set', 'vision.lift.classes=none.yaml')
        self.assertEqual(missing.returncode, 3, missing.stderr)
        self.assertIn('none.yaml: no such file', missing.stderr)

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

    def test_neither_other_formats_nor_what_claims_to_be_huge_is_decoded(self):
        with open(f'{self.data}/image_2/000005.png', 'rb') as file:
            png = file.read()
        huge = png[:16] + (30000).to_bytes(4, 'big') * 2 + png[24:]
        for content in (b'P6 2 1 255\n' + 6 * b'x', huge):
            with open(f'{self.data}/image_2/000005.png', 'wb') as file:
                file.write(content)
            result = self.detect('--boxes', self.boxes, '--force')
            self.assertIn('image_2/000005.png: no image that can be read', result.stderr)

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
            result = call('run', self.data, '--out', self.out, '--force', '--set', 'vision.odometry.window=4', *near, *options)
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

    def test_unknown_labels_are_named(self):
        write(self.boxes, '1 Teapot 0.9 100 80 200 120\n')
        self.assertIn('not lifted: Teapot', self.detected('--boxes', self.boxes).stderr)

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


if __name__ == '__main__':
    main()
