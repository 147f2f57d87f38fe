"""Stars for programs: which scenes have which goals, and that a program reaches them."""

from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.scenes.star_goals import (
    StarGoals,
    library_star_counts,
    library_star_goals,
    star_goals,
)
from tests.program.solutions import entry_of, solution

STARTS = 10
SEEDS = range(5000, 5000 + STARTS)
CHEAP = ["box_chase", "jumper", "sample_scene"]
"""Scenes whose ten starts take less than a second."""


@pytest.mark.parametrize("name", Scene.names())
def test_each_scene_of_the_library_has_goals(name: str) -> None:
    description = Scene.load(name).description
    found = library_star_goals(description)
    assert found is not None
    assert found.count == (2 if name == "forage" else 3), "to survive a minute takes a minute"
    assert (found.few_decisions is None) == (found.count == 2)
    assert library_star_counts()[name] == found.count


def test_a_changed_scene_has_none() -> None:
    state = EditState(Scene.load("maze").description)
    assert state.star_goals == StarGoals(3, 510)
    assert state.describing(success="time").star_goals is None
    assert state.describing(name="maze2").star_goals is None
    assert state.describing(bodies=state.description.bodies[:-1]).star_goals is None
    assert state.describing().star_goals == state.star_goals


def test_a_scene_without_success_has_no_goals() -> None:
    description = Scene.load("maze").description.model_copy(update={"success": None})
    assert star_goals(description) == StarGoals(0, None)


@pytest.mark.parametrize(
    "name",
    [
        *CHEAP,
        *(pytest.param(n, marks=pytest.mark.nightly) for n in Scene.names() if n not in CHEAP),
    ],
)
def test_a_program_of_the_page_reaches_all_goals(name: str, tmp_path: Path) -> None:
    file = tmp_path / "program.py"
    file.write_text(solution(name))
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    agent.use_brain(entrant(f"{file}:{entry_of(name)}").brain(agent))
    decisions = []
    for seed in SEEDS:
        sim.reset(seed)
        while not agent.done:
            sim.step()
        assert agent.ledger.episode_terms.get(str(scene.description.success), 0) > 0, seed
        decisions.append(agent.steps)
    few = scene.description.few_decisions
    if few is not None:
        assert sum(decisions) / STARTS <= few
