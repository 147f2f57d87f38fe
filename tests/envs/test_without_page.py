"""An environment without a page loads nothing that only a page needs."""

import subprocess
import sys

import pytest

PAGE = {
    "ai4u_edu.class_link",
    "ai4u_edu.class_member",
    "ai4u_edu.editing",
    "ai4u_edu.explain",
    "ai4u_edu.panel",
    "ai4u_edu.recording",
    "ai4u_edu.remote",
    "ai4u_edu.room",
    "ai4u_edu.runtime",
    "ai4u_edu.server",
    "ai4u_edu.viewer",
    "httpx",
    "msgspec",
    "starlette",
    "torch",
    "uvicorn",
    "viser",
    "websockets",
}
"""Packages that a training without a page must not load."""
STEPS = """
import sys
from ai4u_edu.envs import SceneEnv, SceneVectorEnv
env = {call}
env.reset(seed=1)
for _ in range(10):
    env.step(env.action_space.sample() * 0)
print(*sys.modules)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "call",
    [
        "SceneEnv('box_chase')",
        "SceneEnv('box_chase', render_mode='rgb_array')",
        "SceneVectorEnv(2, 'box_chase')",
    ],
)
def test_steps_without_a_page_load_nothing_of_it(call: str) -> None:
    command = [sys.executable, "-c", STEPS.format(call=call)]
    names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    assert "ai4u_edu.envs" in names
    assert PAGE & {*names} == set()
