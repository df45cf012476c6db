#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes tests/data/models: a tiny ONNX model per layout of docs/models.md, and its detections in one image.

    pip install numpy onnx;  scripts/make_test_models.py [tests/data/models]

Each model returns fixed numbers + GAIN * (weighted mean of its input's channels), so that its output depends on how the
image is prepared. The detections (NAME.txt) are computed here with NumPy from the layouts' definitions, independently
of the C++ code; the descriptions (NAME.yaml) are written by hand. Rows of 2D detectors: label score, left top right
bottom; of 3D detectors: label score, centre x y z, length width height, KITTI's rotation_y, left top right bottom; of
embeddings: the vector of one box. tests/detectors/golden_test.cc runs the models and compares.
"""
import sys
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

OPSET, IR_VERSION = 17, 8  # what ONNX Runtime 1.17 knows
GAIN = 0.02
CHANNELS = np.array([3.0, -1.5, 0.75])  # weights of the mean
WIDTH, HEIGHT, TOP = 64, 48, 16  # of the image; its first TOP rows have a colour of their own
TOP_BGR, BGR, RIGHT_BGR = (200, 10, 60), (30, 90, 210), (60, 120, 150)
FX, FY, CX, CY, OFFSET = 70.0, 72.0, 31.0, 20.0, np.array([0.06, -0.01, 0.002])  # camera
LABELS = {0: "Car", 2: "Truck"}  # class 1 is not wanted
FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent / "tests/data/models")


def write_model(name, inputs, outputs, size_input=None, metadata=None):
    """inputs: {name: shape}; outputs: {name: (fixed numbers, shape to declare)}. A first dimension "batch" is any."""
    nodes, constants = [], []

    def constant(key, values, dtype=np.float32):
        constants.append(numpy_helper.from_array(np.asarray(values, dtype), key))
        return key

    def node(kind, result, *sources, **attributes):
        nodes.append(helper.make_node(kind, list(sources), [result], **attributes))
        return result

    batched = next(iter(inputs.values()))[0] != 1
    terms = []
    for i, key in enumerate(inputs):
        weighted = node("Mul", f"weighted {i}", key, constant(f"weights {i}", (i + 1) * CHANNELS.reshape(1, 3, 1, 1)))
        terms.append(node("ReduceMean", f"mean {i}", weighted, axes=[1, 2, 3], keepdims=0))
    if size_input:  # int64 width and height count a thousandth
        terms.append(node("Mul", "size term", node("ReduceSum", "size sum", node("Cast", "size", size_input, to=1),
                                                   keepdims=0), constant("thousandth", 0.001)))
    total = terms[0] if len(terms) == 1 else node("Sum", "total", *terms)
    shift = node("Mul", "shift", total, constant("gain", GAIN))
    if batched:
        shift = node("Unsqueeze", "column", shift, constant("last", [1], np.int64))
    declared = []
    for key, (numbers, shape) in outputs.items():
        node("Add", key, shift, constant(f"fixed {key}", numbers))
        declared.append(helper.make_tensor_value_info(key, TensorProto.FLOAT, shape))
    given = [helper.make_tensor_value_info(key, TensorProto.FLOAT, shape) for key, shape in inputs.items()]
    if size_input:
        given.append(helper.make_tensor_value_info(size_input, TensorProto.INT64, [1, 2]))
    result = helper.make_model(helper.make_graph(nodes, name, given, declared, constants), ir_version=IR_VERSION,
                               opset_imports=[helper.make_opsetid("", OPSET)], producer_name="sslcd")
    helper.set_model_props(result, metadata or {})
    onnx.checker.check_model(result)
    onnx.save(result, FOLDER / f"{name}.onnx")


def shift_of(bgr_shares, scale=1 / 255, mean=(0, 0, 0), std=(1, 1, 1), rgb=True):
    """GAIN times the output of the model for an input with these shares of colours: [(share, bgr), ...]."""
    total = 0
    for share, bgr in bgr_shares:
        pixel = np.array(bgr[::-1] if rgb else bgr)
        total += share * np.mean((pixel * scale - np.array(mean)) / np.array(std) * CHANNELS)
    return GAIN * total


def sigmoid(x):
    return 1 / (1 + np.exp(-x))


def iou(a, b):
    width, height = np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2])
    both = max(width, 0) * max(height, 0)
    return both / ((a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - both)


def corners(box):
    return np.array([box[0] - box[2] / 2, box[1] - box[3] / 2, box[0] + box[2] / 2, box[1] + box[3] / 2])


def found(score, number, box, *more):
    return {"score": score, "label": LABELS.get(number), "box": np.asarray(box, float), "more": more}


def best(candidates, minimum, overlap=1.0):
    """Detections with a wanted label and a sufficient score, best first, without duplicates of a label."""
    kept = []
    for c in sorted(candidates, key=lambda c: -c["score"]):
        if c["label"] and c["score"] >= minimum and all(
                k["label"] != c["label"] or iou(k["box"], c["box"]) <= overlap for k in kept):
            kept.append(c)
    assert kept
    return kept


def write_rows(name, rows):
    lines = [" ".join(v if isinstance(v, str) else f"{v:.8g}" for v in row) for row in rows]
    (FOLDER / f"{name}.txt").write_text("\n".join(lines) + "\n")


def write_boxes(name, kept, scale=(1, 1), offset=(0, 0)):
    """scale, offset: from the image to the input."""
    to_image = lambda box: np.clip((box - np.tile(offset, 2)) / np.tile(scale, 2), 0, [WIDTH, HEIGHT, WIDTH, HEIGHT])
    write_rows(name, [[k["label"], k["score"], *k["more"], *to_image(k["box"])] for k in kept])


# Two overlapping boxes, an unwanted one, a weak one, one across the image border: cx cy w h, scores
# of three classes.
CENTRED = np.array([[20, 30, 16, 12], [22, 31, 16, 12], [44, 30, 10, 10], [50, 40, 8, 6], [4, 22, 20, 10.]])
CLASSES = np.array([[.9, .1, .2], [.7, .3, .1], [.2, .8, .3], [.1, .05, .2], [.3, .2, .85]])


def yolo_v5():  # 64 x 48 as it is
    numbers = np.hstack([CENTRED, [[.95], [.9], [.9], [.9], [.8]], CLASSES])[None]
    write_model("yolo_v5", {"images": [1, 3, 48, 64]}, {"output0": (numbers, numbers.shape)})
    v = numbers[0] + shift_of([(TOP / HEIGHT, TOP_BGR), (1 - TOP / HEIGHT, BGR)])
    kept = best([found(r[4] * r[5:].max(), r[5:].argmax(), corners(r[:4])) for r in v], 0.25, 0.45)
    write_boxes("yolo_v5", kept)


def yolo_v8():  # without its top 64 x 32; in a letterbox 32 x 16 in the middle of 32 x 32; B G R
    numbers = np.hstack([CENTRED / [2, 2, 2, 2], CLASSES]).T[None]
    write_model("yolo_v8", {"images": [1, 3, 32, 32]}, {"output0": (numbers, [1, 7, "boxes"])})
    v = numbers[0].T + shift_of([(0.5, (114, 114, 114)), (0.5, BGR)], rgb=False)
    kept = best([found(r[4:].max(), r[4:].argmax(), corners(r[:4])) for r in v], 0.25, 0.45)
    write_boxes("yolo_v8", kept, scale=(0.5, 0.5), offset=(0, 8 - 0.5 * TOP))


def yolox():  # 64 x 48 in the corner of 64 x 64, grey below; B G R; not decoded
    rng = np.random.default_rng(8)
    cells = [(stride, x, y) for stride in (8, 16, 32) for y in range(64 // stride) for x in range(64 // stride)]
    numbers = np.hstack([rng.uniform(-.5, 1, (len(cells), 4)), rng.uniform(0, .1, (len(cells), 4))])
    # A car, the same once more on a coarser grid, a truck, something unwanted, a weak one.
    numbers[[9, 64 + 1, 64 + 16 + 1, 40, 20], 4] = .9, .8, .7, .9, .3
    numbers[[9, 64 + 1, 64 + 16 + 1, 40, 20], [5, 5, 7, 6, 5]] = .9, .9, .8, .9, .9
    numbers[9, :4] = .4, .6, 1.1, .7
    numbers[64 + 1, :4] = -.2, .7, .35, .05
    write_model("yolox", {"images": [1, 3, 64, 64]}, {"output": (numbers[None], (1,) + numbers.shape)},
                metadata={"names": "{0: 'car', 1: 'person', 2: 'truck'}"})
    shift = shift_of([(.75 * TOP / HEIGHT, TOP_BGR), (.75 * (1 - TOP / HEIGHT), BGR), (.25, (114,) * 3)], rgb=False)
    candidates = []
    for (stride, x, y), r in zip(cells, numbers + shift):
        box = corners(np.array([(x + r[0]) * stride, (y + r[1]) * stride, np.exp(r[2]) * stride, np.exp(r[3]) * stride]))
        candidates.append(found(r[4] * r[5:].max(), int(np.argmax(r[5:])), box))
    kept = best(candidates, 0.3, 0.45)
    assert len(kept) == 2
    write_boxes("yolox", kept)


def yolo_v10():  # without its top, stretched to 96 x 64
    numbers = np.hstack([[corners(b) for b in CENTRED], CLASSES.max(1)[:, None], CLASSES.argmax(1)[:, None]])[None]
    write_model("yolo_v10", {"images": [1, 3, 64, 96]}, {"output0": (numbers, numbers.shape)})
    v = numbers[0] + shift_of([(1, BGR)])
    kept = best([found(r[4], round(r[5]), r[:4]) for r in v], 0.25)
    write_boxes("yolo_v10", kept, scale=(1.5, 2), offset=(0, -2 * TOP))


def boxes_scores_labels():  # normalised cx cy w h; asks for the size; outputs in another order, and one too many
    boxes, scores, labels = CENTRED / [64, 48, 64, 48], CLASSES.max(1), CLASSES.argmax(1).astype(float)
    write_model("boxes_scores_labels", {"pixels": [1, 3, 48, 64]},
                {"labels": (labels[None], [1, 5]), "unused": (np.zeros((1, 2)), [1, 2]), "scores": (scores[None], [1, 5]),
                 "boxes": (boxes, [5, 4])}, size_input="sizes")
    shift = shift_of([(TOP / HEIGHT, TOP_BGR), (1 - TOP / HEIGHT, BGR)], 1, (123.675, 116.28, 103.53),
                     (58.395, 57.12, 57.375)) + GAIN * 0.001 * (64 + 48)
    kept = best([found(s + shift, round(c + shift), corners((b + shift) * [64, 48, 64, 48]))
                 for b, s, c in zip(boxes, scores, labels)], 0.25)
    write_boxes("boxes_scores_labels", kept)


def fastestdet():  # without its top 64 x 32, to 32 x 16, black on the right up to 48 x 16; cells of 8
    rng = np.random.default_rng(3)
    numbers = np.full((1, 8, 2, 6), 0.01) + rng.uniform(-.5, .5, (1, 8, 2, 6)) * [[[[1]]]] * \
        np.array([0, 1, 1, 1, 1, 0, 0, 0]).reshape(1, 8, 1, 1)
    numbers[0, [0, 5], 0, 1] = .9, .8
    numbers[0, [0, 5], 0, 2] = .8, .7
    numbers[0, [0, 7], 1, 3] = .7, .9
    numbers[0, [0, 6], 1, 0] = .9, .9  # not wanted
    write_model("fastestdet", {"input.1": [1, 3, 16, 48]}, {"758": (numbers, numbers.shape)})
    v = numbers[0] + shift_of([(2 / 3, BGR), (1 / 3, (0, 0, 0))], rgb=False)
    candidates = []
    for y in range(2):
        for x in range(6):
            obj, dx, dy, dw, dh, *classes = v[:, y, x]
            box = corners(np.array([(x + np.tanh(dx)) / 6 * 48, (y + np.tanh(dy)) / 2 * 16, sigmoid(dw) * 48,
                                    sigmoid(dh) * 16]))
            candidates.append(found(obj ** .6 * max(classes) ** .4, int(np.argmax(classes)), box))
    write_boxes("fastestdet", best(candidates, 0.4, 0.45), scale=(0.5, 0.5), offset=(0, -0.5 * TOP))


def embedding():  # two boxes, of one colour each; one half outside the image
    numbers = np.array([[.3, -.2, .1, .5, -.4]])
    for name, batch in (("embedding", "batch"), ("embedding_pairs", 2)):
        write_model(name, {"images": [batch, 3, 8, 4]}, {"features": (numbers, [batch, 5])})
    rows = []
    for bgr in (BGR, TOP_BGR):
        v = numbers[0] + shift_of([(1, bgr)], 1)
        rows.append(v / np.linalg.norm(v))
    write_rows("embedding", rows)


def cuboid(centre, z, alpha, whl):
    """centre: image of the cuboid's centre [px]. Returns x y z, l w h, rotation_y."""
    left = np.array([(centre[0] - CX) * z / FX, (centre[1] - CY) * z / FY, z])
    x, y, z = left - OFFSET  # in the reference camera's frame
    turn = alpha + np.arctan2(x, z)
    return x, y, z, whl[2], whl[0], whl[1], np.arctan2(np.sin(turn), np.cos(turn))


def write_priors(name, mean, std):
    np.save(FOLDER / f"stereo3d_mean_{name}.npy", mean.reshape(-1, 6).astype(np.float32))
    np.save(FOLDER / f"stereo3d_std_{name}.npy", std.reshape(-1, 6).astype(np.float32))


def anchors3d(name, images):  # without its top 64 x 32, at the same size, black on the right up to 80 x 32
    rng = np.random.default_rng(5)
    scales, ratios, base, stride, width, height = [1.0, 1.5], [0.5, 1.0, 2.0], 12.0, 16, 80, 32
    columns, rows, anchors, classes = width // stride, height // stride, len(scales) * len(ratios), 3
    shape = (columns * rows * anchors,)
    logits = rng.uniform(-4, -3, shape + (classes + 1,))
    values = rng.uniform(-1, 1, shape + (12,)) * [2, 2, 1, 1, 2, 2, .5, .5, .5, .5, .5, .5]
    # A car, a truck, two cars that overlap, one of an anchor never seen, something unwanted, a car too low for the road.
    logits[[3, 15, 21, 22, 29, 28, 45], [0, 2, 0, 0, 0, 1, 0]] = [2.0, 1.5, 1.2, 1.4, 2.5, 3.0, 1.8]
    logits[:, classes] = rng.uniform(-1, 1, shape)
    write_model(name, {image: [1, 3, height, width] for image in images},
                {"scores": (logits[None], (1,) + logits.shape), "boxes": (values[None], (1,) + values.shape)})
    mean = {c: rng.uniform([8, -.2, -.2, 1.4, 1.3, 3], [14, .2, .2, 2, 2, 5], (len(scales), len(ratios), 6)) for c in LABELS}
    std = {c: rng.uniform(.2, .9, (len(scales), len(ratios), 6)) for c in LABELS}
    mean[0][1, 2, 0] = -100  # of anchor 5 of each cell
    for c, label in LABELS.items():
        write_priors(label, mean[c], std[c])
        mean[c], std[c] = mean[c].astype(np.float32).astype(float), std[c].astype(np.float32).astype(float)

    shift = shift_of([(64 / 80, BGR), (16 / 80, (0, 0, 0))])
    if len(images) == 2:
        shift += 2 * shift_of([(64 / 80, RIGHT_BGR), (16 / 80, (0, 0, 0))])
    candidates = []
    for y in range(rows):
        for x in range(columns):
            for r, ratio in enumerate(ratios):
                for s, scale in enumerate(scales):  # the scale runs fastest
                    i = ((y * columns + x) * len(ratios) + r) * len(scales) + s
                    score, v = sigmoid(logits[i] + shift), values[i] + shift
                    c = int(np.argmax(score[:classes]))
                    if c not in LABELS:
                        continue
                    m, d = mean[c][s, r], std[c][s, r]
                    px, py = (x + .5) * stride, (y + .5) * stride
                    pw, ph = base * scale / np.sqrt(ratio), base * scale * np.sqrt(ratio)
                    if m[0] <= 0 or not -0.5 < (py + TOP - CY) * m[0] / FY < 1.8 or abs(px - CX) * m[0] / FY >= 40:
                        continue
                    z, sin2, cos2, w, h, l = v[6:12] * d + m
                    alpha = np.arctan2(sin2, cos2) / 2 + (0 if score[classes] >= .5 else np.pi)
                    box = corners([px + v[0] * .1 * pw, py + v[1] * .1 * ph, pw * np.exp(v[2] * .2), ph * np.exp(v[3] * .2)])
                    centre = px + v[4] * .1 * pw, py + v[5] * .1 * ph + TOP
                    box = np.clip(box + [0, TOP, 0, TOP], 0, [WIDTH, HEIGHT, WIDTH, HEIGHT])
                    candidates.append(found(score[c], c, box, *cuboid(centre, z, alpha, (w, h, l))))
    write_boxes(name, best(candidates, 0.5, 0.4))


def monoflex(name, bins):  # 64 x 48 to 32 x 24, cells of 4
    rng = np.random.default_rng(bins)
    rows, columns = 6, 8
    heat = rng.uniform(0, .3, (3, rows, columns))
    heat[[0, 0, 2, 1, 0], [2, 2, 4, 3, 5], [3, 4, 6, 1, 0]] = [.9, .7, .8, .9, .6]  # the second is no peak
    offset = rng.uniform(-.5, .5, (2, rows, columns))
    depth = rng.uniform(9, 20, (1, rows, columns))
    size = rng.uniform([[[1.4]], [[1.3]], [[3]]], [[[2]], [[2]], [[5]]], (3, rows, columns))
    rotation = rng.uniform(-1, 1, (4 * bins, rows, columns))
    outputs = {"heat": heat, "offset": offset, "depth": depth, "size": size, "rotation": rotation}
    write_model(name, {"image": [1, 3, 24, 32]}, {k: (v[None], (1,) + v.shape) for k, v in outputs.items()})
    shift = shift_of([(TOP / HEIGHT, TOP_BGR), (1 - TOP / HEIGHT, BGR)])
    candidates = []
    for c in LABELS:
        for y in range(rows):
            for x in range(columns):
                if heat[c, max(y - 1, 0):y + 2, max(x - 1, 0):x + 2].max() > heat[c, y, x]:
                    continue
                v = rotation[:, y, x] + shift
                if bins == 2:
                    yes, no, turns = v[[1, 5]], v[[0, 4]], [v[2:4], v[6:8]]
                    centres = [-np.pi / 2, np.pi / 2]
                else:
                    yes, no, turns = v[1:8:2], v[0:8:2], v[8:].reshape(4, 2)
                    centres = [0, np.pi / 2, np.pi, -np.pi / 2]
                b = int(np.argmax(yes - no))
                centre = ((x + offset[0, y, x] + shift) * 8, (y + offset[1, y, x] + shift) * 8)
                state = cuboid(centre, depth[0, y, x] + shift, centres[b] + np.arctan2(*turns[b]), size[:, y, x] + shift)
                candidates.append(found(heat[c, y, x] + shift, c, project(state), *state))
    write_boxes(name, best(candidates, 0.5, 0.5))


def project(state):
    """The box around the image of a cuboid."""
    x, y, z, l, w, h, turn = state
    corner = np.array([[a * l / 2, b * h / 2, c * w / 2] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])
    turned = np.stack([np.cos(turn) * corner[:, 0] + np.sin(turn) * corner[:, 2], corner[:, 1],
                       -np.sin(turn) * corner[:, 0] + np.cos(turn) * corner[:, 2]], 1)
    p = turned + [x, y, z] + OFFSET
    u, v = FX * p[:, 0] / p[:, 2] + CX, FY * p[:, 1] / p[:, 2] + CY
    return np.clip([u.min(), v.min(), u.max(), v.max()], 0, [WIDTH, HEIGHT, WIDTH, HEIGHT])


def bad_models():
    """Models that tests expect to fail: an unknown operator set, half precision, NaN, images of any size."""
    def save(name, opset, kind, dtype, shape=(1, 2)):
        given, result = (helper.make_tensor_value_info(key, dtype, shape) for key in ("x", "y"))
        graph = helper.make_graph([helper.make_node(kind, ["x"], ["y"])], name, [given], [result])
        onnx.save(helper.make_model(graph, ir_version=IR_VERSION, opset_imports=[helper.make_opsetid("", opset)]),
                  FOLDER / f"{name}.onnx")

    save("bad_opset", 999, "Abs", TensorProto.FLOAT)
    save("bad_type", OPSET, "Abs", TensorProto.FLOAT16)
    save("bad_values", OPSET, "Log", TensorProto.FLOAT)  # of -1
    save("any_size", OPSET, "Abs", TensorProto.FLOAT, (1, 3, "height", "width"))


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    for write in (yolo_v5, yolox, yolo_v8, yolo_v10, boxes_scores_labels, fastestdet, embedding, bad_models):
        write()
    anchors3d("stereo3d", ["left", "right"])
    anchors3d("mono3d", ["image"])
    monoflex("monoflex", 2)
    monoflex("monoflex_4", 4)


if __name__ == "__main__":
    main()
