"""States and results of a room are what happened there."""

import math
from pathlib import Path

import pytest

from ai4u_edu import Scene
from ai4u_edu.member.room_state import DRIVING_S, IDLE_S, RoomState
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from ai4u_edu.wire.class_link import HEARTBEAT_S, Drawing, EpisodeResult, Poses, State, Work
from tests.member.fake_link import Clock, Joined, joined
from tests.waiting import LIMIT_S, until


def drive_off(room: Joined) -> None:
    """Put the first agent over the void, once the member watches its episode."""
    room.poll()
    room.runner.submit(lambda: room.runner.sim.agents[0].body.move_to(40.0, 0.0)).result(LIMIT_S)


def test_falls_restarts_and_goals_are_counted_and_told() -> None:
    with joined() as room:
        first = room.state(status="idle", driver="A person", scene=room.editor.title)
        assert (first.episodes, first.falls, first.is_solved, first.error) == (1, 0, False, "")
        drive_off(room)
        room.state(status="fell", falls=1, episodes=1)
        result = room.episode_result()
        assert (result.outcome, result.seed, result.race, result.episode) == ("fell", 1, "", b"")
        assert result.seconds > 0
        room.clock.now += 1
        room.runner.reset(5)
        room.state(status="driving", episodes=2, falls=1)
        robot = room.runner.sim.agents[0]
        room.runner.submit(lambda: robot.add_reward(0.0, request_done=True)).result(LIMIT_S)
        assert (room.episode_result(1).outcome, room.episode_result(1).seed) == ("over", 5)


def reach_the_goal(room: Joined) -> None:
    def touch() -> None:
        sim = room.runner.sim
        sim.agents[0].body.move_to(*sim.world["box"].position)

    room.runner.submit(touch).result(LIMIT_S)


def test_counts_of_a_scene_outlast_the_process_of_the_room(tmp_path: Path) -> None:
    with joined(folder=tmp_path) as room:
        drive_off(room)
        room.state(falls=1)
        room.clock.now += 1
        room.runner.reset(5)
        room.state(episodes=2)
        reach_the_goal(room)
        room.state(is_solved=True)
    with joined(folder=tmp_path) as room:
        room.state(episodes=3)
        assert {(each.falls, each.is_solved) for each in room.link.of(State)} == {(1, True)}
        room.editor.open(Scene.load("box_chase")).result(LIMIT_S)  # the same one, but again
        room.state(episodes=1, falls=0, is_solved=False)
    with joined("parking", tmp_path) as room:
        first = room.next(State)
        assert (first.episodes, first.falls, first.is_solved) == (1, 0, False)


def test_another_scene_is_counted_anew_and_its_text_sent() -> None:
    with joined() as room:
        drive_off(room)
        room.state(falls=1)
        assert "name: box_chase" in room.next(Work).scene
        room.editor.open(Scene.load("parking")).result(LIMIT_S)
        room.state(scene=Scene.load("parking").description.title, falls=0, episodes=1)
        room.clock.now += 2
        assert "name: parking" in room.next(Work, lambda work: work.title != "Box chase").scene
        until(lambda: len(room.link.of(Drawing)) == 2)


def test_a_world_that_waits_and_one_with_an_error() -> None:
    with joined(wait_for_key=True) as room:
        room.state(status="waiting")
        room.runner.pause()
        room.state(status="paused")

        def fail(_percept: object) -> dict[str, float]:
            raise ValueError("a student's mistake")

        agent = room.runner.sim.agents[0]
        room.runner.submit(lambda: agent.use_brain(fail)).result(LIMIT_S)
        room.runner.resume()
        room.runner.start_episode()
        state = room.state(status="error")
        assert "a student's mistake" in state.error


def test_a_resting_world_sends_only_its_heartbeat() -> None:
    with joined(wait_for_key=True) as room:
        room.state(status="waiting")
        room.next(Poses)
        until(lambda: room.link.of(Work))
        room.poll()
        count = len(room.link.sent)
        seen = room.runner.latest
        until(lambda: room.runner.latest is not seen)
        room.poll()
        assert len(room.link.sent) == count
        room.clock.now += HEARTBEAT_S
        room.poll()
        assert [type(each) for each in room.link.sent[count:]] == [State]


def test_nothing_is_drawn_without_a_link() -> None:
    with joined() as room:
        room.next(Poses)
        room.link.is_connected = False
        states = len(room.link.of(State))
        room.clock.now += HEARTBEAT_S
        until(lambda: len(room.link.of(State)) > states)
        drawn = len(room.link.of(Poses))
        room.runner.submit(lambda: room.runner.sim.agents[0].body.move_to(1.0, 1.0)).result(LIMIT_S)
        room.clock.now += HEARTBEAT_S
        until(lambda: len(room.link.of(State)) > states + 1)
        room.poll()
        assert len(room.link.of(Poses)) == drawn
        room.link.is_connected = True
        until(lambda: len(room.link.of(Poses)) > drawn)


def test_results_of_a_fast_network_are_limited_but_all_are_counted() -> None:
    with joined(time_scale=math.inf) as room:
        room.poll()  # it watches episodes from now on; the first one may be over already

        def fall() -> None:  # at once: the next episode is soon over otherwise, too
            room.runner.sim.reset()
            room.runner.sim.agents[0].body.move_to(40.0, 0.0)

        for falls in range(1, 5):
            room.runner.submit(fall).result(LIMIT_S)
            room.state(falls=falls)
        room.poll()
        assert len(room.link.of(EpisodeResult)) == 1


class Watched:
    """A state that is read from snapshots of a scene that no thread runs."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.sim = Scene.load("box_chase").build()
        self.sim.reset(1)
        self.state = RoomState(self.clock)
        self.state.note_scene(self)

    def read(self, version: int = 0, **changes: object) -> State:
        picture: Snapshot = capture_snapshot(self.sim, **changes)  # type: ignore[arg-type]
        return self.state.read(picture, self.sim, title="A scene", version=version, begun=1)


def test_who_neither_drives_nor_edits_is_soon_idle() -> None:
    room = Watched()
    assert room.read().status == "idle"  # nobody has done anything since the process began
    assert room.read(version=1).status == "driving"
    room.clock.now += DRIVING_S - 1
    assert room.read(version=1).status == "driving"
    room.clock.now += 1
    assert room.read(version=1).status == "idle"
    room.sim.agents[0].keyboard.timeout_s = math.inf
    room.sim.agents[0].keyboard.hold({"KeyW"})
    assert room.read(version=1).status == "driving"


def test_a_world_that_waits_is_idle_after_a_minute() -> None:
    room = Watched()
    room.read()
    assert room.read(version=1, waiting="key").status == "waiting"
    room.clock.now += IDLE_S - 1
    assert room.read(version=1, waiting="key").status == "waiting"
    room.clock.now += 1
    assert room.read(version=1, waiting="key").status == "idle"


@pytest.mark.parametrize("paused", [True, False])
def test_time_in_which_the_teacher_stops_the_world_does_not_count(paused: bool) -> None:
    room = Watched()
    for _ in range(3):
        room.clock.now += IDLE_S
        assert room.read(waiting="teacher", paused=paused).status == "paused"
    room.clock.now += 1
    assert room.read().status == "driving"
