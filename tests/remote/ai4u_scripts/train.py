"""AI4U's training script, as its users write it: SAC with a MultiInputPolicy."""

import json
import os
import sys

import AI4UEnv  # noqa: F401 - registers the environment
import gymnasium as gym
import torch
from ai4u.controllers import BasicGymController
from stable_baselines3 import SAC
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.sac import MultiInputPolicy

torch.set_num_threads(1)


class Log(BaseCallback):
    """Writes down every step's reward and end."""

    def __init__(self):
        super().__init__()
        self.steps = []

    def _on_step(self):
        self.steps.append((float(self.locals["rewards"][0]), bool(self.locals["dones"][0])))
        return True


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
model = SAC(MultiInputPolicy, env, learning_starts=100, seed=1)
log = Log()
model.learn(total_timesteps=int(sys.argv[2]), callback=log)
print("RESULT", json.dumps({"log": log.steps, "updates": model._n_updates}), flush=True)
os._exit(0)
