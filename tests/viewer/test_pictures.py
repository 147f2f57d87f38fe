"""Picture readings in the panel, in the colours of the scene."""

import re

import numpy as np

from ai4u_edu.blocks import ChannelLegend, CodeLegend, GridSensor, LocalGridSensor, RayCastingSensor
from ai4u_edu.snapshot.theme import UNKNOWN_GROUP, VOID
from ai4u_edu.viewer.panel.pictures import MAX_CELLS_PER_SIDE, pictures

COLOURS = {"wall": (1, 2, 3), "dirty": (4, 5, 6)}


def cells(svg: str) -> dict[str, set[tuple[int, int]]]:
    """The (column, row) of each cell, by colour."""
    found: dict[str, set[tuple[int, int]]] = {}
    for colour, path in re.findall(r'<path fill="rgb(.*?)" d="(.*?)"/>', svg):
        for x, y, width in re.findall(r"M(\d+) (\d+)h(\d+)v1h-\d+z", path):
            found.setdefault(colour, set()).update((int(x) + i, int(y)) for i in range(int(width)))
    return found


def test_a_map_of_codes_has_the_colours_of_its_groups() -> None:
    sensor = GridSensor(rows=2, columns=3, group_code={"wall": 50, "dirty": 200, "gone": 7})
    reading = np.array([[50, 50, 0], [200, 7, 50]], np.int32)
    (svg,) = re.findall("<svg.*?</svg>", pictures(reading, sensor.legend(), COLOURS))
    assert cells(svg) == {
        "(1, 2, 3)": {(0, 0), (1, 0), (2, 1)},
        "(4, 5, 6)": {(0, 1)},
        str(UNKNOWN_GROUP): {(1, 1)},
    }
    assert 'viewBox="0 0 3 2"' in svg


def test_normalised_codes_and_stacked_ones_mean_the_same() -> None:
    sensor = GridSensor(rows=1, columns=2, group_code={"wall": 50, "dirty": 200}, normalized=True)
    older, newer = np.array([[1.0, 1.0]]), np.array([[0.25, 0.0]])
    stacked = np.concatenate([older, newer]).astype(np.float32)
    assert sensor.legend().groups_in(stacked).tolist() == [[1, 0]]


def test_rays_show_what_they_met_and_how_far_away_it_is() -> None:
    sensor = RayCastingSensor(rows=1, columns=3, group_code={"wall": 1}, return_distance=True)
    reading = np.array([[[1.0, 0.0, 0.0]], [[0.25, 0.5, 0.0]]])
    for shape in ((2, 1, 3), (6,)):  # a row of numbers is laid out again
        codes, far = re.findall(
            "<svg.*?</svg>", pictures(reading.reshape(shape), sensor.legend(), COLOURS)
        )
        assert cells(codes) == {"(1, 2, 3)": {(0, 0)}}
        near, farther = sorted(cells(far), key=lambda rgb: int(rgb.strip("(").split(",")[0]))
        assert (cells(far)[near], cells(far)[farther]) == ({(0, 0)}, {(1, 0)})


def test_what_a_ray_reads_that_meets_nothing_stays_free() -> None:
    legend = RayCastingSensor(rows=1, columns=2, group_code={"wall": 1}, no_object_code=4).legend()
    assert legend.groups_in([[1.0, 0.25]]).tolist() == [[0, 1]]


def test_channels_lie_on_each_other() -> None:
    legend = LocalGridSensor(width=3, height=1, channels=["void", "wall"]).legend()
    reading = np.array([[[255, 0], [255, 255], [0, 0]]], np.uint8)
    assert cells(pictures(reading, legend, COLOURS)) == {str(VOID): {(0, 0)}, "(1, 2, 3)": {(1, 0)}}
    older = np.full((1, 3, 2), 255, np.uint8)
    stacked = np.concatenate([older, reading], axis=2)
    assert legend.groups_in(stacked).tolist() == [[1, 2, 0]]


def test_noise_changes_no_colour() -> None:
    legend = CodeLegend((1, 2), (0.5, 1.0), ("wall", "dirty"))
    assert legend.groups_in([[0.45, 0.8]]).tolist() == [[1, 2]]


def test_a_huge_picture_is_drawn_in_part() -> None:
    rng = np.random.default_rng(1)
    reading = rng.integers(0, 2, (512, 512, 1)).astype(np.uint8)
    svg = pictures(reading, ChannelLegend(("wall",)), COLOURS)
    assert max(max(cell) for cell in cells(svg)["(1, 2, 3)"]) < MAX_CELLS_PER_SIDE
    assert len(svg) < 60_000


def test_older_readings_are_smaller_and_stand_first() -> None:
    legend = GridSensor(rows=1, columns=2, group_code={"wall": 50, "dirty": 200}).legend()
    stacked = np.array([[200, 0], [50, 0]])
    older, latest = re.findall("<svg.*?</svg>", pictures(stacked, legend, COLOURS, stack=2))
    assert cells(older) == {"(4, 5, 6)": {(0, 0)}}
    assert cells(latest) == {"(1, 2, 3)": {(0, 0)}}
    assert 'width="8"' in older
    assert 'width="24"' in latest


def test_older_pictures_with_channels_are_found_among_the_channels() -> None:
    legend = LocalGridSensor(width=2, height=1, channels=["void", "wall"]).legend()
    older = np.array([[[255, 0], [0, 0]]], np.uint8)
    latest = np.array([[[0, 0], [0, 255]]], np.uint8)
    stacked = np.concatenate([older, latest], axis=2)
    first, second = re.findall("<svg.*?</svg>", pictures(stacked, legend, COLOURS, stack=2))
    assert cells(first) == {str(VOID): {(0, 0)}}
    assert cells(second) == {"(1, 2, 3)": {(1, 0)}}
