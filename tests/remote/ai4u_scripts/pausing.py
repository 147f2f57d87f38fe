"""An AI4U script that pauses, resumes and stops its agent."""

import json
import os
import sys

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
from ai4u.controllers import BasicGymController

env = gym.make(
    "AI4UEnv-v0",
    disable_env_checker=True,
    controller_class=BasicGymController,
    config={
        "server_IP": "127.0.0.1",
        "server_port": int(sys.argv[1]),
        "waittime": 0.0,
        "timeout": 0,  # it waits for the world for as long as it takes
    },
)
ahead = [1.0, 0.0, 0.0, 0.0]
seen = []
env.reset()
for action in (ahead, "pause", ahead, "resume", ahead, "stop", ahead, "resume", ahead):
    *_, info = env.step(action)
    seen.append((info["steps"], info["__ctrl_paused__"], info["__ctrl_stopped__"]))
_, info = env.reset()
seen.append((info["steps"], info["__ctrl_paused__"], info["__ctrl_stopped__"]))
*_, info = env.step(ahead)
seen.append((info["steps"], info["__ctrl_paused__"], info["__ctrl_stopped__"]))
print("RESULT", json.dumps(seen), flush=True)
os._exit(0)
