"""Entries: what can play, and the sentence with which anything else is refused."""

import base64
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks.brains.network import MAX_LOADED_NETWORK_BYTES
from ai4u_edu.games.tournament import drivers
from ai4u_edu.games.tournament.entry import parse_entry, with_names
from ai4u_edu.games.tournament.game import game
from ai4u_edu.games.tournament.sides import sides_of
from ai4u_edu.locale import Catalogue, unpacked
from ai4u_edu.recording import Episode
from ai4u_edu.recording.episode import decode
from tests.games.tournament.bad_networks import BAD, INPUTS
from tests.learn.training.networks import network
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.needs("train", "tournament")

SUMO = {"name": "sumo"}


def entry(text: str, scene: str = "sumo", **options: Any) -> dict[str, Any]:
    sides = sides_of(Scene.load(scene))
    return parse_entry(text, sides, scene=scene, **options).model_dump(mode="json")


def played(*texts: str, scene: str = "sumo", seed: int = 0, **options: Any) -> dict[str, Any]:
    return game({"name": scene}, seed, [entry(each, scene, **options) for each in texts])


def programs(folder: Path, *sources: str) -> list[str]:
    paths = [folder / f"program{number}.py" for number, _ in enumerate(sources)]
    for path, source in zip(paths, sources, strict=True):
        path.write_text(source)
    return [str(path) for path in paths]


# -- names ----------------------------------------------------------------------------------------


def test_an_entry_is_named_by_its_owner_or_its_file(tmp_path: Path) -> None:
    path = network(tmp_path / "fast one.onnx", INPUTS)
    sides = sides_of(Scene.load("sumo"))
    entries = [parse_entry(each, sides) for each in (str(path), f"Ann=x=={path}"[:4] + str(path))]
    assert [each.name for each in entries] == ["fast one", "Ann"]
    assert [each.name for each in with_names([*entries, entries[0]])] == [
        "fast one",
        "Ann",
        "fast one-2",
    ]


def test_agents_of_a_side_may_have_drivers_of_their_own() -> None:
    assert set(
        entry("a=striker:StrikerController,keeper:KeeperController", "soccer")["drivers"]
    ) == {
        "striker",
        "keeper",
    }
    assert set(entry("zoo:box_chase", "sumo")["drivers"]) == {""}


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("nobody", "nobody is called 'nobody': expected a network"),
        ("a=no.onnx", "the network 'no.onnx' is not there"),
        ("no.episode", "no.episode: can't be read"),
        ("x.py", "say --trust-python"),
        ("WASDRBMoveController", "nobody is called 'WASDRBMoveController'"),
        ("\x07=random", "printable characters"),
    ],
)
def test_what_is_no_entry_is_told(text: str, told: str) -> None:
    with pytest.raises(AI4UError, match=told):
        entry(text)


def test_a_file_that_is_too_large_is_refused_unread(tmp_path: Path) -> None:
    path = tmp_path / "huge.onnx"
    with path.open("wb") as file:
        file.truncate(MAX_LOADED_NETWORK_BYTES + 1)
    with pytest.raises(SetupError, match=r"huge\.onnx: expected at most 67,108,864 bytes"):
        entry(str(path))


# -- networks that can't play ---------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("make", BAD, ids=lambda make: make.__name__)
def test_a_network_that_can_t_play_is_refused_with_a_sentence(
    make: Callable[[Path], None], tmp_path: Path
) -> None:
    path = tmp_path / "bad.onnx"
    make(path)
    told = played(str(path), "PushOutController")
    assert told["forfeit"] == 0
    reason = unpacked(told["reason"])
    assert BAD[make] in reason
    assert str(tmp_path) not in reason
    assert len(reason) <= 600
    assert Catalogue("pt_BR").translate(reason) != reason, "it can be translated"


def test_the_other_side_is_not_blamed(tmp_path: Path) -> None:
    path = network(tmp_path / "few.onnx", INPUTS, size=3)
    assert played("PushOutController", str(path))["forfeit"] == 1


# -- drivers --------------------------------------------------------------------------------------


def test_the_scenes_controllers_play_both_sides() -> None:
    told = played("scene", "scene")
    assert told["forfeit"] == -1
    assert sum(told["points"]) == 0
    assert told == played("scene", "scene"), "the same game twice"


def test_an_agent_without_a_driver_is_told() -> None:
    told = played("scene", "scene", scene="tag")
    assert told["forfeit"] == 0
    reason = unpacked(told["reason"])
    assert reason == "the scene has no scripted controller for agent 'chaser'"
    translation = Catalogue("pt_BR").translate(reason)
    assert translation == "a cena não tem um piloto programado para o agente 'chaser'"
    told = played("a=striker:StrikerController", "scene", scene="soccer")
    assert told["forfeit"] == 0
    assert "it has no driver for agent 'blue_keeper'" in unpacked(told["reason"])


