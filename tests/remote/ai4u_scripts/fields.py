"""An AI4U script that sends fields with its actions, in the ways that the package has."""

import json
import os
import sys

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
from ai4u.controllers import BasicGymController


def with_fields(last_obs, action, info):
    BasicGymController.add_field("goal", [0.25, 1])
    BasicGymController.add_field("nobody", 7)


BasicGymController.step_callback = with_fields
env = gym.make(
    "AI4UEnv-v0",
    disable_env_checker=True,
    controller_class=BasicGymController,
    config={
        "server_IP": "127.0.0.1",
        "server_port": int(sys.argv[1]),
        "waittime": 0.0,
        "buffer_size": 81920,
        "timeout": 0,
    },
)
obs, info = env.reset()
first = obs["goal"][0].tolist(), info.get("__warning__", "")
obs, reward, done, truncated, info = env.step([1, 0, 0, 0])
then = obs["goal"][0].tolist(), info.get("__warning__", "")
print("RESULT", json.dumps([first, then]), flush=True)
os._exit(0)
