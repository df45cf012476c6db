# SPDX-License-Identifier: BSD-3-Clause
"""The mistakes that people make with their own data, each as a change of a sound sequence folder.

A mistake changes a Sequence: poses, detections, calibration and so on as numbers. MISTAKES holds them by name, with
the id that `sslcd_run check` has to report."""
import math
import random

from sequence_numbers import product, transposed, times, matrix, quaternion


# Poses

def each_pose(change, which='poses'):
    """`change` maps (R, t) to (R, t)."""
    def mistake(s):
        for row in getattr(s, which):
            R, t = change(matrix(row[4:]), row[1:4])
            row[1:4], row[4:] = t, quaternion(R)
    return mistake


def inverse(R, t):
    return transposed(R), [-x for x in times(transposed(R), t)]


ROS = [[0, 0, 1], [-1, 0, 0], [0, -1, 0]]  # of a vector in camera axes
OPENGL = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]


def axes(A):
    """Camera and world in other axes."""
    return each_pose(lambda R, t: (product(product(A, R), transposed(A)), times(A, t)))


def body_axes(A, which='poses'):
    """The camera in other axes, the world as it was."""
    return each_pose(lambda R, t: (product(R, transposed(A)), t), which)


def z_up_world(s):
    each_pose(lambda R, t: (product(ROS, R), times(ROS, t)))(s)


def wxyz(s):
    for row in s.poses:
        row[4:] = [row[7], row[4], row[5], row[6]]


def columns(order, signs=(1, 1, 1)):
    """Columns of positions and quaternions swapped or with another sign."""
    def mistake(s):
        for row in s.poses:
            row[1:4] = [row[1 + i] * sign for i, sign in zip(order, signs)]
            row[4:7] = [row[4 + i] * sign for i, sign in zip(order, signs)]
    return mistake


def mirrored_path(s):
    for row in s.poses:
        row[1] = -row[1]


def left_handed(s):
    M = [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]
    each_pose(lambda R, t: (product(product(M, R), M), times(M, t)))(s)


def transposed_rotations(s):
    each_pose(lambda R, t: (transposed(R), t))(s)


def scaled_poses(factor):
    return each_pose(lambda R, t: (R, [factor * x for x in t]))


def late(n):
    """Row i has the pose of frame i - n."""
    def mistake(s):
        poses = [row[1:] for row in s.poses]
        for i, row in enumerate(s.poses):
            row[1:] = poses[min(max(i - n, 0), len(poses) - 1)]
    return mistake


