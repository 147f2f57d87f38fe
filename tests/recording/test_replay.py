"""Replays reproduce a recording byte for byte."""

import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu import ControlRequestor, LocalBrain, Percept, ReplayController, Scene
from ai4u_edu.blocks import Layout
from ai4u_edu.envs import SceneEnv
from ai4u_edu.recording import Episode, Recorder, RecordingError, Replay, ghost_of
from ai4u_edu.recording.checksum import percept_checksum
from ai4u_edu.recording.episode import decode, encode
from ai4u_edu.recording.player import Player
from tests.recording.recorded_drives import (
    GO,
    HOLD,
    LEFT,
    RESPAWN,
    WAIT,
    Note,
    Notes,
    driver,
    field_of,
    take,
)
from tests.recording.replay_digest import digest
from tests.scenes.few import SCENES

pytestmark = pytest.mark.slow


def check(episode: Episode, notes: dict[str, list[Note]]) -> None:
    """Every moment of every agent is as it was noted, bytes and all."""
    replay = Replay(decode(Episode, encode(episode), "x.episode"))
    assert replay.verdict.exact, replay.verdict.why
    for agent, noted in notes.items():
        # a decision that had not ended when the recording did is left out
        moments = list(replay.moments(agent))
        assert len(noted) - 1 <= len(moments) <= len(noted)
        for moment, note in zip(moments, noted, strict=False):
            assert moment.percept.data == note.percept
            assert moment.percept.texts == note.texts
            assert moment.snapshot.bodies == note.poses
            assert moment.snapshot.tick == note.tick
            assert moment.decision.action == note.action
            if moment.decision.ended:
                assert moment.decision.reward_terms == note.terms


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_plays_again_byte_for_byte(name: str) -> None:
    taken = take(name)
    assert len(taken.episode.agents[0]) > 10
    check(taken.episode, taken.notes)


