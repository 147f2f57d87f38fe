"""One agent begins a new episode while the world and the others go on."""

import hashlib
import textwrap
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    Command,
    ControlRequestor,
    GrabActuator,
    LocalBrain,
    PositionSensor,
    RBMoveActuator,
    RespawnActuator,
    StepSensor,
    TouchRewardFunc,
    TouchSensor,
    World,
)
from ai4u_edu.world import Variation
from tests.agent.tracing import Log, traced_agent, traced_world
from tests.builders import still

AHEAD = {"move": [1, 0, 0, 0]}


def drive(_percept: Any) -> dict[str, Any]:
    return AHEAD


def agent_on(body: str, controller: Any = still, **fields: Any) -> BasicAgent:
    """An agent that decides on every tick."""
    brain = LocalBrain(controller=controller, skip_frame=fields.pop("skip_frame", 0))
    actuators = fields.pop("actuators", [RBMoveActuator(move_amount=2)])
    return BasicAgent(body=body, id=body, actuators=actuators, brains=[brain], **fields)


def two(one: BasicAgent, other: BasicAgent, *, apart: float = 3.0) -> ControlRequestor:
    """Agents "one" at the origin, looking to "other"; reset and ready."""
    world = World()
    world.add_body("one", CircleShape(radius=0.5))
    world.add_body("other", CircleShape(radius=0.5), position=(apart, 0))
    sim = ControlRequestor(world, [one, other])
    sim.reset(0)
    return sim


def check(log: Log, expected: str) -> None:
    assert log == textwrap.dedent(expected).strip().splitlines()


def traced_pair(log: Log, *answers: Any, **fields: Any) -> ControlRequestor:
    """An agent "a" that answers so, and an agent "b" in the middle of a long decision."""
    agents = [
        traced_agent(log, *answers, id="a", body="a", skip_frame=0, **fields),
        traced_agent(log, {"go": 1}, id="b", body="b", skip_frame=9),
    ]
    sim = ControlRequestor(traced_world(log, "a", "b"), agents)
    sim.reset()
    log.clear()
    return sim


def test_a_brain_asks_for_it_and_it_happens_when_the_tick_is_over() -> None:
    log: Log = []
    sim = traced_pair(log, {"go": 1}, Command.RESPAWN, {"go": 2})
    for _ in range(3):
        sim.tick()
    check(
        log,
        """
        a: decide eye=0 done=False -> go=1
        a: begin_of_step
        b: decide eye=0 done=False -> go=1
        b: begin_of_step
        a: begin_of_apply_action
        a: act go=1
        a: end_of_apply_action
        b: begin_of_apply_action
        b: act go=1
        b: end_of_apply_action
        tick
        a: reward pay
        a: end_of_step reward=1
        a: begin_of_update_state
        a: read eye=1
        a: end_of_update_state
        a: decide eye=1 done=False -> respawn
        b: begin_of_apply_action
        b: act go=1
        b: end_of_apply_action
        tick
        a: before_the_reset
        a goes back
        a: reset reward pay
        a: reset sensor eye
        a: reset actuator go
        a: reset brain
        a: begin_of_update_state
        a: read eye=0
        a: end_of_update_state
        a: begin_of_episode
        a: decide eye=0 done=False -> go=2
        a: begin_of_step
        a: begin_of_apply_action
        a: act go=2
        a: end_of_apply_action
        b: begin_of_apply_action
        b: act go=1
        b: end_of_apply_action
        tick
        a: reward pay
        a: end_of_step reward=1
        a: begin_of_update_state
        a: read eye=1
        a: end_of_update_state
        """,
    )
    assert (sim.episode, sim.world.ticks) == (1, 3)
    assert [agent.episode for agent in sim.agents] == [2, 1]


def test_it_comes_after_the_end_of_an_episode() -> None:
    log: Log = []
    sim = traced_pair(log, {"go": 1}, Command.RESPAWN, max_steps_per_episode=1)
    first = sim.agents[0]
    sim.tick()
    assert (first.truncated, first.percept["done"], first.steps) == (True, True, 1)
    sim.tick()
    assert (first.done, first.percept["done"], first.steps) == (False, False, 0)
    assert first.body.position == (0.0, 0.0)
    assert first.ledger.episode_total == 0.0