def other_odometry(s, which='poses'):
    """A drive of its own, with other turns and speeds."""
    rows, rng, heading, x, z, turn, factor = getattr(s, which), random.Random(3), 0., 0., 0., 0., 1.
    steps = sorted(math.dist(a[1:4], b[1:4]) for a, b in zip(rows, rows[1:]))
    step = steps[len(steps) // 2]
    for i, row in enumerate(rows):
        if i % 25 == 0:
            turn, factor = rng.choice([-1, 0, 1]) * math.pi / 50, rng.uniform(0.2, 1.8)
        heading += turn
        x, z = x + factor * step * math.sin(heading), z + factor * step * math.cos(heading)
        row[1:] = [x, 0, z, 0, math.sin(heading / 2), 0, math.cos(heading / 2)]


def stamps(factor, names=('times', 'poses', 'truth')):
    def mistake(s):
        if 'times' in names:
            s.times = [factor * t for t in s.times]
        for name in {'poses', 'truth'} & set(names):
            for row in getattr(s, name):
                row[0] *= factor
    return mistake


# Boxes

FRAME, LABEL, ALPHA, BOX, H, W, L, X, Y, Z, RY, SCORE = 0, 2, 5, slice(6, 10), 10, 11, 12, 13, 14, 15, 16, 17


def each_row(change):
    def mistake(s):
        for row in s.rows:
            change(row)
    return mistake


def degrees(row):
    row[RY] = math.degrees(row[RY])


def turned(angle, sign=1):
    def change(row):
        row[RY] = math.remainder(sign * row[RY] + angle, 2 * math.pi)
    return change


def no_heading(row):
    row[RY] = 0


def alpha_as_ry(row):
    row[RY] = row[ALPHA]


def lwh(row):
    row[H:L + 1] = row[L], row[W], row[H]


def wlh(row):
    row[H:L + 1] = row[W], row[L], row[H]


def centre(row):
    row[Y] -= row[H] / 2


def top(row):
    row[Y] -= row[H]


def velodyne(row):
    row[X:Z + 1] = row[Z], -row[X], -row[Y]
    row[RY] = math.remainder(-row[RY] - math.pi / 2, 2 * math.pi)


def velodyne_place(row):
    row[X:Z + 1] = row[Z], -row[X], -row[Y]


def scaled(factor, sizes=True, places=True):
    def change(row):
        for i in [*([H, W, L] if sizes else []), *([X, Y, Z] if places else [])]:
            row[i] *= factor
    return change


def xywh(row):
    left, top_, right, bottom = row[BOX]
    if right > left:
        row[BOX] = [left, top_, right - left, bottom - top_]


def box_centres(row):
    left, top_, right, bottom = row[BOX]
    if right > left:
        row[BOX] = [(left + right) / 2, (top_ + bottom) / 2, right - left, bottom - top_]


def box_scale(x, y):
    def change(row):
        left, top_, right, bottom = row[BOX]
        if right > left:
            row[BOX] = [left * x, top_ * y, right * x, bottom * y]
    return change


def boxes_yx(row):
    left, top_, right, bottom = row[BOX]
    if right > left:
        row[BOX] = [top_, left, bottom, right]


def frames(factor, add):
    return each_row(lambda row: row.__setitem__(FRAME, row[FRAME] * factor + add))


def relabelled(change):
    return each_row(lambda row: row.__setitem__(LABEL, change(row[LABEL])))


def calibration(change):
    def mistake(s):
        lines = [line.split() for line in s.files['calib.txt'].splitlines()]
        s.files['calib.txt'] = ''.join(' '.join(map(str, [f[0], *(change(f[0], [float(x) for x in f[1:]], lines) if f[0][0] == 'P' else f[1:])])) + '\n' for f in lines)
    return mistake


def focal(factor):
    def change(key, P, lines):
        return [x * factor if i in (0, 3, 5) else x for i, x in enumerate(P)]
    return calibration(change)


def wrong_camera(key, P, lines):
    """P3 in the place of P2."""
    return [float(x) for x in next(f for f in lines if f[0] == 'P3:')[1:]] if key == 'P2:' else P


def half_image(key, P, lines):
    return [x / 2 if i < 8 else x for i, x in enumerate(P)]


def without(name):
    return lambda s: s.files.pop(name)


def scores(change):
    return each_row(lambda row: row.__setitem__(SCORE, change(row[SCORE])))


def shuffled_embeddings(s):
    random.Random(1).shuffle(s.embeddings)


def constant_embeddings(s):
    s.embeddings = [s.embeddings[0]] * len(s.embeddings)


def empty_embeddings(s):
    s.embeddings = [bytes(len(s.embeddings[0]))] * len(s.embeddings)


def inverse_truth(s):
    each_pose(inverse, 'truth')(s)


def other_truth(s):
    other_odometry(s, 'truth')


def scaled_truth(s):
    each_pose(lambda R, t: (R, [1000 * x for x in t]), 'truth')(s)


def edit_labels(change):
    def mistake(s):
        s.files['sequence.yaml'] = change(s.files['sequence.yaml'])
    return mistake


def no_labels(text):
    return text[:text.index('labels:')] if 'labels:' in text else text


# name: (the id that check reports, the change)
MISTAKES = {
    # poses
    'inverse poses': ('inverse_poses', each_pose(inverse)),
    'ROS axes': ('ros_axes', axes(ROS)),
    'ROS body axes': ('ros_axes', body_axes(ROS)),
    'OpenGL axes': ('opengl_axes', axes(OPENGL)),
    'OpenGL camera axes': ('opengl_axes', body_axes(OPENGL)),
    'wxyz': ('quaternion_order', wxyz),
    'y and z swapped': ('swapped_axes', columns((0, 2, 1))),
    'x mirrored': ('mirrored_poses', mirrored_path),
    'left-handed': ('mirrored_poses', left_handed),
    'rotations transposed': ('rotation_inverse', transposed_rotations),
    'z-up world': ('up_axis', z_up_world),
    'poses in mm': ('odometry_units', scaled_poses(1000)),
    'poses in cm': ('odometry_units', scaled_poses(100)),
    'poses 5 frames late': ('shifted_stamps', late(5)),
    'another odometry': ('other_odometry', other_odometry),
    # stamps
    'stamps in ns': ('stamp_units', stamps(1e9)),
    'stamps in ms': ('stamp_units', stamps(1e3)),
    'stamps in us': ('stamp_units', stamps(1e6)),
    # frames
    'frames from 1': ('frame_numbers', frames(1, 1)),
    'frames times 10': ('frame_numbers', frames(10, 0)),
    # cuboids
    'ry in degrees': ('heading_degrees', each_row(degrees)),
    'ry of the other sign': ('heading_sign', each_row(turned(0, -1))),
    'ry a quarter turn off': ('heading_quarter_turn', each_row(turned(math.pi / 2))),
    'ry half a turn off': ('heading_half_turn', each_row(turned(math.pi))),
    'ry all 0': ('no_heading', each_row(no_heading)),
    'alpha as ry': ('heading_is_alpha', each_row(alpha_as_ry)),
    'l w h': ('size_order', each_row(lwh)),
    'w l h': ('size_order', each_row(wlh)),
    'centre': ('box_centre', each_row(centre)),
    'velodyne frame': ('velodyne_frame', each_row(velodyne)),
    'cuboids in mm': ('cuboid_units', each_row(scaled(1000))),
    'sizes in cm': ('cuboid_units', each_row(scaled(100, places=False))),
    # 2D boxes and calibration
    'x y w h': ('box_format', each_row(xywh)),
    'cx cy w h': ('box_format', each_row(box_centres)),
    'y x y x': ('box_format', each_row(boxes_yx)),
    'boxes from 0 to 1': ('box_format', each_row(box_scale(1 / 1280, 1 / 720))),
    'boxes of half an image': ('focal_length', each_row(box_scale(.5, .5))),
    'focal length times 10': ('focal_length', focal(10)),
    'P3 for P2': ('wrong_camera', calibration(wrong_camera)),
    'no calibration': ('no_calibration', without('calib.txt')),
    # scores, labels, appearance
    'scores in per cent': ('score_percent', scores(lambda score: 100 * score)),
    'labels unknown': ('unknown_labels', relabelled(str.lower)),
    'no labels': ('no_symmetry', edit_labels(no_labels)),
    'embeddings shuffled': ('embeddings_shuffled', shuffled_embeddings),
    'embeddings constant': ('embeddings_constant', constant_embeddings),
    'embeddings empty': ('embeddings_empty', empty_embeddings),
    # ground truth
    'inverse ground truth': ('groundtruth_inverse', inverse_truth),
    'ground truth of a ROS body': ('groundtruth_axes', body_axes(ROS, 'truth')),
    'another ground truth': ('groundtruth_other', other_truth),
    'ground truth in mm': ('groundtruth_units', scaled_truth),
}

# those that need no ground truth, embeddings or probabilities
KITTI_MISTAKES = {name: mistake for name, mistake in MISTAKES.items()
                  if not any(word in name for word in ['truth', 'embeddings', 'per cent', 'no labels', 'from 0 to 1'])}

# the cameras of HALV-sim are 0.12 m apart, too near to be told by their boxes
SIMULATED_MISTAKES = {name: mistake for name, mistake in MISTAKES.items() if name != 'P3 for P2'}
