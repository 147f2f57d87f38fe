"""The small learner is installed always, so it loads no more than that needs."""

import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

PROGRAM = """
import sys
from ai4u_edu.learn.small import actor_critic, behaviour_cloning, neural_network, onnx_file
from ai4u_edu.learn.small import ppo_training
from ai4u_edu.learn import small_trainer
for name in ("torch", "stable_baselines3", "onnx", "onnxruntime", "viser", "starlette"):
    if name in sys.modules:
        print(name)
"""


def test_it_loads_neither_a_training_library_nor_a_page() -> None:
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("", "")
