"""Verification: whatever is changed in the folder of a tournament is noticed."""

import copy
import csv
import hashlib
import io
import json
import random
import shutil
import time
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any, ClassVar, Self

import pytest
from typer.testing import CliRunner

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks import Answer, Controller, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.cli.main import app
from ai4u_edu.games.jobs import Job, engine
from ai4u_edu.games.tournament import limits
from ai4u_edu.games.tournament.game import game
from ai4u_edu.games.tournament.plan import TournamentPlan
from ai4u_edu.games.tournament.run import run_tournament, write_results
from ai4u_edu.games.tournament.verify import verify
from ai4u_edu.world import WorldView

pytestmark = [pytest.mark.needs("train", "tournament"), pytest.mark.slow]

PUSH = """
def decide(percept):
    return {"move": [1, 0.1, 0, 0]}
"""
TIRED = """
import random
first, turns = random.random(), 0
def decide(percept):
    global turns
    turns += 1
    if turns > 12 and first == FIRST:
        raise ValueError("it is tired")
    return {"move": [0.5, 0, 0, 0]}
"""


def played(folder: Path, *words: str) -> Path:
    """Play a tournament in sumo by the command."""
    command = ["tournament", "sumo", *words, "--seeds", "1", "--engine", "inline"]
    done = CliRunner().invoke(app, [*command, "--out", str(folder)])
    assert done.exit_code == 0, done.output
    return folder


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a tournament without programs."""
    return played(tmp_path_factory.mktemp("plain") / "out", "Ann=scene", "Bob=random")


@pytest.fixture(scope="module")
def trusted(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a tournament with two programs, of which one fails in some games."""
    folder = tmp_path_factory.mktemp("trusted")
    (folder / "push.py").write_text(PUSH)
    first = random.Random("0/blue").random()  # it does not fail against itself, on another seed
    (folder / "tired.py").write_text(TIRED.replace("FIRST", repr(first)))
    words = [f"{name}={folder / name}.py" for name in ("push", "tired")]
    played(folder / "out", *words, "Eve=scene", "--trust-python")
    reasons = [each["reason"] for each in listed(folder / "out")]
    assert sum("it is tired" in each for each in reasons) == 2
    return folder / "out"


