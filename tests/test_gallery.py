import numpy as np

from ai4u_edu import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.snapshot.theme import SPOT_LIT, SPOT_UNLIT
from tests.gallery import COLUMNS, GAP_PX, TILE_PX, contact_sheet


def test_every_scene_has_its_tile() -> None:
    names = Scene.names()
    sheet = np.asarray(contact_sheet(names))
    rows = -(-len(names) // COLUMNS)
    tall = (sheet.shape[0] - GAP_PX) // rows
    for index in range(len(names)):
        row, column = divmod(index, COLUMNS)
        top, left = GAP_PX + row * tall, GAP_PX + column * (TILE_PX + GAP_PX)
        tile = sheet[top : top + TILE_PX, left : left + TILE_PX].reshape(-1, 3)
        assert len(np.unique(tile, axis=0)) > 10, names[index]


def has(picture: np.ndarray, colour: tuple[int, int, int]) -> bool:
    return bool((picture == colour).all(axis=2).any())


def test_paint_is_drawn_in_its_own_colour_and_eyes_light_up_on_it() -> None:
    sim = Scene.load("line_follow").build()
    sim.reset(1)
    robot = sim.agents[0].body
    pictures = []
    for y in (-3.85, 0.0):  # with all eyes on the line, and with none
        robot.move_to(-1.0, y, heading=np.pi / 2)
        sim.agents[0].sense()
        pictures.append(draw_snapshot(capture_snapshot(sim), longest=900))
    on, off = pictures
    assert has(on, (0, 0, 0))
    assert (has(on, SPOT_LIT), has(on, SPOT_UNLIT)) == (True, False)
    assert (has(off, SPOT_LIT), has(off, SPOT_UNLIT)) == (False, True)
