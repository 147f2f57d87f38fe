"""The player of recorded episodes, which all pages share."""

from collections.abc import Iterator
from concurrent.futures import Future, wait
from threading import Event, Semaphore

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.recording import Archive, Recorder
from ai4u_edu.runtime import replay_player
from ai4u_edu.runtime.replay_player import RUNNING_EPISODE, ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from tests.waiting import LIMIT_S, until


@pytest.fixture
def runner() -> Iterator[Runner]:
    """A world that stands; one episode of it is kept, and another one is under way."""
    scene = Scene.load("box_chase")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [0.1, 0.3, 0, 0]}))
    recorder = Recorder(sim, scene=scene.description, episodes=Archive())
    runner = Runner(sim, seed=5, recorder=recorder)
    for _ in range(20):
        sim.step()
    sim.reset(6)
    for _ in range(8):
        sim.step()
    runner.paused = True
    runner.start()
    yield runner
    runner.stop(LIMIT_S)


@pytest.fixture
def player(runner: Runner) -> Iterator[ReplayPlayer]:
    player = ReplayPlayer(runner)
    yield player
    player.stop()


def opened(player: ReplayPlayer, number: int) -> None:
    player.open(number)
    until(lambda: player.number == number)
    frame_cache = player.frame_cache
    assert frame_cache is not None
    until(lambda: frame_cache.snapshot(frame_cache.last) is not None)


def test_whoever_chooses_an_episode_does_not_see_it_yet(
    runner: Runner, player: ReplayPlayer
) -> None:
    opened(player, 1)
    assert not player.is_showing
    assert player.step == 0


def test_a_moment_is_shown_and_left(runner: Runner, player: ReplayPlayer) -> None:
    opened(player, 1)
    player.go_to(7)
    until(lambda: runner.latest.past == "episode 1, step 8 of 20")
    assert (runner.latest.seed, runner.latest.tick) == (5, 35)
    player.move(-2)
    until(lambda: runner.latest.past == "episode 1, step 6 of 20")
    player.move(-100)
    until(lambda: runner.latest.past == "episode 1, step 1 of 20")
    player.go_to(99)
    until(lambda: runner.latest.past == "episode 1, the end")
    player.return_to_present().result(LIMIT_S)
    assert (runner.latest.past, runner.latest.seed, runner.latest.tick) == ("", 6, 40)
    assert runner.latest.paused


def test_the_episode_that_is_under_way_can_be_looked_at_from_its_end(
    runner: Runner, player: ReplayPlayer
) -> None:
    opened(player, RUNNING_EPISODE)
    assert player.step == 8
    player.move(-1)
    until(lambda: runner.latest.past == "episode 2, step 8 of 8")
    assert runner.latest.tick == 35


def test_what_is_under_way_is_taken_anew_when_it_has_gone_on(
    runner: Runner, player: ReplayPlayer
) -> None:
    opened(player, RUNNING_EPISODE)
    player.go_to(3)
    until(lambda: runner.latest.past == "episode 2, step 4 of 8")
    player.return_to_present().result(LIMIT_S)

    def go_on() -> None:
        for _ in range(4):
            runner.sim.step()

    runner.submit(go_on).result(LIMIT_S)
    player.move(-1)
    until(lambda: runner.latest.past == "episode 2, step 12 of 12")
    player.return_to_present().result(LIMIT_S)
    player.go_to(10)
    until(lambda: runner.latest.past == "episode 2, step 11 of 12")


def test_it_plays_each_decision_to_the_end_and_stops(
    runner: Runner, player: ReplayPlayer, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[str] = []
    show_past = runner.show_past

    def note_and_show(past: Snapshot | None, *, goes_on: bool = False) -> "Future[None]":
        shown.append("" if past is None else past.past)
        return show_past(past, goes_on=goes_on)

    monkeypatch.setattr(runner, "show_past", note_and_show)
    opened(player, 1)
    player.speed = 20.0
    player.play()
    until(lambda: not player.is_playing and player.step == 20)
    steps = [f"episode 1, step {step} of 20" for step in range(1, 21)]
    assert shown == [*steps, "episode 1, the end"]
    assert runner.latest.past == "episode 1, the end"
    player.play()
    until(lambda: player.step < 20)
    player.play(on=False)
    assert not player.is_playing


def test_playback_goes_on_when_the_world_is_slow_to_show_a_frame(
    runner: Runner, player: ReplayPlayer, monkeypatch: pytest.MonkeyPatch
) -> None:
    waits, goes_on = Semaphore(0), Event()

    def note_and_wait(futures: list[Future[None]], timeout: float) -> object:
        waits.release()
        return wait(futures, timeout)

    monkeypatch.setattr(replay_player, "FRAME_POLL_S", 0.01)
    monkeypatch.setattr(replay_player, "wait", note_and_wait)
    opened(player, 1)
    runner.submit(lambda: goes_on.wait(LIMIT_S))
    player.speed = 20.0
    player.play()
    for _ in range(3):
        assert waits.acquire(timeout=LIMIT_S)
    assert player.is_playing
    goes_on.set()
    until(lambda: player.step == 20 and not player.is_playing)
    assert runner.latest.past == "episode 1, the end"


def test_if_somebody_has_the_world_go_on_it_stops_playing(
    runner: Runner, player: ReplayPlayer
) -> None:
    opened(player, 1)
    player.play()
    until(lambda: runner.latest.past)
    runner.resume().result(LIMIT_S)
    until(lambda: not player.is_playing)
    assert runner.latest.past == ""
    assert not runner.paused


def test_the_world_goes_on_from_a_moment(runner: Runner, player: ReplayPlayer) -> None:
    opened(player, 1)
    player.go_to(4)
    until(lambda: runner.latest.past)
    player.continue_from_here().result(LIMIT_S)
    assert runner.latest.past == ""
    until(lambda: runner.latest.tick > 20)
    assert (runner.latest.seed, runner.sim.world.seeds.seed) == (5, 5)
    assert len(player.archive or ()) == 2  # what was under way is kept as well


def test_what_is_not_there_is_said(runner: Runner, player: ReplayPlayer) -> None:
    with pytest.raises(Exception, match="choose an episode first"):
        player.continue_from_here().result(LIMIT_S)
    player.open(99)
    assert player.problem == "episode 99 is not kept any more"
    runner.reset(7).result(LIMIT_S)
    player.open(RUNNING_EPISODE)
    until(lambda: player.problem == "nothing of it is recorded yet")
