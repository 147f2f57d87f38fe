"""An environment without a page loads nothing that only a page needs."""

import subprocess
import sys

import pytest

from tests.without import code_without

PAGE = {
    "ai4u_edu.member",
    "ai4u_edu.page.editing",
    "ai4u_edu.explain",
    "ai4u_edu.page.panel",
    "ai4u_edu.recording",
    "ai4u_edu.remote",
    "ai4u_edu.room",
    "ai4u_edu.runtime",
    "ai4u_edu.page.server",
    "ai4u_edu.page.viewer",
    "httpx",
    "msgspec",
    "onnxruntime",
    "starlette",
    "torch",
    "uvicorn",
    "viser",
    "websockets",
}
"""Packages that an environment without a page must not load."""
STEPS = """
import sys
from ai4u_edu.learn.envs import SceneEnv, SceneVectorEnv
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
    assert "ai4u_edu.learn.envs" in names
    assert PAGE & {*names} == set()


HUMAN = """
from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.envs import SceneEnv
env = SceneEnv("box_chase", render_mode="rgb_array")
env.reset(seed=1)
env.step(env.action_space.sample())
print(env.render().shape)
try:
    SceneEnv("box_chase", render_mode="human")
except SetupError as error:
    print(error)
"""


@pytest.mark.slow
def test_it_works_where_the_page_is_not_installed_and_says_what_human_needs() -> None:
    code = code_without(sorted(PAGE - {"msgspec", "httpx", "onnxruntime", "torch"}), HUMAN)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    shape, sentence = done.stdout.splitlines()
    assert shape.endswith(", 3)")
    assert sentence == (
        'render_mode="human" (but not "rgb_array") needs ai4u_edu.room.env_page, which can\'t be '
        "imported here: No module named 'ai4u_edu.room'; install it with: pip install ai4u-edu"
    )
