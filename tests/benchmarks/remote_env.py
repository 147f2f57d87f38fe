"""Decisions a second of a remote environment: ``python -m tests.benchmarks.remote_env``.

The world is a process of its own, at its usual speed and as fast as it goes; for comparison the
same scene runs in this process.
"""

import time
from typing import Any

import gymnasium

from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.remote import RemoteEnv, connect
from tests.playing import played

SCENE = "box_chase"
SECONDS = 4.0


def steps_per_s(env: gymnasium.Env[Any, Any]) -> float:
    """Return the decisions a second of an environment, and close it."""
    env.reset()
    action, steps, began = env.action_space.sample(), 0, time.perf_counter()
    while (taken := time.perf_counter() - began) < SECONDS:
        _, _, terminated, truncated, _ = env.step(action)
        steps += 1
        if terminated or truncated:
            env.reset()
    env.close()
    return steps / taken


def robot_per_s(url: str, **options: Any) -> float:
    """Return the decisions a second of a robot that turns on the spot."""
    with connect(url, **options) as robot:
        robot.reset()
        steps, began = 0, time.perf_counter()
        while (taken := time.perf_counter() - began) < SECONDS:
            if robot.sense().done:
                robot.reset()
            else:
                robot.act(move=[0, 0.3, 0, 0])
                steps += 1
    return steps / taken


def main() -> None:
    """Print a line for each way to drive."""
    for options in ([], ["--time-scale", "100"]):
        with played(SCENE, *options) as server:
            url = server.url
            rates = {
                "RemoteEnv": steps_per_s(RemoteEnv(url)),
                "RemoteEnv, flat": steps_per_s(RemoteEnv(url, observation="flat")),
                "lockstep": robot_per_s(url, mode="lockstep"),
                "lockstep, one key": robot_per_s(url, mode="lockstep", keys=["orientation"]),
                "realtime": robot_per_s(url),
            }
        for name, rate in rates.items():
            print(f"play {SCENE} {' '.join(options)}: {name}: {rate:.0f} a second")
    print(f"in this process: {steps_per_s(SceneEnv(SCENE)):.0f} a second")


if __name__ == "__main__":
    main()
