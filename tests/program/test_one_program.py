"""One file of a student drives everywhere: evaluated, recorded, played, and in a notebook."""

import json
import runpy
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.cli.main import app
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.lessons.rollouts import drives
from ai4u_edu.recording import Episode
from tests.program.solutions import entry_of, solution

SEED, EPISODES = 3, 2
SEEDS = list(range(SEED, SEED + EPISODES))
CHEAP = ["box_chase", "jumper"]
REST = [
    pytest.param(name, marks=pytest.mark.nightly) for name in Scene.names() if name not in CHEAP
]


def driven(spec: str, name: str) -> list[list[Any]]:
    """Return the actions of the episodes as ``play --brain`` makes them."""
    sim = Scene.load(name).build()
    agent = sim.agents[0]
    agent.use_brain(entrant(spec).brain(agent))
    found = []
    for seed in SEEDS:
        sim.reset(seed)
        actions = []
        while not agent.done:
            sim.step()
            actions.append({name: tuple(each) for name, each in agent.last_action.items()})
        found.append(actions)
    return found


@pytest.mark.parametrize("name", [*CHEAP, *REST])
def test_the_commands_make_the_same_episodes(name: str, tmp_path: Path) -> None:
    file = tmp_path / "program.py"
    file.write_text(solution(name))
    spec = f"{file}:{entry_of(name)}"
    expected = driven(spec, name)
    common = ["--episodes", str(EPISODES), "--seed", str(SEED)]

    told = CliRunner().invoke(app, ["evaluate", name, "--brain", spec, *common, "--json", "-"])
    assert told.exit_code == 0, told.output
    (found,) = json.loads(told.stdout)
    assert [each["seed"] for each in found["each"]] == SEEDS
    assert [each["length"] for each in found["each"]] == [len(each) for each in expected]
    assert found["success"] == 1

    out = tmp_path / "episodes"
    command = ["record", name, "--brain", spec, *common, "--out", str(out)]
    told = CliRunner().invoke(app, command)
    assert told.exit_code == 0, told.output
    recorded = [Episode.load(file) for file in sorted(out.glob("*.episode"))]
    assert [each.seed for each in recorded] == SEEDS
    for episode, actions in zip(recorded, expected, strict=True):
        assert [each.action for each in episode.agents[0]] == actions


@pytest.mark.parametrize("name", [*CHEAP, pytest.param("maze", marks=pytest.mark.nightly)])
def test_a_notebook_that_has_the_text_in_a_cell_drives(name: str, tmp_path: Path) -> None:
    """There a function gets the readings as arrays of numpy, as all cells of the course do."""
    file = tmp_path / "cell.py"
    file.write_text(solution(name))
    thing = runpy.run_path(str(file))[entry_of(name)]
    assert all(each.won for each in drives(name, thing, SEEDS))
