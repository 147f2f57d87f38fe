"""Races: everybody at the same start, results with the recorded episode, and normal life after."""

import math
from pathlib import Path
from typing import Literal

from ai4u_edu import Scene
from ai4u_edu.member.member import MIN_RESULT_INTERVAL_S
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.recording.episode import decode, encode
from ai4u_edu.wire.class_link import Applied, CurrentRace, EpisodeResult, RaceRow, State
from tests.member.fake_link import Joined, joined
from tests.waiting import LIMIT_S, until

Phase = Literal["countdown", "running", "over"]


def race(phase: Phase, starts_in: float = 0.0, name: str = "r1", **more: object) -> CurrentRace:
    return CurrentRace(name, phase, starts_in, "box_chase", 11, more.pop("board", ()), **more)  # type: ignore[arg-type]


def started(room: Joined) -> None:
    """Run a race's countdown."""
    room.tell(race("countdown", 3.0))
    until(lambda: room.runner.latest.is_seed_locked and room.runner.latest.seed == 11)
    room.clock.now += 3
    until(lambda: room.runner.latest.tick > 0)


def drive_to_the_box(room: Joined) -> None:
    """Have the agent look for the box by itself, as fast as the world can run."""

    def chase() -> None:
        sim = room.runner.sim
        robot, box = sim.agents[0], sim.world["box"]

        def steer(_percept: object) -> dict[str, list[float]]:
            x, y = robot.body.position
            a, b = box.position
            turn = math.remainder(robot.body.heading - math.atan2(b - y, a - x), math.tau)
            return {"move": [0.5, max(-1.0, min(1.0, turn)), 0, 0]}

        robot.use_brain(steer)
        room.runner.set_time_scale(math.inf)

    room.runner.submit(chase).result(LIMIT_S)


def own_best(room: Joined) -> float | None:
    event = room.member.view.event("student", 0)
    assert event is not None
    return None if event["race"] is None else event["race"]["own_best"]


def test_a_race_from_the_countdown_to_the_end(tmp_path: Path) -> None:
    with joined("maze", tmp_path, wait_for_key=True) as room:
        room.tell(race("countdown", 3.0))
        until(lambda: room.runner.latest.waiting == "teacher")
        until(lambda: room.editor.state.description.name == "box_chase")
        until(lambda: room.runner.latest.is_seed_locked)
        assert (room.runner.latest.seed, room.runner.latest.tick) == (11, 0)
        # the page is told of the race after the world is ready
        until(lambda: (room.member.view.event("student", 0) or {}).get("race"))
        event = room.member.view.event("student", 0)
        assert event is not None
        assert (event["race"]["phase"], event["race"]["starts_in"]) == ("countdown", 3.0)
        room.clock.now += 3
        until(lambda: room.runner.latest.tick > 0)  # without a key: all start at once

        drive_to_the_box(room)
        result = room.episode_result()
        assert (result.outcome, result.race, result.seed) == ("goal", "r1", 11)
        episode = decode(Episode, result.episode, "race")
        assert Replay(episode).verdict.exact
        assert abs(episode.seconds - result.seconds) < 1e-6
        assert own_best(room) == round(result.seconds, 2)

        # another try: the same start again, also with a key that draws another one
        room.runner.new_start()
        until(lambda: room.runner.latest.seed == 11 and len(room.link.of(EpisodeResult)) > 1)
        assert room.episode_result(1).race == "r1"
        assert own_best(room) == round(min(result.seconds, room.episode_result(1).seconds), 2)

        row = RaceRow("Red Fox", "#d55e00", "goal", 1.5, "x")
        best = (result.episode, room.episode_result(1).episode)
        room.tell(race("running", board=(row,), ghosts=best))
        until(lambda: room.ghosts)
        ghosts = [(encode(ghost), name) for ghost, name in room.ghosts[-1]]
        assert ghosts == [(best[0], "Red Fox"), (best[1], "place 2")]

        room.tell(race("over", board=(row,)))
        until(lambda: not room.runner.latest.is_seed_locked)
        until(lambda: not room.ghosts[-1])
        assert own_best(room) == round(min(result.seconds, room.episode_result(1).seconds), 2)
        room.tell(CurrentRace("", "over", 0.0, "", 0, ()))
        until(lambda: (room.member.view.event("student", 0) or {})["race"] is None)