def test_a_reset_that_another_one_asks_for_at_the_same_tick_is_enough() -> None:
    log: Log = []
    agents = [
        traced_agent(log, Command.RESPAWN, id="a", body="a"),
        traced_agent(log, Command.RESTART, id="b", body="b"),
    ]
    sim = ControlRequestor(traced_world(log, "a", "b"), agents)
    sim.reset()
    log.clear()
    sim.tick()
    assert "a goes back" not in log
    assert log.count("a: begin_of_episode") == 1
    assert sim.episode == 2


def test_of_two_at_once_both_are_in_their_places_before_one_senses() -> None:
    def then_again(percept: Any) -> Any:
        return Command.RESPAWN if percept["steps"] == 60 else AHEAD

    def sensors(target: str) -> list[Any]:
        return [StepSensor(), PositionSensor(target=target, normalized=False)]

    one = agent_on("one", then_again, sensors=sensors("other"))
    other = agent_on("other", then_again, sensors=sensors("one"))
    sim = two(one, other, apart=9.0)
    for _ in range(61):
        sim.tick()
    assert one.percept["position"].tolist() == [9.0, 0.0, 0.0]
    assert other.percept["position"].tolist() == [0.0, 0.0, 0.0]


def test_a_decision_under_way_ends_without_a_reward() -> None:
    one = agent_on("one", drive, skip_frame=9)
    one.end_of_step.connect(lambda agent: agent.add_reward(1))
    sim = two(one, agent_on("other", drive, skip_frame=9))
    for _ in range(15):
        sim.tick()
    assert (one.steps, one.ledger.episode_total) == (1, 1.0)
    before = sim.agents[1].body.position
    sim.restart(one)
    assert (one.steps, one.ledger.episode_total, one.episode) == (0, 0.0, 2)
    assert not sim.between_decisions()  # the other one is in the middle of its own
    assert sim.agents[1].body.position == before
    sim.step(one)
    assert (one.steps, sim.world.ticks) == (1, 25)


def test_the_body_is_as_after_a_reset() -> None:
    world = World(gravity=9.81)
    world.add_floor("plate", BoxShape(size=(6, 6)))
    world.add_body("one", CircleShape(radius=0.5), heading_deg=30, velocity=(1, 0.5))
    sim = ControlRequestor(world, [agent_on("one", actuators=[])])
    sim.reset(0)
    body = world["one"]
    before = (*body.pose, *body.velocity, body.angular_velocity, body.on_ground)
    body.move_to(5, 0)
    body.set_angular_velocity(2)
    for _ in range(60):
        sim.tick()
    assert body.fallen
    sim.restart(sim.agents[0])
    assert (*body.pose, *body.velocity, body.angular_velocity, body.on_ground) == before
    assert not sim.world["one"].fallen
    sim.tick()
    assert body.position[0] > 0  # the physics has it back


def test_contacts_end_and_may_begin_again() -> None:
    one = agent_on(
        "one",
        sensors=[TouchSensor(target="other")],
        rewards=[TouchRewardFunc(target="other", reward=1)],
    )
    other = agent_on("other", rewards=[TouchRewardFunc(target="one", reward=1)], skip_frame=4)
    sim = two(one, other, apart=0.9995)  # they touch from the start
    sim.tick()
    assert one.percept["touch"].tolist() == [1.0]
    assert one.ledger.episode_total == 1.0
    sim.restart(one)  # to the very place where it is
    assert one.percept["touch"].tolist() == [-1.0]
    assert sim.world.contacts.of("other") == ()
    sim.tick()
    assert one.percept["touch"].tolist() == [1.0]
    assert one.ledger.episode_total == 1.0  # the touch of this episode, not of the last one
    assert sim.world.contacts.of("other") == ("one",)


def test_what_was_touched_before_is_no_touch_of_the_new_episode() -> None:
    one = agent_on("one", drive, rewards=[TouchRewardFunc(target="other", reward=1)])
    sim = two(one, agent_on("other"))
    while not one.ledger.episode_total:
        sim.tick()
    sim.restart(one)
    for _ in range(20):
        sim.tick()
    assert one.ledger.episode_total == 0.0


def test_whoever_touched_it_touched_it_until_now() -> None:
    one = agent_on("one")
    other = agent_on("other", rewards=[TouchRewardFunc(target="one", reward=1)], skip_frame=9)
    sim = two(one, other, apart=1.2)
    for _ in range(10):
        sim.tick()  # a decision without a touch
    one.body.set_velocity(5, 0)
    while not sim.world.contacts.of("one"):
        sim.world.tick()
    sim.restart(one)  # before the other one was paid
    sim.step(other)
    assert other.ledger.episode_total == 1.0


