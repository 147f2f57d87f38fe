"""The recorder: contents of an episode, errors, and no cost while it is off."""

import errno
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    BoxShape,
    CircleShape,
    LocalBrain,
    RBMoveActuator,
    Scene,
    World,
)
from ai4u_edu.agent import EVENTS
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.recording import (
    Episode,
    Recorder,
    RecordingError,
    Replay,
)
from ai4u_edu.recording import episode_builder as builder
from ai4u_edu.recording import recorder as recorder_module
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim
from tests.recording.recorded_drives import driver, field_of


def ahead(percept: object) -> dict[str, list[float]]:
    return {"move": [0.1, 0.3, 0, 0]}


def chase() -> tuple[ControlRequestor, Scene]:
    scene = Scene.load("box_chase")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=ahead))
    return sim, scene


def handlers(sim: ControlRequestor) -> int:
    names = (*EVENTS, "percept_ready")
    return sum(len(getattr(agent, name).handlers) for agent in sim.agents for name in names)


def test_a_drive_that_is_over_is_kept_before_the_next_one_begins() -> None:
    sim, scene = chase()
    told: list[Episode] = []
    recorder = Recorder(sim, scene=scene.description, on_episode=told.append)
    sim.reset(1)
    while not sim.agents[0].done:
        sim.step()
    (entry,) = recorder.episodes.entries
    assert (entry.world_episode, len(entry.first)) == (sim.episode, sim.agents[0].steps)
    assert entry.first[len(entry.first) - 1].ended
    assert told == []
    recorder.episodes.pin(entry.number)
    recorder.guard(lambda: sim.world["box"].move_to(3, 3))
    sim.reset(2)
    (kept,) = recorder.episodes.entries  # the same one, as it has become
    assert (kept.number, kept.is_pinned) == (entry.number, True)
    assert kept.episode.changed is not None
    assert [each.seed for each in told] == [1]
    sim.step()
    recorder.finish()
    assert [each.seed for each in recorder.episodes] == [1, 2]


def test_a_game_that_is_over_is_told_once_with_the_end_of_each_player() -> None:
    sim = Scene.load("sumo").build()
    recorder = Recorder(sim)
    games: list[Episode] = []
    recorder.done_listeners.append(games.append)
    sim.reset(0)
    while not all(agent.done for agent in sim.agents):
        sim.agents[0].keyboard.hold(["KeyS"])
        sim.step()
    (game,) = games
    assert [record[len(record) - 1].terminated for record in game.agents] == [True, True]


def test_it_keeps_the_last_ones() -> None:
    sim, _ = chase()
    told: list[Episode] = []
    recorder = Recorder(sim, keep=3, on_episode=told.append)
    for seed in range(6):
        sim.reset(seed)
        for _ in range(seed):
            sim.step()
    recorder.finish()
    assert [(each.seed, len(each.agents[0])) for each in recorder.episodes] == [
        (3, 3),
        (4, 4),
        (5, 5),
    ]
    assert [each.seed for each in told] == [1, 2, 3, 4, 5]  # in the first one, nothing was done


def test_switched_off_it_listens_to_nothing() -> None:
    sim, _ = chase()
    before = handlers(sim)
    recorder = Recorder(sim)
    assert handlers(sim) == before + 4
    sim.reset(1)
    sim.step()
    recorder.set_enabled(False)
    assert handlers(sim) == before
    assert [len(each.agents[0]) for each in recorder.episodes] == [1]
    sim.reset(2)
    sim.step()
    recorder.set_enabled(True)
    sim.step()  # in the middle of an episode: not recorded
    sim.reset(3)
    sim.step()
    recorder.finish()
    assert [each.seed for each in recorder.episodes] == [1, 3]


def test_what_began_but_did_nothing_yet_is_recorded() -> None:
    sim, _ = chase()
    sim.reset(4)
    recorder = Recorder(sim)
    sim.step()
    now = recorder.current_episode()
    assert now is not None
    assert (now.seed, len(now.agents[0])) == (4, 1)
    assert Replay(now).verdict.exact


