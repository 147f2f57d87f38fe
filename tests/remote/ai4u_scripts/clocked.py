"""Measure the steps per second of an AI4U script whose actions are computed beforehand."""

import json
import os
import sys
import time

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
import numpy as np
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
env.reset()
action = np.array([0.1, 1.0, 0.0, 0.0], np.float32)  # round and round, so that it never falls
steps = int(sys.argv[2])
for _ in range(200):
    env.step(action)
began = time.perf_counter()
for _ in range(steps):
    _, _, done, _, _ = env.step(action)
    if done:
        env.reset()
print("RESULT", json.dumps(steps / (time.perf_counter() - began)), flush=True)
os._exit(0)