@pytest.mark.slow
@pytest.mark.nightly
@pytest.mark.parametrize(
    ("scene", "one"),
    [
        ("soccer", "a=striker:StrikerController,keeper:KeeperController"),
        ("tag", "a=chaser:random,runner:FleeController"),
    ],
)
def test_a_side_of_several_agents_has_a_driver_for_each(scene: str, one: str) -> None:
    other = "scene" if scene == "soccer" else "b=random"
    told = [played(one, other, scene=scene) for _ in range(2)]
    assert told[0]["forfeit"] == -1
    assert told[0] == told[1]


def test_a_recording_plays_its_actions_again(tmp_path: Path) -> None:
    told = played("PushOutController", "random")
    path = tmp_path / "old.episode"
    path.write_bytes(base64.b64decode(told["episode"]))
    again = played(str(path), "random")
    one, other = (
        decode(Episode, base64.b64decode(each["episode"]), "game").agent("blue")
        for each in (told, again)
    )
    assert other.driver == "old"
    assert [each.action for each in one] == [each.action for each in other][: len(one)]


# -- programs -------------------------------------------------------------------------------------

SILENT = """
import os, time
def decide(percept):
    os.closerange(3, 100)
    time.sleep(600)
"""
STAND = "def decide(percept):\n    return {'move': [0, 0, 0, 0]}\n"


@pytest.fixture(autouse=True)
def _patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no process be ended before it had the time to answer or to end by itself."""
    monkeypatch.setattr(drivers, "SILENCE_LIMIT_S", LIMIT_S)
    monkeypatch.setattr(drivers, "END_TIMEOUT_S", LIMIT_S)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("def decide(percept):\n    return {'move': [0, 0]}\n", "4 numbers"),
        ("def decide(percept):\n    return 1 / 0\n", "line 2"),
        ("def decide(percept):\n    while True: pass\n", "of processor time for a decision"),
        (
            "def decide(percept):\n    import os\n    os._exit(3)\n",
            "the program's process ended (exit status 3)",
        ),
    ],
    ids=["wrong numbers", "error", "endless", "exit"],
)
def test_a_program_that_fails_loses(source: str, told: str, tmp_path: Path) -> None:
    bad, good = programs(tmp_path, source, STAND)
    result = played(good, bad, trust_python=True)
    assert result["forfeit"] == 1
    assert told in unpacked(result["reason"])


@pytest.mark.slow
def test_a_mistake_of_a_program_is_told_in_the_readers_language(tmp_path: Path) -> None:
    (bad,) = programs(tmp_path, "def decide(percept):\n    return speeed\n")
    reason = unpacked(played(bad, "random", trust_python=True)["reason"])
    assert reason.startswith("program0.py, line 2: nothing is called 'speeed'; ")
    translation = Catalogue("pt_BR").translate(reason)
    assert translation.startswith("program0.py, linha 2: nada se chama 'speeed'; ")


@pytest.mark.slow
@pytest.mark.nightly
def test_a_program_that_closes_its_output_and_goes_on_loses(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drivers, "END_TIMEOUT_S", 0.1)
    bad, good = programs(tmp_path, SILENT, STAND)
    result = played(good, bad, trust_python=True)
    assert result["forfeit"] == 1
    assert "the program's process has closed its output" in unpacked(result["reason"])


MEMORY = "def decide(percept):\n    x = bytearray(3 * 2**30)\n    return {'move': [0, 0, 0, 0]}\n"
FILE = """
def decide(percept):
    with open("x", "w") as file:  # else the error comes where nobody sees it
        file.write("x")
    return {"move": [0, 0, 0, 0]}
"""
NETWORK = """
import socket
def decide(percept):
    socket.create_connection(("127.0.0.1", PORT), 5)
    return {"move": [0, 0, 0, 0]}
"""


@pytest.mark.slow
@pytest.mark.nightly
def test_a_program_has_no_memory_files_or_network(tmp_path: Path) -> None:
    import socket

    with socket.create_server(("127.0.0.1", 0)) as server:
        port = str(server.getsockname()[1])
        sources = (MEMORY, FILE, NETWORK.replace("PORT", port))
        for path, told in zip(
            programs(tmp_path, *sources),
            ("line 2: The program needs more memory", "File too large", "unreachable"),
            strict=True,
        ):
            result = played(path, "random", trust_python=True)
            assert result["forfeit"] == 0, path
            assert told in unpacked(result["reason"])
