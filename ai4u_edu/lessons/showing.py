"""``show`` and ``stop``: one world at a time, under the cell that asked for it."""

import atexit
from pathlib import Path
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import LocalBrain
from ai4u_edu.lessons.class_membership import set_world
from ai4u_edu.lessons.live import Live
from ai4u_edu.lessons.notebook_output import after_each_cell, in_notebook, put
from ai4u_edu.lessons.rollouts import brain_for
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, translate
from ai4u_edu.recording import Recorder
from ai4u_edu.scenes import Scene
from ai4u_edu.world import World

_current: Live | None = None


def show(
    world: "ControlRequestor | Scene | World | str | Path" = "box_chase",
    brain: Any = None,
    *,
    seed: int | None = None,
    height: int = 440,
    record: str | Path | None = None,
) -> Live:
    """Run a world and show its page under the cell; the one shown before ends.

    Args:
        world: a scene's name or file, a scene, a world with its agents (ControlRequestor), or a
            world alone.
        brain: the first agent's driver: a function, a controller or a brain; default: its own.
        seed: seed of the first episode.
        height: height of the page, pixels; 440 fits a laptop's screen beside JupyterLab's bars.
        record: a folder in which every episode is saved as a file.
    """
    global _current
    sim, scene, title = _sim_of(world)
    if brain is not None:
        sim.agents[0].use_brain(brain_for(brain, sim.agents[0]))
    stop()
    description = scene.description if scene else None
    if record is not None and scene is not None:
        recorder = Recorder.into(Path(record), sim, scene)
    elif record is not None:
        raise SetupError(_("record: expected a scene or its name to go with it; give show a scene"))
    else:
        recorder = Recorder(sim, scene=description)
    _current = live = Live(sim, recorder, title, seed, scene)
    set_world(live)
    live.end_without_page(_end)
    words = translate(_("{title} runs at {address}", title=library_text(title), address=live.url))
    put(live.page(height), words, live.handle)
    if in_notebook():
        put("", "", live.film)
        after_each_cell(_keep)
    return live


def stop() -> None:
    """End the world that is shown; an animation of its last episode stays in its place."""
    global _current
    if _current is not None:
        ended, _current = _current, None
        set_world(None)
        ended.stop()


def _end(live: Live) -> None:
    """End a world whose page is gone."""
    global _current
    if _current is live:
        _current = None
        set_world(None)
    live.stop()


def _keep(_: object = None) -> None:
    if _current is not None:
        _current.keep()


@atexit.register
def _close() -> None:
    if _current is not None:  # by now there may be no notebook left to tell
        _current.close()


def _sim_of(world: Any) -> tuple[ControlRequestor, Scene | None, str]:
    if isinstance(world, ControlRequestor):
        return world, None, translate(_("Your world"))
    if isinstance(world, World):
        return _looked_at(world), None, translate(_("Your world"))
    scene = world if isinstance(world, Scene) else Scene.load(world)
    return scene.build(), scene, scene.description.title or scene.description.name


def _looked_at(world: World) -> ControlRequestor:
    """Return a world without agents, to be looked at."""
    bodies = [name for name, body in world.bodies.items() if body.moves]
    if not bodies:
        raise SetupError(_("show: expected a world with a body that can move; add one first"))
    agent = BasicAgent(body=bodies[0], brains=[LocalBrain(controller=lambda _: {})])
    return ControlRequestor(world, [agent])
