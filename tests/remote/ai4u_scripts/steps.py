"""An AI4U script as its users write it: a number of steps, with a reset after each episode."""

import json
import os
import sys

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
import numpy as np
from ai4u.controllers import BasicGymController

port, steps = int(sys.argv[1]), int(sys.argv[2])
env = gym.make(
    "AI4UEnv-v0",
    disable_env_checker=True,
    controller_class=BasicGymController,
    config={
        "server_IP": "127.0.0.1",
        "server_port": port,
        "waittime": 0.0,
        "buffer_size": 81920,
        "timeout": 0,  # it waits for the world for as long as it takes
    },
)
obs, info = env.reset()
first = {name: reading.tolist() for name, reading in obs.items()}
rng = np.random.default_rng(0)
log = []
for _ in range(steps):
    action = rng.uniform(env.action_space.low, env.action_space.high).astype(np.float32)
    obs, reward, done, truncated, info = env.step(action)
    log.append(
        {
            "reward": reward,
            "done": done,
            "truncated": truncated,
            "steps": info["steps"],
            "obs": {name: reading[0].tolist() for name, reading in obs.items()},
        }
    )
    if done:
        env.reset()
spaces = {name: list(space.shape) for name, space in env.observation_space.spaces.items()}
print("RESULT", json.dumps({"log": log, "first": first, "spaces": spaces}), flush=True)
os._exit(0)  # its server's thread would wait for the world
