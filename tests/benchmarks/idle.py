"""What costs nothing where it is not used: ``python -m tests.benchmarks.idle``.

The yardstick as it is, and with more in it that nobody uses: blocks that are switched off, and
bodies, floors and areas that change nothing for the robot. Ratios as in ``tests.benchmarks``.
"""

import argparse
from typing import Any

from ai4u_edu import Scene
from ai4u_edu.envs import SceneEnv
from ai4u_edu.scenes import SceneDescription
from tests.benchmarks.__main__ import SEED, Contender, one_world
from tests.benchmarks.interleaved import race


def changed(**more: Any) -> SceneEnv:
    """The yardstick with more blocks on its agent."""
    plain = Scene.load("yardstick").plain()
    agent = plain["agents"][0]
    for kind, blocks in more.items():
        agent[kind] = [*agent[kind], *blocks]
    scene = Scene(SceneDescription.model_validate(plain))
    return SceneEnv(scene, observation="flat")


def contender(env: SceneEnv) -> Contender:
    """An environment, ready at the beginning of the episode."""

    def ready() -> SceneEnv:
        env.reset(seed=SEED)
        return env

    return one_world(ready)


def main() -> None:
    """Measures and prints."""
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
            "as it is": contender(changed()),
            "the same once more": contender(changed()),
            "four events with a listener": contender(heard),
            "a sensor that is off": contender(changed(sensors=[rays | off])),
            "a reward that is off": contender(
                changed(rewards=[{"type": "MinDistReward", "target": "target"} | off])
            ),
        },
        "as it is",
        options.rounds,
    )
    best = timings["as it is"].fastest
    print("| the yardstick | microseconds | takes | by the fastest |")
    print("|---|---|---|---|")
    for name, (micros, fastest, speed) in timings.items():
        print(f"| {name} | {micros:.1f} | {1 / speed:.3f} x as long | {fastest / best:.3f} x |")


if __name__ == "__main__":
    main()
