"""Drives as a person drives by keys, and worlds in which they are kept."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ai4u_edu import Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.runner import Runner
from tests.page.panel.rooms import PanelRoom
from tests.page.server.rooms import PATIENT
from tests.waiting import LIMIT_S

SEEDS = range(1, 13)


def drive(seed: int, scene: str = "box_chase", *, decisions: int = 400) -> Episode:
    """Drive to the box by keys, and return the episode."""
    loaded = Scene.load(scene)
    sim = loaded.build()
    recorder = Recorder(sim, scene=loaded.description)
    sim.reset(seed)
    (agent,) = sim.agents
    for _ in range(decisions):
        steer(sim)
        sim.step()
        if agent.done:
            break
    recorder.finish()
    return recorder.episodes[-1]


def steer(sim: ControlRequestor) -> None:
    """Hold the keys that bring the robot closer to the box."""
    keyboard = sim.agents[0].keyboard
    keyboard.clock = lambda: 0.0  # keys stay held until others are
    x, y, _, heading = sim.world["robot"].pose
    to_x, to_y, *_ = sim.world["box"].pose
    angle = math.remainder(math.atan2(to_y - y, to_x - x) - heading, math.tau)
    turn = [] if abs(angle) < 0.2 else ["KeyA" if angle > 0 else "KeyD"]
    keyboard.hold([*turn, *["KeyW"] * (abs(angle) < 0.6)])


@contextmanager
def teaching_room(folder: Path | None, scene: str = "box_chase") -> Iterator[PanelRoom]:
    """Serve a scene, paused, with a work folder."""
    loaded = Scene.load(scene)
    sim = loaded.build()
    runner = Runner(sim, seed=1, recorder=Recorder(sim, scene=loaded.description))
    editor = SceneEditor(runner, loaded)
    editor.work_folder = folder
    runner.paused = True
    runner.start()
    try:
        with serve_world(runner, editor=editor, timeouts=PATIENT) as world:
            yield PanelRoom(runner, world.viewer, editor, world.context, world.url)
    finally:
        runner.stop(LIMIT_S)