def test_what_counts_in_a_race_is_an_untouched_episode_of_its_scene_and_seed() -> None:
    with joined() as room:
        started(room)

        def fall() -> EpisodeResult:
            count = len(room.link.of(EpisodeResult))
            room.clock.now += MIN_RESULT_INTERVAL_S
            agent = room.runner.sim.agents[0]
            room.runner.submit(lambda: agent.add_reward(0.0, request_done=True)).result(LIMIT_S)
            return room.episode_result(count)

        assert fall().race == "r1"
        assert own_best(room) is None  # it did not reach the goal
        room.runner.reset().result(LIMIT_S)
        robot = room.runner.sim.agents[0].body
        room.runner.submit(lambda: robot.move_to(0.0, 2.0)).result(LIMIT_S)  # moved by hand
        assert fall().race == ""
        room.editor.change_body("box", {"position": [0.0, 4.0]}).result(LIMIT_S)
        room.runner.reset().result(LIMIT_S)
        assert fall().race == ""
        room.editor.open(Scene.load("maze")).result(LIMIT_S)
        room.state(scene=Scene.load("maze").description.title, episodes=1)
        until(lambda: room.runner.latest.tick > 0)
        assert fall().race == ""


def press(room: Joined) -> None:
    """Press a driving key, as a page does."""
    room.runner.start_episode()


def test_a_student_who_comes_late_starts_when_the_key_is_pressed() -> None:
    with joined("maze", wait_for_key=True) as room:
        room.tell(race("running"))
        room.poll()
        until(lambda: room.runner.latest.waiting == "key" and room.runner.latest.seed == 11)
        room.poll()
        assert room.runner.latest.tick == 0
        assert room.runner.latest.is_seed_locked
        press(room)
        drive_to_the_box(room)
        assert room.episode_result().race == "r1"


def test_after_a_restart_nobodys_clock_runs_and_nothing_is_forgotten(tmp_path: Path) -> None:
    with joined("maze", tmp_path, wait_for_key=True) as room:
        started(room)
        drive_to_the_box(room)
        assert room.episode_result().race == "r1"
        room.state(is_solved=True)
    with joined("box_chase", tmp_path, wait_for_key=True) as room:
        room.tell(race("running", own_best=1.25))
        until(lambda: room.member.view.version > 0)
        assert own_best(room) == 1.25
        room.poll()
        assert (room.runner.latest.waiting, room.runner.latest.tick) == ("key", 0)
        assert (room.runner.latest.seed, room.runner.latest.is_seed_locked) == (11, True)
        assert all(each.is_solved for each in room.link.of(State))
        press(room)
        drive_to_the_box(room)
        assert room.episode_result().race == "r1"
    with joined("parking", tmp_path, wait_for_key=True) as room:  # it has left the race's scene
        room.tell(race("running"))
        until(lambda: (room.member.view.event("student", 0) or {}).get("race"))
        room.poll()
        assert room.editor.state.description.name == "parking"
        assert not room.runner.latest.is_seed_locked


def test_a_race_that_can_not_be_opened_is_answered() -> None:
    with joined() as room:
        room.tell(CurrentRace("r9", "countdown", 60.0, "no_such_scene", 1, ()))
        assert "no scene" in room.next(Applied).problem
        until(lambda: room.runner.latest.waiting != "teacher")
        assert not room.runner.latest.is_seed_locked


def test_a_ghost_that_can_not_be_read_stops_nothing() -> None:
    with joined() as room:
        room.tell(race("running", ghosts=(b"no episode",)))
        until(lambda: room.runner.latest.seed == 11 and room.runner.latest.is_seed_locked)
        room.tell(CurrentRace("", "over", 0.0, "", 0, ()))
        until(lambda: not room.runner.latest.is_seed_locked)
        assert not any(room.ghosts)
