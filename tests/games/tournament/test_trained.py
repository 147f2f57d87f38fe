"""A tournament of eight networks that one sweep trained with different seeds."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ai4u_edu.cli.main import app

pytestmark = [pytest.mark.slow, pytest.mark.nightly]

SETTINGS = """
algorithm: ppo
max_steps: 60
check_episodes: 2
enough: 0
ppo: {worlds: 8, n_steps: 32}
"""


def run(*arguments: str) -> str:
    done = CliRunner().invoke(app, list(arguments))
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.stdout


@pytest.mark.timeout(3600)
def test_eight_networks_of_a_sweep_play_and_are_verified_bit_for_bit(tmp_path: Path) -> None:
    settings, trained, cup = tmp_path / "sumo.yaml", tmp_path / "sweep", tmp_path / "cup"
    settings.write_text(SETTINGS)
    sweep = ("sweep", "sumo", "--settings", str(settings), "--seeds", "0-7", "--steps", "512")
    run(*sweep, "--out", str(trained))
    networks = sorted(map(str, (trained / "networks").iterdir()))
    assert len(networks) == 8
    run("tournament", "sumo", *networks, "--seeds", "1", "--out", str(cup))
    games = json.loads((cup / "games.json").read_text())
    assert len(games) == 56
    assert len({tuple(each["points"]) for each in games}) > 1
    assert "56 games, played again: all are the same" in run("tournament", "verify", str(cup))
