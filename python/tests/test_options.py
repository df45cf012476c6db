# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import sslcd


@pytest.mark.parametrize(
    "options, messages",
    [
        (
            {"loop": {"layout": {"every": 3}}},
            ["unknown key 'every' in 'layout' - did you mean 'every_m'?"],
        ),
        ({"lop": {}}, ["unknown key 'lop' - did you mean 'loop'?"]),
        ({"loop": 3}, ["loop=3: 'loop' is a section"]),
        ({"loop": {"enabled": {}}}, ["loop.enabled=: 'enabled'"]),
        (
            {"filter": {"min_score": 2}, "map": {"memory_m": "far"}},
            [
                "filter.min_score=2: 'min_score' is 2, must be in [0, 1]",
                "map.memory_m=far: 'memory_m' is 'far'",
            ],
        ),
        ({"filter": {"min_score": float("nan")}}, ["min_score"]),
        ({"filter": {"min_score": None}}, ["filter.min_score: is None, must be a number"]),
        ({"filter": {"min_score": [1]}}, ["filter.min_score: is [1]"]),
        ({"loop.enabled": True, "loop": {"enabled": False}}, ["loop.enabled: given twice"]),
        ({"loop": {"enabled": 1}}, ["'enabled' is '1', must be true or false"]),
        ({"mode": "papr"}, ["'mode' is 'papr', must be one of robust, paper"]),
        (
            {"filter.min_size_m": 5.0, "filter.max_size_m": 1},
            ["filter.min_size_m is 5, must be at most"],
        ),
    ],
)
def test_problems_are_named_with_their_keys(options, messages):
    for use in (sslcd.Mapper, sslcd.complete_options):
        with pytest.raises(sslcd.BadConfigError) as caught:
            use(options)
        for message in messages:
            assert message in str(caught.value)
        assert "--set" not in str(caught.value)


def test_what_is_no_dict_is_a_wrong_call():
    for options in (3, "loop", [("loop", {})], {1: 2}, {"loop": {2: 1}}):
        with pytest.raises(sslcd.UsageError, match="options"):
            sslcd.Mapper(options)


def test_numbers_of_numpy_and_dotted_keys():
    given = {
        "loop": {"layout": {"every_m": np.float64(4)}},
        "loop.layout.look_back": np.int64(1),
        "level.enabled": np.bool_(False),
        "window": {},
    }
    complete = sslcd.complete_options(given)
    assert (
        complete["loop"]["layout"]["every_m"] == 4 and complete["loop"]["layout"]["look_back"] == 1
    )
    assert complete["level"]["enabled"] is False
    assert complete["ba"] == sslcd.default_options()["ba"]


def test_all_options_go_round():
    for mode in ("robust", "paper"):
        options = sslcd.default_options(mode)
        assert options["mode"] == mode and sslcd.complete_options(options) == options
    assert sslcd.default_options("paper") != sslcd.default_options()


def test_options_reach_the_mapper(drive):
    for frame in [drive[0]]:
        assert (
            sslcd.Mapper({"filter": {"max_range_m": 0.1}}).add(frame).filter.too_far
            == len(frame)
            > 0
        )


def test_a_file_of_a_run_is_read(tmp_path, drive):
    sslcd.run(drive, {"loop": {"enabled": False}}).write(tmp_path / "run")
    options = sslcd.read_options(tmp_path / "run" / "config.yaml")
    assert options == sslcd.complete_options({"loop": {"enabled": False}})
    file = tmp_path / "config.yaml"
    file.write_text("vision:\n  detector: x.yaml\n\n  lift: {}\nloop: {enabled: false}\n")
    assert sslcd.read_options(file) == options
    file.write_text("vision:\n  detector: x.yaml\nlop: 1\n")
    with pytest.raises(sslcd.BadConfigError, match=r"config.yaml:3:1: unknown key 'lop'"):
        sslcd.read_options(file)
    with pytest.raises(sslcd.BadInputError, match="missing.yaml"):
        sslcd.read_options(tmp_path / "missing.yaml")
