"""Ink, messages, pictures on the ground and generated fields go through all that keeps a moment."""

import math
from typing import Any, ClassVar

import numpy as np
import pytest
from gymnasium.vector.utils import iterate

from ai4u_edu import Controller, ControlRequestor, LocalBrain, Percept, Scene
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.learn.envs import SceneEnv, SceneVectorEnv
from ai4u_edu.recording import Episode, Recorder, Replay
from ai4u_edu.recording.episode import decode, encode
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.snapshot import capture_bodies
from ai4u_edu.world import WorldView

pytestmark = pytest.mark.slow

TRACES = "type: PenActuator", "type: SpeakActuator", "picture: ", "generate:"
"""Words of scene files with ink, messages, a picture on the ground or a generated field."""
SCENES = [
    name for name in Scene.names() if any(word in Scene.load(name).dumps() for word in TRACES)
]
DECISIONS, EARLY = 60, 15
Moment = tuple[Any, ...]


class Scribbler(Controller):
    """Drives, draws and speaks by the count of its decisions, whatever there is to do so."""

    carried: ClassVar[tuple[str, ...]] = ("count",)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.actuators = [each for each in agent.actuators if each.is_output and each.is_active]

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.count = 0

    def get_action(self, percept: Percept) -> dict[str, list[float]]:
        self.count += 1
        action = {}
        for number, actuator in enumerate(self.actuators):
            low, high = actuator.limits()
            share = [
                0.5 + 0.5 * math.sin(self.count / (7 + 3 * number + place))
                for place in range(len(low))
            ]
            action[actuator.action_name] = list(
                np.array(low) + (np.array(high) - np.array(low)) * share
            )
        return action


def built(name: str) -> ControlRequestor:
    """Return a scene's world whose first agent draws and speaks, beside others as they are."""
    sim = Scene.load(name).build()
    sim.agents[0].use_brain(LocalBrain(controller=Scribbler()))
    return sim


def now(sim: ControlRequestor) -> Moment:
    """Return all of a moment that a decision could depend on."""
    image = sim.world.ink.image()
    return (
        [agent.percept.data for agent in sim.agents],
        capture_bodies(sim),
        image.digest,
        {key: tile.tobytes() for key, tile in image.tiles.items()},
        dict(sim.world.messages.get_state()),
    )


def lived(name: str) -> tuple[Episode, list[Moment]]:
    """Return an episode, and each moment in which the first agent decided."""
    sim, moments = built(name), []
    recorder = Recorder(sim, scene=Scene.load(name).description)
    sim.agents[0].begin_of_step.connect(lambda _: moments.append(now(sim)))
    sim.reset(9)
    for _ in range(DECISIONS):
        sim.step(sim.agents[0])
    recorder.finish()
    return recorder.episodes[-1], moments


def test_these_are_all_scenes_that_one_can_write_on_or_talk_in_or_whose_field_is_new() -> None:
    assert set(SCENES) >= {"ants", "call", "draw_figure", "printed_track"}
    assert set(SCENES) >= {"endless_line", "endless_maze", "endless_rescue"}


def test_the_scribbler_leaves_ink_and_messages() -> None:
    assert [name for name in SCENES if lived(name)[1][-1][2]] == ["ants", "draw_figure"]
    assert any(moment[4] for moment in lived("call")[1])


@pytest.mark.parametrize("name", SCENES)
def test_replay_and_scrubbing_show_each_moment_as_it_was(name: str) -> None:
    episode, moments = lived(name)
    replay = Replay(decode(Episode, encode(episode), "x.episode"))
    assert replay.verdict.exact, replay.verdict.why
    cache = FrameCache(episode).start()
    try:
        for step in (50, 12, 11, 13, 0, 40, 3):
            percepts, bodies, digest, tiles, messages = moments[step]
            moment = replay.at(step)
            assert moment.percept.data == percepts[0]
            for snapshot in (moment.snapshot, cache.snapshot(step, timeout=None)):
                assert snapshot is not None
                state = snapshot.state.world
                assert snapshot.bodies == bodies
                assert state.ink.digest == digest
                assert {key: tile.tobytes() for key, tile in state.ink.tiles.items()} == tiles
                assert dict(state.messages) == messages
    finally:
        cache.stop()


@pytest.mark.parametrize("name", SCENES)
def test_who_goes_on_from_the_past_begins_with_its_ink_and_messages(name: str) -> None:
    episode, moments = lived(name)
    futures = []
    for _ in range(2):
        brains = {episode.agents[0].id: LocalBrain(controller=Scribbler())}
        sim = Replay(episode).continue_from(30, brains=brains)
        percepts, *rest = now(sim)
        assert percepts[0] == moments[30][0][0]
        assert rest == list(moments[30][1:])
        for _ in range(DECISIONS):
            sim.step(sim.agents[0])
        futures.append(now(sim))
    assert futures[0] == futures[1]


@pytest.mark.parametrize("name", SCENES)
def test_a_clone_goes_on_bit_for_bit(name: str) -> None:
    sim, copy = built(name), built(name)
    sim.reset(9)
    for _ in range(EARLY):
        sim.step(sim.agents[0])
    copy.set_state(sim.get_state())
    assert now(copy) == now(sim)
    for _ in range(DECISIONS):
        sim.step(sim.agents[0])
        copy.step(copy.agents[0])
        assert now(copy) == now(sim)


@pytest.mark.parametrize("name", SCENES)
def test_worlds_of_a_vector_environment_are_as_one_alone(name: str) -> None:
    agent = Scene.load(name).build().agents[0].id
    options = {f"{agent}.max_steps_per_episode": 25}
    ours = SceneVectorEnv(2, name, observation="flat", agent=agent)
    alone = [SceneEnv(name, observation="flat", agent=agent) for _ in range(2)]
    ours.action_space.seed(1)
    told, _ = ours.reset(seed=5, options=options)
    for index, env in enumerate(alone):
        assert np.array_equal(env.reset(seed=5 + index, options=options)[0], told[index])
    over = [False, False]
    lengths: list[list[int]] = [[0], [0]]
    for _ in range(70):
        actions = ours.action_space.sample()
        told, rewards, terminated, truncated, _ = ours.step(actions)
        for index, (env, action) in enumerate(
            zip(alone, iterate(ours.action_space, actions), strict=True)
        ):
            if over[index]:  # a reset within a step begins with the scene's own numbers
                assert np.array_equal(env.reset()[0], told[index])
                over[index] = False
                lengths[index].append(0)
            else:
                reading, reward, *ends, _ = env.step(action)
                assert np.array_equal(reading, told[index])
                assert (reward, ends) == (rewards[index], [terminated[index], truncated[index]])
                over[index] = any(ends)
                lengths[index][-1] += 1
            assert now(env.sim) == now(ours.envs[index].sim)
    assert all(each[0] <= 25 for each in lengths)
    assert any(each[-1] > 25 or len(each) > 2 for each in lengths)
