"""PenActuator, and what sees its ink: ColourSensor, LineSensor, FigureReward."""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ColourSensor,
    ControlRequestor,
    FigureReward,
    LineSensor,
    LocalBrain,
    PenActuator,
    RBMoveActuator,
    Scene,
    World,
)
from ai4u_edu.base.errors import BlockError, ParameterError
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.world.ink import INK_COLOURS, ink_code
from tests.scenes.solvers import solver_of

AHEAD = [1, 0, 0, 0]


def robot(
    *actions: Mapping[str, Any], world: World | None = None, **parts: Any
) -> ControlRequestor:
    """A robot at (0, 0) that heads along +x; it takes the actions in turn, then goes ahead."""
    world = world or World()
    world.add_body("robot", CircleShape(radius=0.3))
    rest = iter(actions)
    agent = BasicAgent(
        body="robot",
        actuators=[RBMoveActuator(move_amount=2, turn_amount=2), parts.pop("pen", PenActuator())],
        brains=[LocalBrain(controller=lambda _: next(rest, {"move": AHEAD}))],
        **parts,
    )
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    return sim


def colour_at(sim: ControlRequestor, x: float, y: float) -> str:
    code = sim.world.ink.at(x, y)
    return INK_COLOURS[code - 1] if code else "none"


def test_it_draws_while_it_is_down() -> None:
    sim = robot({"move": AHEAD}, {"move": AHEAD, "pen": [1]}, {"move": AHEAD}, {"pen": [0]})
    places = [0.0]
    for _ in range(6):
        sim.step()
        places.append(sim.agents[0].body.position[0])
    middles = [(one + other) / 2 for one, other in pairwise(places)]
    assert [colour_at(sim, x, 0.0) for x in middles] == [
        "none", "black", "black", "none", "none", "none",
    ]  # fmt: skip


def test_colour_and_width_are_chosen_with_each_action() -> None:
    pen = PenActuator(colours=["blue", "orange", "none"], width=0.1, max_width=0.5)
    assert pen.slots() == ("down", "colour", "width")
    assert pen.space().high.tolist() == [1, 2, 1]
    blue, orange = ({"move": AHEAD, "pen": [1, *rest]} for rest in ([0, 0], [1, 1]))
    sim = robot(blue, blue, blue, blue, orange, pen=pen)
    for _ in range(5):
        sim.step()
    x = sim.agents[0].body.position[0]
    assert (colour_at(sim, 0.1, 0), colour_at(sim, x, 0.2)) == ("blue", "orange")
    assert colour_at(sim, 0.1, 0.1) == "none"
    assert PenActuator().slots() == ("down",)
    assert PenActuator(max_width=0.3).slots() == ("down", "width")


def test_a_colour_that_is_unknown() -> None:
    with pytest.raises(ParameterError, match="colours"):
        PenActuator(colours=["crimson"])  # type: ignore[list-item]  # on purpose


def test_it_draws_nothing_in_the_air_and_on_a_box() -> None:
    world = World()
    world.add_body("block", BoxShape(size=(4, 4)), kind="static", position=(0, 6), height=0.5)
    sim = robot(*[{"move": [0, 0, 0, 0], "pen": [1]}] * 2, world=world)
    sim.agents[0].body.move_to(0.0, 6.0, z=0.5)
    sim.step()
    assert not sim.world.ink
    sim.agents[0].body.move_to(0.0, 0.0, z=3.0)
    sim.step()
    assert not sim.world.ink


def test_an_agents_restart_keeps_the_ink_and_lifts_the_pen() -> None:
    sim = robot({"move": AHEAD, "pen": [1]})
    for _ in range(3):
        sim.step()
    ink = sim.world.ink.image()
    sim.restart(sim.agents[0])
    assert sim.world.ink.image() is ink
    sim.step()
    assert sim.world.ink.image() is ink
    sim.reset()
    assert not sim.world.ink


def test_what_the_colour_sensor_sees() -> None:
    world = World()
    world.add_floor("paper", BoxShape(size=(6, 6)), colour="white")
    world.add_floor("plain", BoxShape(size=(6, 6)), position=(6, 0))
    world.add_area("spot", CircleShape(radius=1), position=(0, 2), colour="blue", paint=True)
    world.add_area("goal", CircleShape(radius=1), position=(0, -2), colour="blue")
    sim = robot(world=world, sensors=[ColourSensor(ahead=0)])
    agent = sim.agents[0]

    def seen(x: float, y: float) -> list[float]:
        agent.body.move_to(x, y)
        return [round(float(number) * 255) for number in agent.sense()["colour"]]

    assert seen(0, 0) == [255, 255, 255, 255]
    assert seen(0, 2)[:3] == [0, 114, 178]
    assert seen(0, -2) == seen(0, 0)  # an area that is no paint is no colour
    assert seen(6, 0)[:3] == [228, 232, 236]
    assert seen(20, 0) == [0, 0, 0, 0]
    sim.world.ink.draw((0, 2), (0.3, 2), 0.0, 0.3, ink_code("orange"))
    assert seen(0.1, 2)[:3] == [230, 159, 0]
    assert seen(0.1, 2)[3] == round(0.299 * 230 + 0.587 * 159)
    spots = agent.bound_blocks.sensors[0].spots()
    assert spots is not None
    assert spots.lit == (True,)


