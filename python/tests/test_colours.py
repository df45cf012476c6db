# SPDX-License-Identifier: BSD-3-Clause
import dataclasses

import numpy as np
import pytest

import sslcd
from conftest import DATA, mapper_for


def test_colours_tell_boxes_apart():
    image = np.zeros((100, 200, 3), np.uint8)
    image[:, :100] = (0, 0, 200)  # red, in BGR
    image[:, 100:] = (200, 0, 0)
    boxes = [[0, 0, 50, 50], [50, 50, 100, 100], [100, 0, 200, 100], [-9, -9, -1, -1], [np.nan] * 4]
    red, also_red, blue, outside, none = sslcd.colour_vectors(image, boxes)
    assert red @ also_red > 0.99 and red @ blue < 0.5
    assert not outside.any() and not none.any()
    flipped = sslcd.colour_vectors(image[:, ::-1], [[0, 0, 100, 100]])[0]  # a view
    assert flipped @ blue > 0.99
    assert sslcd.colour_vectors(image, []).shape[0] == 0
    assert sslcd.colour_vectors(image, boxes, {"mode": "paper"}).shape != (5, len(red))


def test_colours_of_the_host_are_those_of_a_run(tmp_path):
    for path in (DATA / "sim_out_and_back").iterdir():
        if path.name != "embeddings.npy":
            (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "image_2").mkdir()
    dataset = sslcd.load_dataset(tmp_path, max_frames=60)
    for frame in dataset:
        (tmp_path / "image_2" / f"{frame.index:06}.png").touch()
    dataset = sslcd.load_dataset(tmp_path, max_frames=60)

    def image(path):
        rng = np.random.default_rng(int(path[-10:-4]))
        return rng.integers(0, 256, (720, 1280, 3), np.uint8)

    result = sslcd.run(dataset, load_image=image)
    mapper = mapper_for(dataset)
    for frame in dataset:
        if frame.boxes is not None:
            colours = sslcd.colour_vectors(image(frame.image_left), frame.boxes)
            frame = dataclasses.replace(frame, colours=colours)
        mapper.add(frame)
    mapper.refine()
    assert result.images_failed == 0 and len(mapper.objects) == len(result.objects) > 20
    assert np.allclose(mapper.trajectory.poses, result.trajectory.poses, atol=1e-6)


@pytest.mark.parametrize(
    "image, boxes, message",
    [
        (np.zeros((9, 9, 3)), [], "image is ndarray, expected a NumPy array of uint8"),
        ("car.png", [], "image is str"),
        (np.zeros((9, 9), np.uint8), [], r"image has the shape \(9, 9\)"),
        (np.zeros((0, 9, 3), np.uint8), [], "image has the shape"),
        (np.zeros((9, 9, 3), np.uint8), [1, 2, 3, 4], "boxes has the shape"),
    ],
)
def test_bad_images_and_boxes(image, boxes, message):
    with pytest.raises(sslcd.UsageError, match=message):
        sslcd.colour_vectors(image, boxes)