def test_what_is_under_way_can_be_looked_at() -> None:
    sim, _ = chase()
    recorder = Recorder(sim)
    assert recorder.current_episode() is None
    sim.reset(1)
    percepts = [sim.step() for _ in range(9)]
    now = recorder.current_episode()
    assert now is not None
    assert Replay(now).at(7).percept == percepts[6]


def test_an_episode_that_is_too_long_is_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(builder, "MAX_EPISODE_BYTES", 3000)
    sim = field_of(driver("a", [], skip_frame=1), driver("b", [], skip_frame=4))
    recorder = Recorder(sim)
    sim.reset(1)
    for _ in range(300):
        sim.tick()
    sim.reset(2)
    episode = recorder.episodes[-1]
    assert episode.cut
    assert 10 < len(episode.agents[0]) < 40
    assert Replay(episode).verdict.exact
    sim.step()
    now = recorder.current_episode()
    assert now is not None
    assert not now.cut


def test_a_block_that_no_file_can_hold_stops_no_world() -> None:
    class Marked(RBMoveActuator):
        """With something that is nothing for a file."""

        mark: Any = None

    sim = small_sim(actuators=[Marked(mark=object())])
    recorder = Recorder(sim)
    sim.reset(1)
    sim.step()
    assert recorder.current_episode() is None
    assert recorder.problem.startswith(
        "agent '0': expected a parameter that a file can hold, got <object object"
    )


def test_the_scene_is_the_one_that_was_built() -> None:
    scene = Scene.load("tag")
    sim = scene.build()
    portrait = export_scene(sim, scene.description)
    assert portrait.model_dump(exclude={"agents"}) == scene.description.model_dump(
        exclude={"agents"}
    )
    again = Scene(portrait).build()
    assert [str(agent) for agent in again.agents] == [str(agent) for agent in sim.agents]


def test_a_world_made_by_hand_is_a_scene_too() -> None:
    world = World(ticks_per_second=30)
    world.add_floor("plate", BoxShape(size=(9, 9)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0))
    agent = BasicAgent(
        body="robot",
        sensors=[BearingSensor(target="box")],
        actuators=[RBMoveActuator()],
        brains=[LocalBrain(controller=ahead)],
    )
    sim = ControlRequestor(world, [agent])
    recorder = Recorder(sim)
    sim.reset(3)
    percepts = [sim.step() for _ in range(10)]
    recorder.finish()
    episode = recorder.episodes[-1]
    assert "brains" not in episode.scene.agents[0]  # a function is nothing for a file
    assert Replay(episode).percepts()[0][1:] == percepts


# -- a disk that is full --------------------------------------------------------------------------