def test_the_line_sensor_sees_ink_without_any_area() -> None:
    sim = robot(sensors=[LineSensor(points=3, ahead=0.5, width=0.4)])
    agent = sim.agents[0]
    assert agent.sense()["line"].tolist() == [0, 0, 0]
    sim.world.ink.draw((0.5, 0.2), (0.7, 0.2), 0.0, 0.1, ink_code("blue"))
    assert agent.sense()["line"].tolist() == [1, 0, 0]
    with pytest.raises(BlockError, match="no area carries the tag 'lime'"):
        robot(sensors=[LineSensor(group="lime")])


def figure(**fields: Any) -> tuple[ControlRequestor, FigureReward]:
    world = World()
    world.add_area("bar", BoxShape(size=(1.0, 0.4)), position=(0.5, 0), tags=("figure",))
    reward = FigureReward(reward=10, **fields)
    return robot(world=world, rewards=[reward]), reward


def test_the_overlap_of_a_drawing_with_its_figure() -> None:
    sim, reward = figure()
    sim.world.ink.draw((0.2, 0), (0.8, 0), 0.0, 0.4, ink_code("blue"))
    sim.step()
    whole, drawn = 1.0 * 0.4, 0.6 * 0.4 + np.pi * 0.2**2
    assert reward.overlap == pytest.approx(drawn / whole, abs=0.03)
    assert sim.agents[0].reward == pytest.approx(10 * reward.overlap)
    before = reward.overlap
    sim.world.ink.draw((0.5, 1), (0.5, 1.5), 0.0, 0.4, ink_code("blue"))  # beside it
    sim.step()
    assert sim.agents[0].reward == pytest.approx(10 * (reward.overlap - before))
    assert reward.overlap < before


def test_an_overlap_that_is_large_enough_is_paid_once() -> None:
    sim, _ = figure(at_least=0.5, cause_episode_to_end=True)
    sim.step()
    assert sim.agents[0].reward == 0
    sim.world.ink.draw((0.1, 0), (0.9, 0), 0.0, 0.4, ink_code("blue"))
    sim.step()
    assert (sim.agents[0].reward, sim.agents[0].done) == (10, True)


def test_a_figure_that_nobody_has_drawn_in_the_scene() -> None:
    with pytest.raises(BlockError, match="no area carries the tag 'figur'"):
        robot(rewards=[FigureReward(group="figur")])


@pytest.fixture(scope="module")
def drawing() -> Episode:
    scene = Scene.load("draw_figure")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=solver_of("draw_figure")))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(4)
    while not sim.agents[0].done:
        sim.step()
    recorder.finish()
    return recorder.episodes[-1]


def test_a_recording_is_replayed_with_its_ink(drawing: Episode, tmp_path: Path) -> None:
    episode = Episode.load(drawing.save(tmp_path / "house.episode"))
    replay = Replay(episode)
    assert replay.verdict.why == ""
    late = replay.at(60).snapshot.state.world.ink
    early = replay.at(30).snapshot.state.world.ink
    assert early.digest != late.digest
    assert replay.at(60).snapshot.state.world.ink.digest == late.digest
    goes_on = replay.continue_from(60, brains={"0": LocalBrain(controller=lambda _: {})})
    assert goes_on.world.ink.digest == late.digest


def test_moments_of_the_past_share_tiles(drawing: Episode) -> None:
    cache = FrameCache(drawing).start()
    try:
        last = cache.snapshot(cache.last, timeout=None)
        images = [
            frame.state.world.ink
            for step in range(cache.last + 1)
            if (frame := cache.snapshot(step, timeout=None)) is not None
        ]
    finally:
        cache.stop()
    assert last is not None
    assert len(images) == cache.last + 1
    different = {id(tile) for image in images for tile in image.tiles.values()}
    assert len(different) < 2.5 * len(images)  # of up to five tiles, a frame changes one or two
    bare, inked = (draw_snapshot(frame) for frame in (cache.snapshot(0), last) if frame is not None)
    black = (inked.astype(int).sum(axis=2) < 60).sum() - (bare.astype(int).sum(axis=2) < 60).sum()
    assert black > 4000


def test_a_copy_of_the_world_has_the_ink_and_the_pen(drawing: Episode) -> None:
    there = Replay(drawing).continue_from(50, brains={})
    copy = Scene.load("draw_figure").build()
    copy.set_state(there.get_state())
    action = {"move": [1, 0.2, 0, 0]}
    for sim in (there, copy):
        sim.agents[0].use_brain(LocalBrain(controller=lambda _: action))
        for _ in range(20):
            sim.step()
    assert copy.world.ink.digest == there.world.ink.digest
    assert copy.agents[0].percept.data == there.agents[0].percept.data
    assert capture_snapshot(copy).bodies == capture_snapshot(there).bodies
