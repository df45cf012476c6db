# SPDX-License-Identifier: BSD-3-Clause
"""scripts/draw_run.py: seen from above, whatever the world's up axis is."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../scripts'))
import draw_run  # noqa: E402

# Viewing directions are the camera's z axis: ahead is +z of a KITTI world, and +y of a world with z
# up if the camera is turned by -90 degrees about x.
Y_DOWN, Z_UP = [0, -1, 0], [0, 0, 1]
LEVEL = [0, 0, 0, 1]
UPRIGHT = [-math.sqrt(.5), 0, 0, math.sqrt(.5)]


def object_at(right, ahead, up_axis, name=1):
    """A car along the right axis of the page."""
    turned = LEVEL if up_axis == Z_UP else [math.sqrt(.5), 0, 0, math.sqrt(.5)]
    position = [right, ahead, 0] if up_axis == Z_UP else [right, 0, ahead]
    return {'id': name, 'state': 'confirmed', 'pose_world_object': turned + position,
            'dimensions_lwh': [4, 2, 1.5]}


class Drawing(unittest.TestCase):
    def test_the_page_does_not_depend_on_the_up_axis(self):
        self.assertEqual(draw_run.Plane(Y_DOWN).of([1, 2, 3]), (1, 3))
        self.assertEqual(draw_run.Plane(Z_UP).of([1, 2, 3]), (1, 2))
        self.assertEqual(draw_run.Plane([0, 0, -1]).of([1, 2, 3]), (2, 1))  # not mirrored

    def test_footprints_have_length_and_width(self):
        for up in (Y_DOWN, Z_UP):
            corners = draw_run.footprint(object_at(10, 20, up), draw_run.Plane(up))
            self.assertAlmostEqual(max(c[0] for c in corners), 12)
            self.assertAlmostEqual(max(c[1] for c in corners), 21)

    def test_viewing_direction_is_the_cameras_z_axis(self):
        self.assertAlmostEqual(draw_run.column(LEVEL, 2)[2], 1)
        self.assertAlmostEqual(draw_run.Plane(Z_UP).of(draw_run.column(UPRIGHT, 2))[1], 1)

    def test_truth_is_aligned_rigidly(self):
        truth = [(0, 0), (10, 0), (10, 5)]
        moved = [(3 - y, 7 + x) for x, y in truth]  # by 90 degrees and a shift
        for p, q in zip(draw_run.aligned(truth, moved), moved):
            self.assertAlmostEqual(math.dist(p, q), 0)

    def test_a_run_becomes_a_picture(self):
        with tempfile.TemporaryDirectory() as run:
            objects = [object_at(0, 10, Z_UP, 1), object_at(5, 10, Z_UP, 2)]
            world = {'up_axis': Z_UP, 'objects': objects}
            rows = [' '.join(map(str, [i, 0, i, 0] + UPRIGHT)) for i in range(3)]
            files = {'map.json': json.dumps(world), 'trajectory_tum.txt': '\n'.join(rows),
                     'odometry_tum.txt': '\n'.join(rows),
                     'loops.csv': 'query_frame,match_frame,decision,matches,'
                                  'viewpoint_change_deg,pairs\n'
                                  '2,0,accepted,1,170.2,7:2\n1,0,none,1,179,7:1\n'}
            for name, text in files.items():
                with open(os.path.join(run, name), 'w', encoding='utf-8') as file:
                    file.write(text + '\n')
            sys.argv = ['draw_run.py', run, os.path.join(run, 'out.svg')]
            draw_run.main()
            with open(os.path.join(run, 'out.svg'), encoding='utf-8') as file:
                svg = file.read()
        self.assertEqual(svg.count(f'fill="{draw_run.MATCHED}"'), 1)
        self.assertIn('170 degrees apart', svg)
        self.assertIn('2 objects, 1 loops', svg)


if __name__ == '__main__':
    unittest.main()
