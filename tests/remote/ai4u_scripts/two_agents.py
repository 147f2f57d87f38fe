"""An AI4U script with two agents, each with its id and its port."""

import json
import os
import sys

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
from ai4u.controllers import BasicGymController

config = {
    "server_IP": "127.0.0.1",
    "port_generator": iter(map(int, sys.argv[1:3])),
    "timeout": 0,  # it waits for the world for as long as it takes
}
envs = [
    gym.make(
        "AI4UEnv-v0",
        disable_env_checker=True,
        controller_class=BasicGymController,
        rid=["0", "1"],
        config=config,
    )
    for _ in range(2)
]
ids = [env.reset()[1]["id"] for env in envs]
log = []
for step in range(int(sys.argv[3])):
    turn = 0.1 + 0.01 * (step % 10)
    for index, env in enumerate(envs):
        _, reward, done, _, info = env.step([1.0, -turn if index else turn, 0.0, 0.0])
        log.append((info["id"], info["steps"], reward, done))
        if done:
            env.reset()
print("RESULT", json.dumps({"ids": ids, "log": log}), flush=True)
os._exit(0)
