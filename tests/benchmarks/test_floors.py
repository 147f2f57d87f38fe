"""The benchmark compares equal worlds: same poses, same observations, same rewards."""

import numpy as np
import pytest

from ai4u_edu import BodyView
from ai4u_edu.learn.envs import SceneEnv
from tests.benchmarks.course import course
from tests.benchmarks.floors import BareFloor, CffiFloor, CompiledFloor, PublicFloor, compiled

in_c = pytest.mark.skipif(compiled() is None, reason="no C compiler here")


@pytest.mark.parametrize(
    "floor", [PublicFloor, CffiFloor, BareFloor, pytest.param(CompiledFloor, marks=in_c)]
)
@pytest.mark.parametrize("seed", [1, 5, 14])
def test_the_hand_written_loop_is_the_yardstick(floor: type[PublicFloor], seed: int) -> None:
    env = SceneEnv("yardstick", observation="flat")
    env.reset(seed=seed)
    loop = floor(env.sim)
    pushed = met = 0
    for action in course(300, seed):
        mine, reward, *ends, _ = env.step(action)
        theirs, amount, *its_ends, _ = loop.step(action)
        assert np.abs(mine - theirs).max() < 2e-6
        assert reward == pytest.approx(amount, abs=1e-12)
        assert ends == its_ends
        assert env.agent.body.position == tuple(loop.robot.position)
        pushed += any(np.hypot(*body.velocity) > 0.1 for body in boxes(env))
        met += int((mine[:32] > 0).sum())
        if any(ends):
            break
    assert met > 1000
    assert any(ends)
    assert pushed, "a box was in the way"


def boxes(env: SceneEnv) -> list[BodyView]:
    return [body for name, body in env.sim.world.bodies.items() if name.startswith("box")]
