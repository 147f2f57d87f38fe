"""The commands record, replay and dataset, and what play keeps."""

import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner, Result

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import NoDecisionError
from ai4u_edu.cli import episodes as episode_commands
from ai4u_edu.cli.main import app
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.runtime.runner import Runner
from tests.page.server.rooms import NOWHERE
from tests.playing import played
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

SEEK = """
def seek(percept):
    return {"move": [1.0, 0, 0, 0] if percept["orientation"][0] > 0.99 else [0, 0.2, 0, 0]}
"""


def run(*args: str | int | Path) -> Result:
    """Run a command in this process, since another one takes a second to start."""
    return CliRunner().invoke(app, [str(each) for each in args])


def refusal(*args: str | int | Path) -> str:
    """Return what a process of its own says of a mistake, on its way out."""
    command = [sys.executable, "-m", "ai4u_edu", *map(str, args)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    return done.stderr


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("record")
    (folder / "mine.py").write_text(SEEK)
    told = run(
        *("record", "box_chase", "--brain", f"{folder / 'mine.py'}:seek"),
        *("--episodes", 2, "--seed", 5, "--out", folder / "kept"),
    )
    assert told.exit_code == 0, told.stderr
    assert "yes" in told.stdout
    return folder / "kept"


def test_record_keeps_each_episode_as_a_file(folder: Path) -> None:
    files = sorted(folder.glob("*.episode"))
    assert [file.name for file in files] == ["box_chase-5.episode", "box_chase-6.episode"]
    episode = Episode.load(files[0])
    assert (episode.seed, episode.success, episode.scene.name) == (5, True, "box_chase")
    assert Replay(episode).verdict.exact


def test_replay_says_that_it_is_exact_and_exports(folder: Path, tmp_path: Path) -> None:
    out = [tmp_path / f"one.{kind}" for kind in ("html", "gif", "csv", "mp4")]
    told = run(
        "replay",
        folder / "box_chase-5.episode",
        *(part for path in out for part in (f"--{path.suffix[1:]}", path)),
    )
    assert told.exit_code == 0, told.stderr
    assert "the replay is exact, bit for bit" in told.stdout
    assert "touch 100" in told.stdout
    assert all(path.stat().st_size > 1000 for path in out)


def test_replay_says_where_it_is_not(folder: Path, tmp_path: Path) -> None:
    episode = Episode.load(folder / "box_chase-5.episode")
    episode.agents[0].percepts[10] ^= 1
    told = run("replay", episode.save(tmp_path / "wrong.episode"))
    assert told.exit_code == 1
    assert "the replay is exact up to 0.85 s and not beyond: agent '0', decision 10: " in (
        told.stdout
    )


def test_a_file_that_is_none(tmp_path: Path) -> None:
    path = tmp_path / "x.episode"
    path.write_text("hello")
    assert refusal("replay", path) == (
        "error: x.episode: expected a recorded episode, as ai4u-edu record writes it, and this is "
        "none\n"
    )


def test_nobody_holds_the_keys(tmp_path: Path) -> None:
    told = refusal("record", "box_chase", "--out", tmp_path)
    assert "agent '0' is driven by keys (WASDRBMoveController)" in told
    assert "ai4u-edu play box_chase --record DIR" in told


def test_dataset_as_arrays(folder: Path, tmp_path: Path) -> None:
    told = run("dataset", folder, "--out", tmp_path / "data.npz")
    assert told.exit_code == 0, told.stderr
    with np.load(tmp_path / "data.npz", allow_pickle=False) as data:
        count = len(data["0/rewards"])
        assert data["0/observations"].shape == (count + 1, 126)
        assert data["0/actions"].shape == (count, 4)
        assert data["0/terminations"].tolist() == [False] * (count - 1) + [True]
        assert "1/actions" in data


def test_a_dataset_of_nothing(tmp_path: Path) -> None:
    told = refusal("dataset", tmp_path, "--out", tmp_path / "data.npz")
    assert f"{tmp_path}: expected recorded episodes (.episode), found none; " in told


CONTROLLER = """
from ai4u_edu import Controller


class Go(Controller):
    def get_action(self, percept):
        return {"move": [1.0, 0, 0, 0] if percept["orientation"][0] > 0.99 else [0, 0.2, 0, 0]}
"""


def test_what_a_controller_of_ones_own_drove_needs_its_file_no_more(tmp_path: Path) -> None:
    file, kept = tmp_path / "mine.py", tmp_path / "kept"
    file.write_text(CONTROLLER)
    told = run("record", "box_chase", "--brain", f"{file}:Go", "--seed", 5, "--out", kept)
    assert told.exit_code == 0, told.stderr
    file.unlink()
    assert run("replay", kept / "box_chase-5.episode").exit_code == 0
    assert run("dataset", kept, "--out", tmp_path / "data.npz").exit_code == 0
    episode = Episode.load(kept / "box_chase-5.episode")
    runner = Runner(Scene.load("soccer").build(), seed=1)
    done = runner.continue_from(Replay(episode), 3)
    runner.advance()
    done.result(0)
    assert [agent.body.name for agent in runner.sim.agents] == ["robot"]


def test_a_recording_that_names_a_driver_nobody_knows_is_cloned(tmp_path: Path) -> None:
    """Recordings of earlier versions did, where a controller of one's own drove."""
    pytest.importorskip("torch")
    sim = Scene.load("box_chase").build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [1, 0, 0, 0]}))
    recorder = Recorder(sim, scene=Scene.load("box_chase").description)
    sim.reset(5)
    for _ in range(9):
        sim.step()
    recorder.finish()
    (episode,) = recorder.episodes
    own = {"type": "LocalBrain", "controller": {"type": "Nobody"}}
    known = {"type": "LocalBrain", "controller": {"type": "WASDRBMoveController"}, "enabled": False}
    network = tmp_path / "policy.onnx"
    for brains in ([own], [known, own]):
        agents = tuple({**agent, "brains": brains} for agent in episode.scene.agents)
        scene = episode.scene.model_copy(update={"agents": agents})
        file = replace(episode, scene=scene).save(tmp_path / "old.episode")
        few = ("--updates", "2", "--evaluate", "1")
        told = CliRunner().invoke(app, ["clone", str(file), "--out", str(network), *few])
        assert told.exit_code == 0, told.output or told.exception
        assert "success" in told.output