@pytest.fixture
def folder(kind: str, request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return a copy of the folder of a tournament."""
    return Path(shutil.copytree(request.getfixturevalue(kind), tmp_path / "out"))


def listed(folder: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads((folder / "games.json").read_text())
    return found


class Memory:
    """An engine that remembers results, as the games of a folder are the same in each round."""

    width = 1
    results: ClassVar[dict[str, Any]] = {}

    def start(self, job: Job) -> None:
        self._job = job

    def wait(self) -> Any:
        key = self._job.key
        if key not in self.results:
            inline = engine("inline")
            inline.start(self._job)
            self.results[key] = inline.wait()
        return self.results[key]

    def close(self) -> None:
        """Do nothing: nothing runs."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def problems(folder: Path) -> list[str]:
    """Return what verification tells, or the sentence with which it refuses the folder."""
    try:
        return verify(folder, Memory())[1]
    except AI4UError as error:
        return [str(error)]


def renew_sums(folder: Path) -> None:
    """Write the hashes of the files again, as whoever changes a file would."""
    files = sorted(each for each in folder.rglob("*") if each.is_file())
    lines = [
        f"{hashlib.sha256(each.read_bytes()).hexdigest()}  {each.relative_to(folder).as_posix()}\n"
        for each in files
        if each.name != "SHA256SUMS"
    ]
    (folder / "SHA256SUMS").write_text("".join(lines))


# -- changes --------------------------------------------------------------------------------------


def changed_json(data: Any) -> Iterator[tuple[str, Any]]:
    """Yield data with each of its values changed, removed, and doubled in turn."""
    for path, value in _values(data):
        yield f"{path} changed", _with(data, path, _other(value))
        if path:
            yield f"{path} removed", _without(data, path)
        if isinstance(value, list):
            for index, each in enumerate(value):
                yield f"{path} doubled", _with(data, path, [*value[:index], each, *value[index:]])


def _values(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    yield path, data
    if isinstance(data, dict | list):
        for name, each in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _values(each, (*path, name))


def _other(value: Any) -> Any:
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + 1
    if isinstance(value, str):
        # also of a long one, such as a recording, one character alone
        return f"{value[:-9]}{'B' if value[-9:-8] != 'B' else 'C'}{value[-8:]}" if value else "x"
    if isinstance(value, list):
        return [*reversed(value)] if len(value) > 1 and value != value[::-1] else [*value, None]
    return value | {"one more": 1} if isinstance(value, dict) else 1


def _with(data: Any, path: tuple[Any, ...], value: Any) -> Any:
    if not path:
        return value
    made = copy.deepcopy(data)
    place = made
    for name in path[:-1]:
        place = place[name]
    place[path[-1]] = value
    return made


def _without(data: Any, path: tuple[Any, ...]) -> Any:
    made = copy.deepcopy(data)
    place = made
    for name in path[:-1]:
        place = place[name]
    del place[path[-1]]
    return made


def changed_texts(path: Path, text: str) -> Iterator[tuple[str, str]]:
    """Yield the text of a file with each of its fields and lines changed in turn."""
    if path.name == "journal.jsonl":
        lines = text.splitlines()
        for number, line in enumerate(lines):
            for what, data in changed_json(json.loads(line)):
                others = [*lines[:number], json.dumps(data), *lines[number + 1 :]]
                yield f"job {number}: {what}", "\n".join(others) + "\n"
    elif path.suffix == ".json":
        for what, data in changed_json(json.loads(text)):
            yield what, json.dumps(data, indent=1) + "\n"
    elif path.suffix == ".csv":
        rows = [*csv.reader(io.StringIO(text))]
        for number, row in enumerate(rows):
            for place in range(len(row)):
                cells = [*row[:place], f"{row[place]}1", *row[place + 1 :]]
                changed = [*rows[:number], cells, *rows[number + 1 :]]
                yield f"cell {number}, {place}", "".join(f"{','.join(each)}\n" for each in changed)
    lines = text.splitlines(keepends=True)
    for number in range(len(lines)):
        yield f"line {number} removed", "".join([*lines[:number], *lines[number + 1 :]])
        yield f"line {number} doubled", "".join([*lines[: number + 1], *lines[number:]])


def changes(folder: Path) -> Iterator[tuple[str, Callable[[], object]]]:
    """Yield changes of each file of a folder, and each field of it, with what they are called."""
    for path in sorted(each for each in folder.rglob("*") if each.is_file()):
        name, data = path.relative_to(folder).as_posix(), path.read_bytes()
        yield f"{name} removed", path.unlink
        beside = path.with_name(f"copy-{path.name}")
        yield f"{name} doubled", partial(shutil.copy, path, beside)
        middle = len(data) // 2
        flipped = data[:middle] + bytes([data[middle] ^ 1]) + data[middle + 1 :]
        yield f"{name} altered", partial(path.write_bytes, flipped)
        yield f"{name} longer", partial(path.write_bytes, data + b"\n")
        yield f"{name} emptied", partial(path.write_bytes, b"")
        if path.suffix in {".json", ".jsonl", ".csv"} or path.name == "SHA256SUMS":
            for what, text in changed_texts(path, data.decode()):
                yield f"{name}: {what}", partial(path.write_text, text)


def files_in(folder: Path) -> dict[Path, bytes]:
    return {each: each.read_bytes() for each in folder.rglob("*") if each.is_file()}


def restore(files: Mapping[Path, bytes], folder: Path) -> None:
    for path in files_in(folder).keys() - files.keys():
        path.unlink()
    for path, data in files.items():
        path.write_bytes(data)


MEASURED = ("'seconds'", "'tries'")
"""Fields of the journal that nothing else tells."""


@pytest.mark.parametrize("kind", ["plain", "trusted"])
@pytest.mark.parametrize("share", [23, pytest.param(1, marks=pytest.mark.nightly)])
def test_every_change_of_a_file_or_a_field_is_noticed(folder: Path, share: int) -> None:
    """With the old hashes, and with those that whoever changes a file can write, too."""
    files = files_in(folder)
    assert problems(folder) == []
    unnoticed, done = [], 0
    for number, (what, change) in enumerate(changes(folder)):
        if number % share:
            continue
        done += 1
        change()
        assert files_in(folder) != files, what
        if not problems(folder):
            unnoticed.append(what)
        if not what.startswith("SHA256SUMS") and not any(each in what for each in MEASURED):
            renew_sums(folder)
            if not problems(folder):
                unnoticed.append(f"{what}, with new hashes")
        restore(files, folder)
    assert unnoticed == []
    assert done > 500 // share
    assert problems(folder) == []


# -- forged results: the journal, and all that the command makes of it -----------------------------


def forge(folder: Path, change: Callable[[list[dict[str, Any]]], object]) -> None:
    """Change the results in the journal, and have the command write all files after it."""
    path = folder / "journal.jsonl"
    lines = [json.loads(each) for each in path.read_text().splitlines()]
    games = {each["job"]: number for number, each in enumerate(listed(folder))}
    change(sorted((each for each in lines if each["key"] in games), key=lambda e: games[e["key"]]))
    path.write_text("".join(f"{json.dumps(each)}\n" for each in lines))
    shutil.rmtree(folder / "games")
    plan = TournamentPlan.load(folder)
    write_results(run_tournament(plan, folder, engine("inline")))


def turn_points(games: list[dict[str, Any]]) -> None:
    games[0]["result"]["points"].reverse()


def turn_goals(games: list[dict[str, Any]]) -> None:
    goals = (each["result"]["goal"] for each in games)
    next(each for each in goals if any(each) and not all(each)).reverse()


def invent_failure(games: list[dict[str, Any]]) -> None:
    whole = next(each["result"] for each in games if each["result"]["forfeit"] < 0)
    whole |= {"forfeit": 0, "reason": "it took 1.2 s of processor time for a decision"}


def deny_failure(games: list[dict[str, Any]]) -> None:
    for each in games:
        each["result"] |= {"forfeit": -1, "reason": ""}


def blame_the_other(games: list[dict[str, Any]]) -> None:
    for each in games:
        if each["result"]["forfeit"] >= 0:
            each["result"]["forfeit"] = 1 - each["result"]["forfeit"]


def exchange_recordings(games: list[dict[str, Any]]) -> None:
    one, other = games[0]["result"], games[1]["result"]
    one["episode"], other["episode"] = other["episode"], one["episode"]


def exchange_results(games: list[dict[str, Any]]) -> None:
    games[0]["result"], games[1]["result"] = games[1]["result"], games[0]["result"]


def take_another_scene(games: list[dict[str, Any]]) -> None:
    for each in games:
        entries = [{"name": "a", "drivers": {"": {"kind": "random"}}}] * 2
        each["result"] = game({"name": "tag"}, 0, entries) | {"points": [1.0, 0.0]}


def take_no_recordings(games: list[dict[str, Any]]) -> None:
    for each in games:
        each["result"]["episode"] = ""


FORGERIES: dict[str, tuple[Callable[[list[dict[str, Any]]], object], ...]] = {
    "plain": (
        turn_points,
        turn_goals,
        invent_failure,
        exchange_recordings,
        exchange_results,
        take_another_scene,
        take_no_recordings,
    )
}
FORGERIES["trusted"] = (*FORGERIES["plain"], deny_failure, blame_the_other)


@pytest.mark.parametrize(
    ("kind", "change"),
    [
        pytest.param(kind, change, id=f"{kind} {change.__name__}")
        for kind, changes in FORGERIES.items()
        for change in changes
    ],
)
def test_results_that_no_game_gave_are_noticed(
    folder: Path, change: Callable[[list[dict[str, Any]]], object]
) -> None:
    forge(folder, lambda _: None)
    assert problems(folder) == []
    forge(folder, change)
    assert problems(folder) != []


@pytest.mark.parametrize("kind", ["plain"])
def test_nothing_outside_of_the_folder_is_read(folder: Path, tmp_path: Path) -> None:
    game_file = folder / "games" / listed(folder)[0]["file"]
    outside = tmp_path / "other.episode"
    game_file.rename(outside)
    found = listed(folder)
    found[0]["file"] = "../../other.episode"
    (folder / "games.json").write_text(json.dumps(found, indent=1) + "\n")
    assert "the folder says '../../other.episode'" in problems(folder)[0]
    game_file.symlink_to(outside)
    assert any("expected a file of the tournament" in each for each in problems(folder))
    game_file.unlink()
    (folder / "games").rename(tmp_path / "games")
    (folder / "games").symlink_to(tmp_path / "games")
    assert any(each.startswith("games: expected a file") for each in problems(folder))


@pytest.mark.parametrize("kind", ["plain"])
def test_a_tournament_that_is_not_finished_is_told(folder: Path) -> None:
    plan = TournamentPlan.load(folder)
    (folder / "journal.jsonl").unlink()

    def stop(_: object) -> None:
        raise KeyboardInterrupt

    write_results(run_tournament(plan, folder, engine("inline"), show=stop))
    assert "games.json: it has 0 games, and the plan has 2" in problems(folder)
    (folder / "games.json").unlink()
    with pytest.raises(SetupError, match="expected a finished tournament, and there is no games"):
        verify(folder, engine("inline"))


STARTS = count()


class SlowSoon(Controller):
    """Takes too much time, after a number of decisions that is another one each time.

    Of four games on end the first two are the check, in which it drives both sides.
    """

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Choose the decision."""
        number = next(STARTS)
        self._left = 10**9 if number % 4 < 2 else 3 + number

    def get_action(self, percept: Percept) -> Answer:
        """Return an action, sometimes too late."""
        self._left -= 1
        since = time.thread_time()
        while self._left < 0 and time.thread_time() - since < 1.5 * limits.DECISION_CPU_S:
            pass
        return {"move": [0, 0, 0, 0]}


def test_a_failure_by_time_may_come_at_another_decision(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "DECISION_CPU_S", 1.0)  # others never need as much
    monkeypatch.setitem(globals(), "STARTS", count())  # other tests start all controllers
    folder = played(tmp_path / "out", "Sue=SlowSoon", "Ann=scene")
    games = listed(folder)
    assert [each["entries"][each["forfeit"]] for each in games] == ["Sue", "Sue"]
    assert games[0]["ticks"] != games[1]["ticks"]
    assert verify(folder, engine("inline")) == (2, [])
    found = listed(folder)
    found[0]["points"][0] += 1.0
    (folder / "games.json").write_text(json.dumps(found, indent=1) + "\n")
    (told,) = verify(folder, engine("inline"))[1]
    assert "game 1 (Sue vs Ann, seed 0): points: the folder says" in told


def test_long_names_in_other_scripts_fit_into_the_names_of_files(tmp_path: Path) -> None:
    folder = played(tmp_path / "out", f"{40 * '名'}=random", f"{40 * '字'}=scene")
    assert verify(folder, engine("inline")) == (2, [])