def test_what_it_holds_is_let_go_and_what_holds_it_lets_go() -> None:
    grip = {"move": [0.2, 0, 0, 0], "grab": [1]}
    for restarted in ("one", "other"):
        one = agent_on("one", lambda _percept: grip, actuators=[RBMoveActuator(), GrabActuator()])
        sim = two(one, agent_on("other", actuators=[]), apart=1.05)
        while one.body.held is None:
            sim.tick()
        held = sim.world["other"]
        sim.restart(sim.agent(restarted))
        assert not sim.world.space.constraints  # by which one holds another
        assert held.position[0] == pytest.approx(1.05, abs=0.05)


def test_stacked_readings_begin_anew_for_it_alone() -> None:
    def sensors() -> list[Any]:
        return [PositionSensor(stacked_observations=3, normalized=False)]

    one = agent_on("one", drive, sensors=sensors())
    other = agent_on("other", drive, sensors=sensors())
    sim = two(one, other, apart=9.0)
    for _ in range(5):
        sim.tick()
    kept = other.percept["position"].tolist()
    sim.restart(one)
    assert one.percept["position"].tolist() == [[0.0, 0.0, 0.0]] * 3
    assert other.percept["position"].tolist() == kept
    assert len({x for x, _, _ in kept}) == 3


def test_an_agent_that_is_done_takes_no_more_decisions_and_the_others_go_on() -> None:
    one = agent_on("one", drive, max_steps_per_episode=3)
    other = agent_on("other", drive)
    sim = two(one, other)
    for _ in range(10):
        sim.tick()
    assert (one.steps, one.done) == (3, True)
    assert (other.steps, other.done) == (10, False)
    assert one.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert one.body.velocity[0] < 2.0 * 0.8  # nothing drives it any more


def respawned(seed: int) -> tuple[list[int], str]:
    """The places and the trajectory of a world in which one agent begins anew and anew."""
    places = [(0.0, float(y), 0.0) for y in range(-6, 7, 2)]
    respawn = RespawnActuator(poses=places)
    one = agent_on("one", drive, actuators=[RBMoveActuator(), respawn], max_steps_per_episode=20)
    one.brains[0] = LocalBrain(
        controller=lambda percept: Command.RESPAWN if percept["done"] else AHEAD, skip_frame=0
    )
    other = agent_on("other", lambda _percept: {"move": [1, 0.3, 0, 0]})
    sim = two(one, other)
    sim.reset(seed)
    digest, chosen = hashlib.sha256(), [respawn.last_selected]
    for _ in range(300):
        sim.tick()
        for body in sim.world.bodies.values():
            digest.update(np.array([*body.pose, *body.velocity]).tobytes())
        if one.episode > len(chosen):
            chosen.append(respawn.last_selected)
    return chosen, digest.hexdigest()


def test_the_same_seed_gives_the_same_episodes_and_each_is_another_one() -> None:
    chosen, digest = respawned(1)
    assert respawned(1) == (chosen, digest)
    assert respawned(2)[1] != digest
    assert len(chosen) > 12
    assert len(set(chosen)) > 4  # each episode draws for itself


def test_a_place_that_is_taken_is_made_free() -> None:
    one, other = agent_on("one"), agent_on("other", actuators=[])
    sim = two(one, other)
    one.body.move_to(-5, 0)
    other.body.move_to(0.2, 0)
    sim.restart(one)
    for _ in range(60):
        sim.tick()
    assert one.body.distance(other.body) > 0.98


def test_what_is_random_is_drawn_anew_for_that_body_alone() -> None:
    def starts(seed: int) -> list[tuple[float, float]]:
        world = World()
        for name, x in (("one", (-9.0, -2.0)), ("other", (2.0, 9.0))):
            world.add_body(name, CircleShape(radius=0.5), random=Variation(x=x))
        sim = ControlRequestor(world, [agent_on("one"), agent_on("other")])
        sim.reset(seed)
        found = [world["one"].position]
        for _ in range(5):
            before = world["other"].position
            sim.restart(sim.agents[0])
            assert world["other"].position == before
            found.append(world["one"].position)
        return found

    assert starts(1) == starts(1)
    assert len(set(starts(1))) == 6
    assert starts(1) != starts(2)
