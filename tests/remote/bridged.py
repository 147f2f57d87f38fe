"""AI4U's own client through the bridge over a bad network: ``python -m tests.remote.bridged``.

The unmodified ``ai4u`` package from PyPI takes its steps over UDP; the bridge hands them on through
a proxy that drops, repeats, reorders, delays and breaks. What the script saw must be what the world
recorded, decision by decision.
"""

import argparse
import contextlib
import sys
import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from ai4u_edu import BasicAgent, RemoteBrain, Scene
from ai4u_edu.remote.bridge import Bridge
from tests.page.server.rooms import Room, served
from tests.remote.faults import BAD
from tests.remote.faulty_proxy import Faults, FaultyProxy
from tests.remote.rooms import patient_rules
from tests.remote.test_ai4u_package import free_port, run_script
from tests.waiting import LIMIT_S

TOKEN = "open sesame"
EPISODE = 60
OPTIONS: dict[str, Any] = {"token": TOKEN, "patience": LIMIT_S}
"""Options of a bridge."""


class Seen:
    """Steps of an agent while a script drove it, recorded in the world."""

    def __init__(self, agent: BasicAgent) -> None:
        self.steps: list[dict[str, Any]] = []
        self.brain: RemoteBrain | None = None
        agent.end_of_update_state.connect(self._sensed)

    def _sensed(self, agent: BasicAgent) -> None:
        if not agent.steps or not isinstance(agent.brain, RemoteBrain):
            return
        self.brain = agent.brain
        percept = agent.percept
        self.steps.append(
            {
                "reward": agent.reward,
                "done": agent.done,
                "truncated": agent.truncated,
                "steps": agent.steps,
                "obs": {name: percept[name].copy() for name in ("vision", "orientation")},
            }
        )


@contextlib.contextmanager
def scene_room(scene: str = "box_chase", **rules: Any) -> Iterator[Room]:
    """A scene that runs as fast as it goes, with a token, for a script on a bad line."""
    sim = Scene.load(scene).build()
    sim.default_time_scale = float("inf")
    sim.agents[0].max_steps_per_episode = EPISODE
    with served(sim, rules=patient_rules(**({"token": TOKEN} | rules))) as room:
        yield room


@contextlib.contextmanager
def bridged(url: str, **options: Any) -> Iterator[tuple[int, list[str]]]:
    """A bridge in a thread, at a port for a script; what it tells."""
    told: list[str] = []
    port = options.pop("port", 0) or free_port()
    bridge = Bridge(url, port=port, tell=told.append, **(OPTIONS | options))

    def run() -> None:
        try:
            bridge.run()
        except Exception as error:
            told.append(f"{type(error).__name__}: {error}")

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield port, told
    finally:
        bridge.stop()
        thread.join(LIMIT_S)
        assert not thread.is_alive()


def run(steps: int, faults: Faults = BAD, seed: int = 1) -> list[str]:
    """Let the script take ``steps`` steps, and return what was wrong, in sentences."""
    began = time.monotonic()  # real time: shown to a person
    with (
        scene_room() as room,
        FaultyProxy(room.url, faults, seed) as proxy,
        bridged(proxy.url) as (port, told),
    ):
        seen = Seen(room.sim.agents[0])
        found = run_script("steps.py", port, steps)["log"]
        # on a busy machine the bridge may have noticed the script's end, and given the agent back
        status = seen.brain.status() if seen.brain else None
        happened = dict(proxy.happened)
    wrong = [f"decision {number}: {each}" for number, each in _differences(found, seen.steps)]
    if len(found) != steps:
        wrong.append(f"the script took {len(found)} steps of {steps}")
    if status is None or (status.decisions, status.missing, status.refused) != (steps, 0, 0):
        wrong.append(f"the brain counted {status}")
    ends = sum(each["done"] for each in found)
    took = time.monotonic() - began  # real time: shown to a person
    print(f"{len(found)} steps, {ends} episode ends in {took:.0f} s; {happened}; told: {told}")
    return wrong


def _differences(found: list[dict[str, Any]], seen: list[dict[str, Any]]) -> Iterator[Any]:
    for number, (one, other) in enumerate(zip(found, seen, strict=False)):
        for key in ("reward", "done", "truncated", "steps"):
            if one[key] != other[key]:
                yield number, f"{key} was {other[key]}, and the script saw {one[key]}"
        for key, value in other["obs"].items():
            if np.array(one["obs"][key], np.float32).tobytes() != value.tobytes():
                yield number, f"the script saw another {key}"
    if len(seen) < len(found):
        yield len(seen), "the world recorded no more"


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    wrong = run(options.steps, seed=options.seed)
    print("\n".join(wrong[:20]) or "every observation as the world recorded it")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