@pytest.mark.parametrize("name", ["box_chase", "tag"])
def test_another_process_agrees(name: str, tmp_path: Path) -> None:
    episode = take(name).episode
    file = episode.save(tmp_path / "one.episode")
    there = subprocess.run(
        [sys.executable, "-m", "tests.recording.replay_digest", str(file)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert there.stdout.strip() == digest(episode)


def recorded(sim: ControlRequestor, ticks: int) -> tuple[Episode, dict[str, list[Note]]]:
    recorder, notes = Recorder(sim), Notes(sim)
    sim.reset(3)
    for _ in range(ticks):
        sim.tick()
    recorder.finish()
    return recorder.episodes[-1], notes.of


def test_agents_that_wait_hold_and_begin_anew() -> None:
    sim = field_of(
        driver("a", [GO, WAIT, WAIT, LEFT, RESPAWN, GO, HOLD, HOLD, GO], max_steps_per_episode=4),
        driver("b", [LEFT, RESPAWN, GO, HOLD, RESPAWN, GO, GO, RESPAWN], skip_frame=1),
        driver("c", [GO] * 3 + [RESPAWN, HOLD, LEFT], skip_frame=4),
    )
    episode, notes = recorded(sim, 60)
    assert len(episode.restarts) >= 4
    check(episode, notes)


def test_who_begins_anew_while_the_world_is_held() -> None:
    sim = field_of(
        driver("a", [HOLD, GO, GO, HOLD, GO]),
        driver("b", [RESPAWN, LEFT, LEFT, RESPAWN]),
        driver("c", [LEFT, GO, GO, GO]),
    )
    episode, notes = recorded(sim, 30)
    # c had decided already, and a and b did so after the restart, all of it at the first tick
    assert episode.order[:4].tolist() == [2, -1, 0, 1]
    assert [restart.tick for restart in episode.restarts] == [0, 6]
    check(episode, notes)


def test_who_is_restarted_by_hand_in_the_middle_of_a_decision() -> None:
    sim = field_of(driver("a", [], skip_frame=6), driver("b", [], skip_frame=9))
    recorder, notes = Recorder(sim), Notes(sim)
    sim.reset(4)
    for tick in range(50):
        sim.tick()
        if tick == 10:
            sim.restart(sim.agent("a"))
        if tick in (15, 30):
            sim.restart(sim.agent("b"), sim.agent("a"))
        if tick == 40:
            sim.restart(sim.agent("b"))
            sim.restart(sim.agent("a"))
    recorder.finish()
    episode = recorder.episodes[-1]
    assert [each.agents for each in episode.restarts] == [(0,), (1, 0), (1, 0), (1,), (0,)]
    assert not all(decision.ended for decision in episode.agent("a"))
    check(episode, notes.of)


def test_one_agent_alone_that_is_restarted_in_the_middle_of_a_decision() -> None:
    sim = field_of(driver("a", [], skip_frame=6))
    recorder, notes = Recorder(sim), Notes(sim)
    sim.reset(4)
    for tick in range(40):
        sim.tick()
        if tick == 10:
            sim.restart(sim.agents[0])
    recorder.finish()
    check(recorder.episodes[-1], notes.of)


def test_brains_that_are_swapped_while_it_goes_on() -> None:
    scene = Scene.load("box_chase")
    sim = scene.build()
    recorder, notes = Recorder(sim, scene=scene.description), Notes(sim)
    sim.reset(2)
    for skip, repeat in ((4, True), (9, False), (0, True)):
        sim.agents[0].use_brain(
            LocalBrain(controller=lambda percept: LEFT, skip_frame=skip, repeat_action=repeat)
        )
        for _ in range(5):
            sim.step()
    recorder.finish()
    assert set(recorder.episodes[-1].agents[0].skip.tolist()) == {4, 9, 0}
    check(recorder.episodes[-1], notes.of)


def test_an_environment_is_recorded_as_well() -> None:
    env = SceneEnv("box_chase")
    recorder, notes = Recorder(env.sim, scene=env.scene.description), Notes(env.sim)
    env.reset(seed=8)
    env.action_space.seed(8)
    for _ in range(30):
        env.step(env.action_space.sample())
    env.reset()
    check(recorder.episodes[-1], {"0": notes.of["0"][:30]})


def test_scrubbing_back_and_forth() -> None:
    taken = take("box_chase", decisions=60)
    replay = Replay(taken.episode)
    for step in (50, 12, 11, 10, 40, 0, 39, -1):
        moment = replay.at(step)
        note = taken.notes["0"][step]
        assert (moment.percept.data, moment.snapshot.bodies) == (note.percept, note.poses)
        assert moment.decision.action == note.action
    with pytest.raises(
        RecordingError, match="agent '0' took 60 decisions; expected a step from 0 to 59, got 60"
    ):
        replay.at(60)


def test_going_back_step_by_step_does_not_begin_anew_each_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    replay = Replay(take("box_chase", decisions=60).episode)
    replay.at(-1)
    count = 0
    rewind = Player.rewind

    def counted(player: Player) -> None:
        nonlocal count
        count += 1
        rewind(player)

    monkeypatch.setattr(Player, "rewind", counted)
    for step in reversed(range(59)):
        replay.at(step)
    assert count == 1


def circling(percept: object) -> dict[str, list[float]]:
    return {"move": [0.3, 1, 0, 0]}


def two_futures(step: int, **options: object) -> tuple[list[bytes], list[bytes]]:
    scene = Scene.load("box_chase")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=circling))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(6)
    there = [sim.step().data for _ in range(40)]
    recorder.finish()
    recorder.set_enabled(False)
    replay = Replay(recorder.episodes[-1])
    into = sim if options.get("same") else None
    brains = None if options.get("same") else {"0": LocalBrain(controller=circling)}
    other = replay.continue_from(step, brains=brains, sim=into)
    here = [other.agents[0].percept.data] + [other.step().data for _ in range(40 - step)]
    return there[step - 1 :], here


def test_who_goes_on_from_there_with_the_same_brain_gets_the_same_future() -> None:
    there, here = two_futures(17)
    assert here == there


def test_a_world_that_is_there_already_is_brought_to_that_moment() -> None:
    there, here = two_futures(17, same=True)
    assert here == there