def test_a_full_disk_stops_no_world_and_refuses_no_reset(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    sim, scene = chase()
    recorder = Recorder.into(tmp_path, sim, scene)
    runner = Runner(sim, seed=1, recorder=recorder)

    def full(path: Path, *_: Any, **__: Any) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    def drive_and_reset(seed: int) -> None:
        sim.step()
        asked = runner.reset(seed)
        runner.advance()
        asked.result(0)

    monkeypatch.setattr(recorder_module, "write_atomically", full)
    for seed in (2, 3, 4):
        drive_and_reset(seed)
        assert "No space left on device" in recorder.save_problem
    assert runner.error == ""
    assert [each.seed for each in recorder.episodes] == [1, 2, 3]
    assert list(tmp_path.iterdir()) == []
    monkeypatch.undo()
    drive_and_reset(5)
    assert recorder.save_problem == ""
    assert [file.name for file in tmp_path.iterdir()] == ["box_chase-4.episode"]
    runner.stop()
    (told,) = [record.getMessage() for record in caplog.records]  # not with every episode
    assert told.startswith("the last episode could not be saved: OSError")


def test_a_folder_that_was_removed_is_made_anew(tmp_path: Path) -> None:
    sim, scene = chase()
    recorder = Recorder.into(tmp_path / "kept", sim, scene)
    (tmp_path / "kept").rmdir()
    sim.reset(1)
    sim.step()
    recorder.finish()
    assert (tmp_path / "kept" / "box_chase-1.episode").is_file()


def test_a_folder_that_can_not_be_made_is_told(tmp_path: Path) -> None:
    sim, scene = chase()
    (tmp_path / "file").touch()
    with pytest.raises(SetupError, match="expected a folder for recorded episodes"):
        Recorder.into(tmp_path / "file" / "kept", sim, scene)


# -- changed by hand ---------------------------------------------------------------------------


def moved(sim: ControlRequestor) -> None:
    sim.world["box"].move_to(2, 2)


def removed(sim: ControlRequestor) -> None:
    sim.world.remove("pebble")


def added(sim: ControlRequestor) -> None:
    sim.world.add_body("wall", BoxShape(size=(0.2, 1)), position=(4, 4), kind="static")


def other_blocks(sim: ControlRequestor) -> None:
    sim.agents[0].sensors.append(BearingSensor(target="box"))
    sim.agents[0].setup(sim.world)


@pytest.mark.parametrize("change", [moved, removed, added, other_blocks])
def test_what_a_person_changes_is_noticed(change: Callable[[ControlRequestor], None]) -> None:
    sim, _ = chase()
    sim.world.add_body("pebble", CircleShape(radius=0.1), position=(-4, -4))
    recorder = Recorder(sim)
    sim.reset(1)
    percepts = [sim.step() for _ in range(10)]
    recorder.guard(lambda: change(sim))
    for _ in range(5):
        sim.step()
    recorder.finish()
    episode = recorder.episodes[-1]
    assert episode.changed == 50
    replay = Replay(episode)
    assert (replay.verdict.exact, replay.verdict.exact_until) == (False, 50)
    assert replay.verdict.why == "the world was changed by hand there"
    assert replay.at(9).percept == percepts[8]
    assert len(list(replay.moments())) == 10
    with pytest.raises(RecordingError, match=r"exactly up to 0\.83 s \(tick 50\) and not beyond"):
        replay.at(10)


@pytest.mark.parametrize(
    "harmless",
    [
        lambda sim: None,
        lambda sim: sim.agents[0].use_brain(LocalBrain(controller=ahead, skip_frame=1)),
        lambda sim: sim.restart(sim.agents[0]),
        lambda sim: sim.tick(),
    ],
)
def test_what_changes_nothing_or_is_recorded_leaves_it_exact(harmless: Any) -> None:
    sim, _ = chase()
    recorder = Recorder(sim)
    sim.reset(1)
    for _ in range(10):
        sim.step()
    recorder.guard(lambda: harmless(sim))
    for _ in range(10):
        sim.step()
    recorder.finish()
    assert recorder.episodes[-1].changed is None
    assert Replay(recorder.episodes[-1]).verdict.exact


def test_under_a_runner() -> None:
    sim, scene = chase()
    recorder = Recorder(sim, scene=scene.description)
    runner = Runner(sim, seed=5, time_scale=float("inf"), recorder=recorder)

    def wait(ticks: int) -> None:
        for _ in range(ticks):
            runner.advance()

    def ask(command: Callable[[], Any]) -> None:
        future = runner.submit(command)
        while not future.done():
            runner.advance()
        future.result()

    wait(60)
    ask(lambda: runner.sim.reset(6))
    wait(60)
    ask(lambda: moved(sim))
    wait(60)
    ask(lambda: sim.reset(7))
    wait(20)
    runner.stop()
    first, second, third = recorder.episodes
    assert [each.seed for each in recorder.episodes] == [5, 6, 7]
    assert (first.changed, third.changed) == (None, None)
    assert second.changed is not None
    assert second.changed >= 60
    assert Replay(first).verdict.exact
    assert Replay(third).verdict.exact