def test_play_keeps_what_a_person_drove(tmp_path: Path) -> None:
    with played("box_chase", "--seed", "3", "--record", str(tmp_path / "kept")) as game:
        until(lambda: game.snapshot()["tick"] >= 30)
    (file,) = (tmp_path / "kept").glob("*.episode")
    episode = Episode.load(file)
    assert (episode.seed, episode.changed) == (3, None)
    assert len(episode.agents[0]) >= 5
    assert Replay(episode).verdict.exact


def test_two_servers_that_record_into_one_folder_keep_all_episodes(tmp_path: Path) -> None:
    def record(_number: int) -> None:
        scene = Scene.load("box_chase")
        sim = scene.build()
        recorder = Recorder.into(tmp_path / "kept", sim, scene)
        started.wait()
        for _ in range(5):
            sim.reset(seed=3)
            sim.step()
            recorder.finish()

    started = threading.Barrier(3)
    with ThreadPoolExecutor(3) as pool:
        list(pool.map(record, range(3)))
    names = sorted(path.name for path in (tmp_path / "kept").iterdir())
    numbers = ["", *(f"-{number}" for number in range(2, 16))]
    assert names == sorted(f"box_chase-3{number}.episode" for number in numbers)


def test_an_episode_of_a_scene_with_a_long_name_is_kept(tmp_path: Path) -> None:
    scene = Scene.load("box_chase")
    scene.description = scene.description.model_copy(update={"name": "\u4e00" * 80})
    sim = scene.build()
    recorder = Recorder.into(tmp_path, sim, scene)
    sim.reset(seed=3)
    sim.step()
    recorder.finish()
    assert [path.name for path in tmp_path.iterdir()] == ["\u4e00" * 50 + "-3.episode"]


def test_whoever_plays_against_a_ghost_begins_as_it_did(folder: Path) -> None:
    with played("box_chase", "--ghost", str(folder / "box_chase-6.episode")) as server:
        assert server.snapshot()["seed"] == 6
    told = refusal("play", "--no-open", "--port", 0, "--ghost", folder.parent / "mine.py")
    assert told.startswith("error: mine.py: expected a recorded episode")


@pytest.mark.skipif(os.name != "posix", reason="sends a signal as POSIX has it")
def test_record_says_what_it_waits_for_and_ends_with_ctrl_c(tmp_path: Path) -> None:
    scene = tmp_path / "remote.yaml"
    source = Scene.load("box_chase").dumps()
    head = source[: source.index("    brains:")]
    scene.write_text(f"{head}    brains:\n      - {{type: RemoteBrain, port: {NOWHERE}}}\n")
    process = subprocess.Popen(
        [sys.executable, "-m", "ai4u_edu", "record", str(scene), "--out", str(tmp_path / "kept")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stderr is not None
        told = process.stderr.readline()
        assert told.startswith("agent '0' waits: no AI4U script listens at 127.0.0.1:")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=LIMIT_S)
    finally:
        process.kill()
    assert process.returncode not in (0, -signal.SIGKILL)


def test_who_never_decides_is_not_recorded_for_ever(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(episode_commands, "DEFAULT_MAX_DECISIONS", 50)
    file = tmp_path / "mine.py"
    file.write_text("from ai4u_edu import Command\n\ndef idle(percept):\n    return Command.WAIT\n")
    refused = run("record", "box_chase", "--brain", f"{file}:idle", "--out", tmp_path / "kept")
    assert isinstance(refused.exception, NoDecisionError)
    assert "agent '0' took no decision in 50 ticks" in str(refused.exception)