def test_the_brain_that_was_there_begins_anew() -> None:
    sim = Scene.load("box_chase").build()
    turns = [{"move": [0.0, turn, 0.0, 0.0]} for turn in (1.0, -0.5, 0.25)]
    brain = LocalBrain(controller=ReplayController(actions=turns, ending="repeat"))
    sim.agents[0].use_brain(brain)
    recorder = Recorder(sim)
    sim.reset(6)
    for _ in range(8):
        sim.step()
    recorder.finish()
    Replay(recorder.episodes[-1]).continue_from(5, sim=sim)
    assert sim.agents[0].brain is brain
    for action in turns:
        sim.step()
        assert list(sim.agents[0].last_action["move"]) == action["move"]


def test_who_goes_on_with_another_brain_gets_another_one() -> None:
    episode = take("box_chase", decisions=30).episode
    sim = Replay(episode).continue_from(10, brains={"0": LocalBrain(controller=circling)})
    assert sim.world.ticks == 50
    before = sim.agents[0].percept.data
    assert before == Replay(episode).at(10).percept.data
    sim.step()
    assert sim.agents[0].percept.data != Replay(episode).at(11).percept.data
    assert sim.agents[0].steps == 11


def test_others_go_on_with_the_brains_of_the_scene() -> None:
    scene = Scene.load("tag")
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(1)
    for _ in range(20):
        sim.step()
    recorder.finish()
    on = Replay(recorder.episodes[-1]).continue_from(7)
    assert [agent.brain.title() for agent in on.agents] == [
        agent.brain.title() for agent in sim.agents
    ]
    for _ in range(5):
        on.step()


def test_what_can_not_go_on() -> None:
    sim = field_of(driver("a", []))
    episode, _ = recorded(sim, 30)
    replay = Replay(episode)
    with pytest.raises(RecordingError, match="agent 'a' was driven by what no file can hold"):
        replay.continue_from(3)
    with pytest.raises(RecordingError, match="brains: no agent has the id 'b'"):
        replay.continue_from(3, brains={"b": LocalBrain(controller=circling)})
    with pytest.raises(RecordingError, match="the episode was recorded in another world"):
        replay.continue_from(3, sim=Scene.load("box_chase").build())


def test_what_was_paid_by_a_script_of_ones_own_does_not_play_again_and_that_is_told() -> None:
    sim = field_of(driver("a", []))
    agent = sim.agents[0]
    agent.end_of_step.connect(lambda agent: agent.add_reward(1.0) if agent.steps == 5 else None)
    episode, notes = recorded(sim, 40)
    replay = Replay(episode)
    assert not replay.verdict.exact
    assert replay.verdict.why == (
        "agent 'a', decision 5: reward term 'handlers': paid 1.0 then, and nothing now"
    )
    assert replay.at(5).percept.data == notes["a"][5].percept  # up to there it is exact
    with pytest.raises(RecordingError, match=r"exactly up to 0\.27 s \(tick 16\) and not beyond"):
        replay.at(6)


def test_a_world_that_was_changed_without_telling_is_noticed() -> None:
    sim = field_of(driver("a", []))
    recorder = Recorder(sim)
    sim.reset(0)
    for step in range(20):
        if step == 8:
            sim.world["ball"].move_to(5, 5)  # far from all that the agent senses
        sim.step()
    recorder.finish()
    verdict = Replay(recorder.episodes[-1]).verdict
    assert (verdict.exact, verdict.exact_until) == (False, 24)
    assert (
        verdict.why == "agent 'a', decision 8: the bodies were in other places, or moved otherwise"
    )


def test_a_ghost_has_the_poses_of_the_run() -> None:
    taken = take("box_chase", decisions=40)
    ghost = ghost_of(taken.episode)
    assert ghost.names == ("robot", "box")
    assert ghost.poses.shape == (len(ghost.times), 2, 4)
    for note in taken.notes["0"][::2]:
        pose = ghost.at(note.tick / 60 + 1e-4)["robot"]
        (robot,) = [each for each in note.poses if each.name == "robot"]
        assert pose[:2] == pytest.approx((robot.x, robot.y), abs=1e-5)
    end = ghost.at(1e6)
    assert set(end) <= {"robot", "box"}


def test_texts_count() -> None:
    layout = Layout([], ["one", "other"])
    assert percept_checksum(Percept(layout, b"", ("ab", "c"))) != percept_checksum(
        Percept(layout, b"", ("a", "bc"))
    )
