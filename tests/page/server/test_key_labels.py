"""The keys on the screen, in every scene: each does something, and all that can be done has one."""

import math
from functools import cache

import pytest

from ai4u_edu import BasicAgent, Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import RESTART
from ai4u_edu.blocks.keyboard import Stick
from ai4u_edu.page.server.bindings import has_stick
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.page.server.input_messages import key_labels, usable_keys
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import BodyState, capture_bodies
from tests.scenes.few import FEW

pytestmark = pytest.mark.slow

PATIENCE = 6
"""Decisions."""

AGENTS = [
    pytest.param(name, agent.id, marks=[] if name in FEW else [pytest.mark.nightly])
    for name in Scene.names()
    for agent in Scene.load(name).build().agents
]


def driven(scene: str, agent_id: str) -> tuple[ControlRequestor, BasicAgent]:
    """A scene in which a person drives that agent, taken over if need be."""
    sim = Scene.load(scene).build()
    sim.reset(1)
    agent = sim.agent(agent_id)
    agent.keyboard.timeout_s = math.inf
    brain = HumanOverride(Runner(sim, seed=1), agent).brain
    if brain is not agent.brain:
        agent.use_brain(brain)
    return sim, agent


@cache
def path(scene: str, agent_id: str, *held: str) -> tuple[BodyState, ...]:
    """Return the state of the agent's body after each decision."""
    sim, agent = driven(scene, agent_id)
    states = []
    for _ in range(PATIENCE):
        agent.keyboard.hold(held)
        sim.step(agent)
        states += [body for body in capture_bodies(sim) if body.name == agent.body_name]
    return tuple(states)


@pytest.mark.parametrize(("scene", "agent_id"), AGENTS)
def test_every_key_that_is_shown_does_something(scene: str, agent_id: str) -> None:
    _, agent = driven(scene, agent_id)
    shown = usable_keys(agent)
    assert RESTART in shown
    ahead = next(iter(shown.values()))[0]  # some only steer what rolls
    for action in shown.keys() - {RESTART}:
        code = shown[action][0]
        alone = path(scene, agent_id, code) != path(scene, agent_id)
        assert alone or path(scene, agent_id, ahead, code) != path(scene, agent_id, ahead), action


@pytest.mark.parametrize(("scene", "agent_id"), AGENTS)
def test_jump_key_exists_where_controls_mention_jump(scene: str, agent_id: str) -> None:
    _, agent = driven(scene, agent_id)
    told = Scene.load(scene).description.controls
    names = {key_labels(agent).get(action, action) for action in usable_keys(agent)}
    assert bool({"jump", "jump forward", "jump_forward"} & names) == ("jump" in told)


@pytest.mark.parametrize(("scene", "agent_id"), AGENTS)
def test_stick_is_offered_for_continuous_actuators(scene: str, agent_id: str) -> None:
    sim, agent = driven(scene, agent_id)
    if not has_stick(agent.brain):
        assert not any(actuator.is_continuous for actuator in agent.actuators[:1])
        return
    agent.keyboard.hold([], Stick(forward=0.5))
    sim.step(agent)
    half = next(iter(agent.last_action.values()))
    assert half[0] != 0
    agent.keyboard.hold([], Stick(forward=1.0))
    sim.step(agent)
    assert abs(next(iter(agent.last_action.values()))[0]) == pytest.approx(2 * abs(half[0]))


def test_a_caption_says_what_its_key_does() -> None:
    _, agent = driven("platform", "0")
    for action, expected in key_labels(agent).items():
        states = path("platform", "0", usable_keys(agent)[action][0])
        turned = states[0].heading - path("platform", "0")[0].heading
        assert (expected == "left") == (turned > 0.05)
        assert (expected == "right") == (turned < -0.05)
        assert (expected == "jump forward") == any(state.z > 0.1 for state in states)
