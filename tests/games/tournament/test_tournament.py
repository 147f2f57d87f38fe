"""Tournaments: who plays whom, who wins, and that all can be played again."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal

import pytest
from typer.testing import CliRunner

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.cli.main import app
from ai4u_edu.games.jobs import Job, JobOutcome
from ai4u_edu.games.tournament.contest import Contest, ContestResult
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import play_all
from ai4u_edu.games.tournament.standings import standings
from ai4u_edu.games.tournament.tournament import Tournament
from ai4u_edu.locale import reader
from ai4u_edu.recording import Episode
from tests.games.tournament.bad_networks import INPUTS, few_outputs
from tests.learn.training.networks import network

pytestmark = pytest.mark.needs("train", "tournament")


def entries(*names: str) -> list[Entry]:
    return [Entry(name=name, drivers={"": {"kind": "random"}}) for name in names]


def told(*points: float, forfeit: int = -1, goal: bool = False, ticks: int = 9) -> dict[str, Any]:
    goals = [goal for _ in points]
    return {"points": points, "goal": goals, "ticks": ticks, "forfeit": forfeit, "reason": "slow"}


def duel(one: str, other: str, *games: dict[str, Any]) -> ContestResult:
    return ContestResult(Contest(0, tuple(entries(one, other)), is_race=False), games)


# -- who wins -------------------------------------------------------------------------------------


def test_the_rewards_of_both_sides_decide_a_duel() -> None:
    assert duel("a", "b", told(10, -10), told(-10, 10)).ranks == [0, 1]
    assert duel("a", "b", told(10, -10), told(10, -10)).ranks == [0, 0]
    assert duel("a", "b", told(40, -30), told(50, -40)).ranks == [1, 0]


def test_who_fails_loses_whatever_the_points() -> None:
    lost = duel("a", "b", told(90, -10, forfeit=0), told(-10, 90))
    assert lost.ranks == [1, 0]
    assert lost.reasons("a") == ["slow"]
    assert lost.reasons("b") == []
    assert duel("a", "b", told(1, 0, forfeit=0), told(0, 1, forfeit=0)).ranks == [0, 0]


def test_a_race_is_won_by_who_reaches_the_goal_sooner() -> None:
    contest = Contest(0, tuple(entries("a", "b", "c", "d")), is_race=True)
    games = (
        told(5, goal=True, ticks=90),
        told(9, ticks=50),
        told(5, goal=True, ticks=80),
        told(99, forfeit=0),
    )
    assert ContestResult(contest, games).ranks == [1, 2, 0, 3]


def test_a_rating_is_provisional_until_it_is_sure() -> None:
    won = duel("a", "b", told(10, -10), told(-10, 10))
    first, second = standings(["a", "b"], [won])
    assert (first.name, first.won, second.lost) == ("a", 1, 1)
    assert first.is_provisional
    assert first.rating.endswith("(provisional)")
    assert not standings(["a", "b"], [won] * 20)[0].is_provisional


def test_a_game_that_could_not_be_played_counts_for_nobody() -> None:
    contest = Contest(0, tuple(entries("a", "b")), is_race=False)
    first, second = standings(["a", "b"], [ContestResult(contest, (), "the disk is full")])
    assert first.mu == second.mu == 25
    assert first.won + first.drawn + first.lost == 0


# -- who plays whom -------------------------------------------------------------------------------


def played(
    system: Literal["round-robin", "swiss"], *names: str, seeds: tuple[int, ...] = (0,)
) -> Tournament:
    """Return a tournament in which who comes first in the alphabet wins."""

    def play(jobs: Sequence[Job]) -> Iterator[JobOutcome]:
        for job in jobs:
            one, other = (entry["name"] for entry in job.arguments["entries"])
            sign = (one < other) - (one > other)
            yield JobOutcome(job, told(sign, -sign) | {"episode": "", "reason": ""})

    plan = TournamentPlan(
        scene={"name": "sumo"},
        entries=tuple(entries(*names)),
        seeds=seeds,
        system=system,
        rounds=4,
    )
    done = Tournament(plan, Path("unused"))
    play_all(done, play)
    return done


def test_in_a_round_robin_all_meet_on_each_seed_and_change_sides() -> None:
    done = played("round-robin", "a", "b", "c", seeds=(0, 1))
    assert len(done.ended) == 6
    assert [each["entries"] for each in done.games[:2]] == [["a", "b"], ["b", "a"]]
    assert [result.contest.seed for result in done.results] == [0, 0, 0, 1, 1, 1]


def test_in_swiss_rounds_nobody_meets_twice_and_everybody_rests_once_at_most() -> None:
    names = ["a", "b", "c", "d", "e"]
    done = played("swiss", *names)
    pairs = [result.contest.names for result in done.results]
    rounds = [pairs[first : first + 2] for first in range(0, len(pairs), 2)]
    assert len(rounds) == 4
    assert len({frozenset(pair) for pair in pairs}) == len(pairs)
    rested = [name for met in rounds for name in names if not any(name in pair for pair in met)]
    assert len(set(rested)) == len(rested) == 4
    assert done.standings[0].name == "a"


# -- the command ----------------------------------------------------------------------------------


def run(*arguments: str) -> str:
    done = CliRunner().invoke(app, ["tournament", *arguments])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.stdout


@pytest.mark.slow
def test_a_tournament_is_rated_shown_and_played_again(tmp_path: Path) -> None:
    out, bad = tmp_path / "out", tmp_path / "<b>bad.onnx"
    few_outputs(bad)
    still = network(tmp_path / "still.onnx", INPUTS)
    options = ("--seeds", "1", "--engine", "inline", "--out", str(out))
    words = ("sumo", "scene", "PushOutController", str(still), str(bad))
    output = run(*words, *options)
    assert "refused: <b>bad: " in output
    games = json.loads((out / "games.json").read_text())
    assert len(games) == 6
    assert len([*(out / "games").iterdir()]) == 6
    page = (out / "index.html").read_text()
    assert "<b>bad" not in page
    assert page.count("<iframe") == 3
    assert "http://" not in page
    assert "https://" not in page

    journal = (out / "journal.jsonl").read_bytes()
    assert len(journal) < 300_000, "without the networks"
    assert run(*words, *options) == output
    assert (out / "journal.jsonl").read_bytes() == journal, "what is finished is played no more"
    assert "6 games, played again: all are the same" in run(
        "verify", str(out), "--engine", "inline"
    )

    # who changes a result or a recording is found out
    file = out / "games" / games[0]["file"]
    other = Episode.load(out / "games" / games[2]["file"])
    before = file.read_bytes()
    other.save(file)
    with pytest.raises(AI4UError, match="1 of 6 games differ"):
        run("verify", str(out), "--engine", "inline")
    file.write_bytes(before)
    games[1]["points"] = [99, 0]
    (out / "games.json").write_text(json.dumps(games))
    with pytest.raises(AI4UError, match="1 of 6 games differ"):
        run("verify", str(out), "--engine", "inline")
    with pytest.raises(AI4UError, match="holds a tournament with other entries"):
        run(*words[:-1], *options)


@pytest.mark.slow
def test_a_scene_of_one_agent_is_a_race(tmp_path: Path) -> None:
    with reader("pt_BR"):
        output = run(
            *("box_chase", "zoo", "random", "--seeds", "2"),
            *("--engine", "inline", "--out", str(tmp_path)),
        )
    assert output.splitlines()[1].split()[:2] == ["1", "zoo"]
    page = (tmp_path / "index.html").read_text()
    assert '<html lang="pt-BR">' in page
    assert "ganha quem chega antes ao objetivo" in page
    # whoever verifies it may speak another language
    assert "4 games, played again" in run("verify", str(tmp_path), "--engine", "inline")


def test_fewer_than_two_that_can_play_are_no_tournament(tmp_path: Path) -> None:
    few_outputs(tmp_path / "bad.onnx")
    with pytest.raises(AI4UError, match="expected two entries that can play at least; bad: "):
        run(
            *("sumo", "scene", str(tmp_path / "bad.onnx"), "--engine", "inline"),
            *("--out", str(tmp_path / "out")),
        )
