"""Cost of features that are not used: ``python -m tests.benchmarks.idle``.

The yardstick as it is, beside one with unused parts (blocks and a recorder that are switched off),
and beside one whose code does not even test whether an event has handlers or a body is in the air.
Ratios as in ``tests.benchmarks``.
"""

import argparse
import ast
import inspect
import textwrap
import time
from types import MethodType
from typing import Any

from ai4u_edu import Scene
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.recording import Recorder
from ai4u_edu.scenes import SceneDescription
from tests.benchmarks.contenders import SEED, Contender, one_world
from tests.benchmarks.interleaved import race


def changed(**more: Any) -> SceneEnv:
    """Return the yardstick with more blocks on its agent."""
    plain = Scene.load("yardstick").plain()
    agent = plain["agents"][0]
    for kind, blocks in more.items():
        agent[kind] = [*agent[kind], *blocks]
    scene = Scene(SceneDescription.model_validate(plain))
    return SceneEnv(scene, observation="flat")


def without(env: SceneEnv, attribute: str) -> SceneEnv:
    """Remove each ``if`` that tests an attribute from the environment's decision cycle.

    With a name that nothing has, nothing is removed; that shows the cost of the method itself.
    """
    agent, world = env.agent, env.sim.world
    for owner, names in ((agent, ("begin_step", "sense", "end_step")), (world, ("tick",))):
        for name in names:
            method = getattr(type(owner), name)
            tree = ast.parse(textwrap.dedent(inspect.getsource(method)))
            tree = _WithoutTests(attribute).visit(tree)
            found: dict[str, Any] = {}
            exec(compile(tree, "<without>", "exec"), method.__globals__, found)  # noqa: S102
            setattr(owner, name, MethodType(found[name], owner))
    return env


class _WithoutTests(ast.NodeTransformer):
    def __init__(self, attribute: str) -> None:
        self._attribute = attribute

    def visit_If(self, node: ast.If) -> ast.If | None:
        attributes = (each for each in ast.walk(node.test) if isinstance(each, ast.Attribute))
        return None if any(each.attr == self._attribute for each in attributes) else node


def recorded(on: bool) -> SceneEnv:
    """Return the yardstick with a recorder that was switched on once."""
    env = changed()
    recorder = Recorder(env.sim, keep=1)
    recorder.set_enabled(True)
    recorder.set_enabled(on)
    return env


def contender(env: SceneEnv) -> Contender:
    """Return a contender with an environment that is reset before each round."""

    def ready() -> SceneEnv:
        env.reset(seed=SEED)
        return env

    return one_world(ready)


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.idle", description=__doc__)
    parser.add_argument("--rounds", type=int, default=60)
    options = parser.parse_args()
    off = {"is_active": False}
    rays = {"type": "LinearRayCastingSensor", "number_of_rays": 64, "perception_key": "more rays"}
    heard = changed()
    for moment in ("begin_of_step", "end_of_step", "begin_of_update_state", "end_of_update_state"):
        getattr(heard.agent, moment).connect(lambda _: None)
    timings = race(
        {
            "as it is": contender(without(changed(), "nothing")),
            "the same once more": contender(without(changed(), "nothing")),
            "no test for handlers": contender(without(changed(), "handlers")),
            "no test for bodies in the air": contender(without(changed(), "movers")),
            "a recorder that is off": contender(recorded(False)),
            "a sensor that is off": contender(changed(sensors=[rays | off])),
            "a reward that is off": contender(
                changed(rewards=[{"type": "MinDistReward", "target": "target"} | off])
            ),
            "for comparison: four events with a handler": contender(heard),
            "for comparison: a recorder that is on": contender(recorded(True)),
        },
        "as it is",
        options.rounds,
        time.process_time,
    )
    best = timings["as it is"].fastest
    print("| the yardstick | microseconds | takes | by the fastest |")
    print("|---|---|---|---|")
    for name, (micros, fastest, speed) in timings.items():
        print(f"| {name} | {micros:.1f} | {1 / speed:.3f} x as long | {fastest / best:.3f} x |")


if __name__ == "__main__":
    main()
