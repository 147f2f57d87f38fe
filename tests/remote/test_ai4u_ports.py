"""The scenes of AI4U that docs/from-ai4u.md moves here, step by step."""

import re
from pathlib import Path
from textwrap import dedent

import numpy as np
import pytest

from ai4u_edu import BasicAgent, ControlRequestor, LocalBrain, Scene
from ai4u_edu.blocks.loading import load_blocks

PAGE = Path(__file__).parents[2] / "docs" / "from-ai4u.md"


def fences(language: str) -> list[str]:
    text = PAGE.read_text(encoding="utf-8")
    return [dedent(each) for each in re.findall(rf" +```{language}\n(.*?) +```", text, re.DOTALL)]


def test_box_chase_has_ai4us_observations() -> None:
    box, _ = fences("yaml")
    sim = Scene.loads(box).build(brains=lambda _: LocalBrain(controller=lambda _: {}))
    sim.reset(1)
    percept = sim.agents[0].percept
    assert percept["vision"].shape == (4, 16 * 2), "a script gets it as one row of 128"
    assert percept["array"].shape == (6,)
    latest = percept["vision"][-1].reshape(16, 2)
    assert latest[15, 0] == pytest.approx(50 / 255), "the ray behind it meets the floor"
    codes = set((latest[:, 0] * 255).round().tolist())
    assert {50} < codes <= {0, 50, 255}


def grid_world(tmp_path: Path) -> ControlRequestor:
    (blocks,) = fences("python")
    file = tmp_path / "ai4u_grid.py"
    file.write_text(blocks, encoding="utf-8")
    load_blocks(file)
    return Scene.loads(fences("yaml")[1]).build(
        brains=lambda _: LocalBrain(controller=lambda _: {}, skip_frame=9)
    )


def test_grid_world_has_ai4us_matrix_and_actions(tmp_path: Path) -> None:
    sim = grid_world(tmp_path)
    agent = sim.agents[0]

    @agent.begin_of_update_state.connect
    def send(agent: BasicAgent) -> None:
        agent.take_fields({"goalDist": ("3",)})

    choices = iter([0, 1, 4, 4, 3, 2, 4, 2])
    brain = LocalBrain(controller=lambda _: {"grid": next(choices)}, skip_frame=9)
    agent.use_brain(brain)
    sim.reset(1)
    grid = agent.percept["vision"]
    assert np.argwhere(grid == 150).tolist() == [[5, 13]]
    assert np.argwhere(grid == 200).tolist() == [[8, 13]]
    assert agent.percept["goalDist"].tolist() == [3]
    assert grid[0, 19] == 50, "the north wall"
    for cell in ([5, 14], [5, 13], [6, 13], [7, 13], [6, 13]):
        sim.step()
        assert np.argwhere(agent.percept["vision"] == 150).tolist() == [cell]
    sim.step()
    assert agent.reward == 0, "the dirt is two cells away"
    sim.step()
    sim.step()
    assert agent.reward == 1
    assert not (agent.percept["vision"] == 200).any()
