"""SpeakActuator and HearSensor: who hears what, and when."""

from collections.abc import Sequence
from typing import Any

import pytest

from ai4u_edu import (
    Actuator,
    BasicAgent,
    CallController,
    CircleShape,
    ControlRequestor,
    HearSensor,
    LocalBrain,
    Scene,
    SpeakActuator,
    World,
)
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.snapshot.theme import said
from tests.scenes.solvers import solver_of


def robots(
    *places: Sequence[float], size: int = 1, voices: int = 1, skip_frame: int = 4, **fields: Any
) -> tuple[ControlRequestor, dict[str, list[float]]]:
    """Robots at places on a line; each says what is in the dict under its name, if anything."""
    world, agents = World(), []
    words: dict[str, list[float]] = {}
    for index, place in enumerate(places):
        name = "abcd"[index]
        world.add_body(name, CircleShape(radius=0.3), position=(place[0], place[1]))
        actuators: list[Actuator] = [SpeakActuator(size=size, **fields)]

        def answer(_: object, name: str = name) -> dict[str, list[float]]:
            return {"speak": words[name]} if name in words else {}

        agents.append(
            BasicAgent(
                id=name,
                body=name,
                sensors=[HearSensor(size=size, voices=voices)],
                actuators=actuators,
                brains=[LocalBrain(controller=answer, skip_frame=skip_frame)],
            )
        )
    sim = ControlRequestor(world, agents)
    sim.reset(1)
    return sim, words


def heard(sim: ControlRequestor, name: str) -> list[float]:
    return [round(float(number), 3) for number in sim.agent(name).percept["hear"]]


@pytest.mark.parametrize(("speaker", "listener"), [("a", "b"), ("b", "a")])
def test_it_is_heard_in_the_next_percept_whoever_acts_first(speaker: str, listener: str) -> None:
    sim, words = robots((0, 0), (2, 0))
    words[speaker] = [1, 0.5]
    sim.step()
    assert heard(sim, listener) == [1, 0.5]
    assert heard(sim, speaker) == [0, 0]
    del words[speaker]
    sim.step()
    assert heard(sim, listener) == [0, 0]


def test_it_is_heard_once_at_another_pace_too() -> None:
    sim, words = robots((0, 0), (2, 0))
    sim.agent("b").use_brain(LocalBrain(controller=lambda _: {}, skip_frame=0))
    sim.agent("a").brain.repeat_action = False
    words["a"] = [1, 0.5]
    read = []
    for _ in range(5):
        sim.tick()
        read.append(heard(sim, "b")[0])
    assert read == [1, 0, 0, 0, 0]


def test_silence_below_a_half_and_out_of_reach() -> None:
    sim, words = robots((0, 0), (2, 0), (9, 0), reach=5)
    words["a"] = [0.5, 1]
    sim.step()
    assert heard(sim, "b") == [0, 0]
    words["a"] = [1, 1]
    sim.step()
    assert (heard(sim, "b"), heard(sim, "c")) == ([1, 1], [0, 0])
    sim.world["a"].leave()
    sim.step(sim.agent("b"))
    assert heard(sim, "b") == [0, 0]


def test_the_nearest_voices_come_first() -> None:
    sim, words = robots((0, 0), (4, 0), (2, 0), (9, 0), voices=2, reach=20)
    words.update(b=[1, 0.2], c=[1, 0.3], d=[1, 0.4])
    sim.step()
    assert heard(sim, "a") == [1, 0.3, 1, 0.2]
    del words["c"]
    sim.step()
    assert heard(sim, "a") == [1, 0.2, 1, 0.4]
    del words["d"]
    sim.step()
    assert heard(sim, "a") == [1, 0.2, 0, 0]
    assert HearSensor(voices=2).slots() == ("heard (1)", "number (1)", "heard (2)", "number (2)")


def test_other_counts_of_numbers() -> None:
    sim, words = robots((0, 0), (2, 0), size=2)
    sim.agent("a").sensors[0] = HearSensor(size=1)
    sim.agent("a").setup(sim.world)
    sim.reset(1)
    words["b"] = [1, 0.2, 0.3]
    sim.step()
    assert heard(sim, "a") == [1, 0.2]
    call, words = robots((0, 0), (2, 0), size=0)
    words["b"] = [1]
    call.step()
    assert heard(call, "a") == [1]


def test_a_reset_forgets_what_was_said() -> None:
    sim, words = robots((0, 0), (2, 0))
    words["a"] = [1, 1]
    sim.step()
    sim.reset(2)
    assert heard(sim, "b") == [0, 0]


def test_speech_bubbles() -> None:
    sim, words = robots((0, 0), (2, 0))
    words["a"] = [1, -0.25]
    sim.step()
    assert said(capture_snapshot(sim)) == {"a": "“-0.25”"}
    del words["a"]
    for _ in range(10):
        sim.step()
    assert said(capture_snapshot(sim)) == {}


def test_two_that_call_each_other_get_there_together() -> None:
    sim = Scene.load("call").build(brains=lambda _: LocalBrain(controller=CallController()))
    sim.reset(1)
    while not sim.agents[0].done:
        sim.step()
    assert sim.agents[0].ledger.episode_terms == {"together": 10.0}


def test_replay_and_copy_have_the_messages() -> None:
    scene = Scene.load("call")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=solver_of("call")))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(7)
    while not sim.agents[0].done:
        sim.step()
    recorder.finish()
    episode = recorder.episodes[-1]
    replay = Replay(episode)
    assert replay.verdict.why == ""
    there = replay.continue_from(20, brains={"blue": LocalBrain(controller=solver_of("call"))})
    copy = scene.build()
    copy.agents[0].use_brain(LocalBrain(controller=solver_of("call")))
    copy.set_state(there.get_state())
    for _ in range(20):
        there.step()
        copy.step()
    assert copy.world.messages.get_state() == there.world.messages.get_state()
    assert [each.percept.data for each in copy.agents] == [
        each.percept.data for each in there.agents
    ]


@pytest.mark.parametrize("starts", [5, pytest.param(100, marks=pytest.mark.nightly)])
def test_without_hearing_the_pair_of_the_scene_fails(starts: int) -> None:
    sim = Scene.load("call").build()
    for agent in sim.agents:
        next(each for each in agent.sensors if isinstance(each, HearSensor)).is_active = False
    agent = sim.agents[0]
    agent.use_brain(LocalBrain(controller=solver_of("call")))
    won = 0
    for seed in range(starts):
        sim.reset(seed)
        while not agent.done:
            sim.step()
        won += agent.terminated
    assert won <= starts // 5
