"""The order of the decision cycle and of all its events, as a contract."""

import textwrap

import pytest

from ai4u_edu import BasicAgent, Command, ControlRequestor
from tests.agent.tracing import (
    Log,
    TracedActuator,
    TracedBrain,
    TracedReward,
    TracedSensor,
    traced_agent,
    traced_world,
)


@pytest.fixture
def log() -> Log:
    return []


def check(log: Log, expected: str) -> None:
    assert log == textwrap.dedent(expected).strip().splitlines()


def test_setup_then_reset_then_one_decision_with_skip_frame_0(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=0)
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    check(
        log,
        """
        0: setup reward pay
        0: setup sensor eye
        0: setup actuator go
        0: setup brain
        0: agent_start
        0: before_the_reset
        world reset
        0: reset reward pay
        0: reset sensor eye
        0: reset actuator go
        0: reset brain
        0: begin_of_update_state
        0: read eye=0
        0: end_of_update_state
        0: begin_of_episode
        0: decide eye=0 done=False -> go=1
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=1
        0: end_of_apply_action
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=1
        0: end_of_update_state
        """,
    )


def _after_reset(sim: ControlRequestor, log: Log) -> None:
    sim.reset()
    log.clear()


def test_skip_frame_4_applies_the_action_on_five_ticks(log: Log) -> None:
    sim = ControlRequestor(traced_world(log), [traced_agent(log, {"go": 1}, skip_frame=4)])
    _after_reset(sim, log)
    sim.step()
    apply = """
        0: begin_of_apply_action
        0: act go=1
        0: end_of_apply_action
        tick"""
    check(
        log,
        f"""
        0: decide eye=0 done=False -> go=1
        0: begin_of_step{apply * 5}
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=1
        0: end_of_update_state
        """,
    )


def test_without_repeat_action_it_acts_on_the_first_tick_only(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=2, repeat_action=False)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    check(
        log,
        """
        0: decide eye=0 done=False -> go=1
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=1
        0: end_of_apply_action
        tick
        tick
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=1
        0: end_of_update_state
        """,
    )


def test_a_fall_in_the_middle_of_a_cycle_ends_it_there_and_is_paid_in_it(log: Log) -> None:
    agent = traced_agent(log, {"go": 60}, {"go": 0}, skip_frame=99)
    world = traced_world(log, edge=0.5)
    sim = ControlRequestor(world, [agent])
    _after_reset(sim, log)
    sim.step()
    assert agent.body.fallen
    ticks = log.count("tick")
    assert 30 < ticks < 50  # sqrt(2 * 2 m / g) = 0.64 s = 38 ticks, and one to the edge
    assert log[-6:] == [
        "0: reward pay",
        "0: end_of_step reward=1",
        "0: end_of_episode terminated=True truncated=False",
        "0: begin_of_update_state",
        "0: read eye=1",
        "0: end_of_update_state",
    ]
    assert (agent.steps, agent.reward, agent.percept["done"]) == (1, 1.0, True)


def test_a_reward_belongs_to_the_cycle_in_which_a_handler_added_it(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=1, rewards=[])
    sim = ControlRequestor(traced_world(log), [agent])
    amounts = {
        "before_the_reset": 1_000_000.0,
        "begin_of_episode": 100_000.0,
        "begin_of_update_state": 1.0,
        "end_of_update_state": 10.0,
        "begin_of_step": 100.0,
        "begin_of_apply_action": 1_000.0,
        "end_of_apply_action": 10_000.0,
        "end_of_step": 0.5,
    }
    for name, amount in amounts.items():
        getattr(agent, name).connect(
            lambda agent, name=name, amount=amount: agent.add_reward(amount, name=name)
        )
    sim.reset()
    for step in range(1, 4):
        sim.step()
        # two ticks a decision; the reading that ends it is part of it; what came before the first
        # decision is part of none
        assert agent.reward == 100 + 2 * 1_000 + 2 * 10_000 + 0.5 + 1 + 10
        assert agent.ledger.episode_total == step * agent.reward
    assert agent.reward_terms == {
        "begin_of_step": 100.0,
        "begin_of_apply_action": 2_000.0,
        "end_of_apply_action": 20_000.0,
        "end_of_step": 0.5,
        "begin_of_update_state": 1.0,
        "end_of_update_state": 10.0,
    }


def test_a_reward_added_when_the_episode_ends_is_paid_in_the_last_cycle(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, max_steps_per_episode=1)
    sim = ControlRequestor(traced_world(log), [agent])
    agent.end_of_episode.connect(lambda agent: agent.add_reward(5))
    sim.reset()
    sim.step()
    assert agent.reward == 6.0
    sim.reset()
    assert agent.reward == 0.0
    assert agent.ledger.episode_total == 0.0


def test_reset_in_the_middle_of_an_episode_and_of_a_cycle(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=2)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    sim.tick()  # one of three
    log.clear()
    sim.reset(seed=5)
    sim.tick()
    check(
        log,
        """
        0: before_the_reset
        world reset
        0: reset reward pay
        0: reset sensor eye
        0: reset actuator go
        0: reset brain
        0: begin_of_update_state
        0: read eye=0
        0: end_of_update_state
        0: begin_of_episode
        0: decide eye=0 done=False -> go=1
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=1
        0: end_of_apply_action
        tick
        """,
    )
    assert agent.steps == 0
    assert sim.world.seeds.seed == 5


def test_the_brain_can_ask_for_the_reset(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, Command.RESTART, {"go": 2}, skip_frame=0)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    log.clear()
    sim.step()
    check(
        log,
        """
        0: decide eye=1 done=False -> restart
        0: before_the_reset
        world reset
        0: reset reward pay
        0: reset sensor eye
        0: reset actuator go
        0: reset brain
        0: begin_of_update_state
        0: read eye=0
        0: end_of_update_state
        0: begin_of_episode
        """,
    )


def test_two_agents_with_different_periods_and_priorities(log: Log) -> None:
    slow = traced_agent(log, {"go": 1}, id="slow", body="a", skip_frame=2, priority=1)
    fast = traced_agent(log, {"go": 2}, id="fast", body="b", skip_frame=0, priority=7)
    sim = ControlRequestor(traced_world(log, "a", "b"), [slow, fast])
    assert [agent.id for agent in sim.agents] == ["fast", "slow"]
    _after_reset(sim, log)
    sim.step(slow)
    check(
        log,
        """
        fast: decide eye=0 done=False -> go=2
        fast: begin_of_step
        slow: decide eye=0 done=False -> go=1
        slow: begin_of_step
        fast: begin_of_apply_action
        fast: act go=2
        fast: end_of_apply_action
        slow: begin_of_apply_action
        slow: act go=1
        slow: end_of_apply_action
        tick
        fast: reward pay
        fast: end_of_step reward=1
        fast: begin_of_update_state
        fast: read eye=1
        fast: end_of_update_state
        fast: decide eye=1 done=False -> go=2
        fast: begin_of_step
        fast: begin_of_apply_action
        fast: act go=2
        fast: end_of_apply_action
        slow: begin_of_apply_action
        slow: act go=1
        slow: end_of_apply_action
        tick
        fast: reward pay
        fast: end_of_step reward=1
        fast: begin_of_update_state
        fast: read eye=2
        fast: end_of_update_state
        fast: decide eye=2 done=False -> go=2
        fast: begin_of_step
        fast: begin_of_apply_action
        fast: act go=2
        fast: end_of_apply_action
        slow: begin_of_apply_action
        slow: act go=1
        slow: end_of_apply_action
        tick
        fast: reward pay
        fast: end_of_step reward=1
        fast: begin_of_update_state
        fast: read eye=3
        fast: end_of_update_state
        slow: reward pay
        slow: end_of_step reward=1
        slow: begin_of_update_state
        slow: read eye=1
        slow: end_of_update_state
        """,
    )


def test_a_block_that_is_off_takes_no_part(log: Log) -> None:
    agent = traced_agent(
        log,
        {"go": 1},
        skip_frame=0,
        sensors=[TracedSensor(log=[]), TracedSensor(log=[], perception_key="off", is_active=False)],
        actuators=[
            TracedActuator(log=[]),
            TracedActuator(log=[], action_name="x", is_active=False),
        ],
        rewards=[TracedReward(log=[], is_active=False)],
    )
    sim = ControlRequestor(traced_world(log), [agent])
    assert log == [
        "0: setup sensor eye",
        "0: setup actuator go",
        "0: setup brain",
        "0: agent_start",
    ]
    _after_reset(sim, log)
    sim.step()
    assert "off" not in agent.percept
    agent.sensors[0].is_active = False
    agent.actuators[0].is_active = False
    log.clear()
    sim.step()
    check(
        log,
        """
        0: decide eye=1 done=False -> go=1
        0: begin_of_step
        0: begin_of_apply_action
        0: end_of_apply_action
        tick
        0: end_of_step reward=0
        0: begin_of_update_state
        0: end_of_update_state
        """,
    )
    assert agent.percept["eye"].tolist() == [0.0]


def test_a_brain_swapped_between_decisions_takes_the_next_one(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=1)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    before = agent.body.position
    other = TracedBrain(log=[], answers=[{"go": 9}], skip_frame=0)
    other.log = log
    log.clear()
    agent.use_brain(other)
    assert agent.body.position == before
    sim.step()
    check(
        log,
        """
        0: setup brain
        0: reset brain
        0: decide eye=1 done=False -> go=9
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=9
        0: end_of_apply_action
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=2
        0: end_of_update_state
        """,
    )
    assert [brain.enabled for brain in agent.brains] == [False, True]


def test_the_step_limit_truncates(log: Log) -> None:
    agent = traced_agent(log, {"go": 1}, skip_frame=0, max_steps_per_episode=2)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    assert not agent.done
    sim.step()
    assert (agent.terminated, agent.truncated, agent.steps) == (False, True, 2)
    assert "0: end_of_episode terminated=False truncated=True" in log


def test_after_the_end_the_brain_is_asked_but_only_a_restart_counts(log: Log) -> None:
    answers = ({"go": 1}, {"go": 5}, Command.PAUSE, Command.RESTART, {"go": 1})
    agent = traced_agent(log, *answers, skip_frame=0, max_steps_per_episode=1)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.step()
    log.clear()
    sim.tick()
    assert log == ["0: decide eye=1 done=True -> go=5", "tick"]
    sim.tick()
    sim.tick()
    assert not agent.done
    assert sim.episode == 2


@pytest.mark.parametrize(
    ("command", "asked_again"),
    [(Command.PAUSE, True), (Command.STOP, False), (Command.WAIT, True)],
)
def test_commands(log: Log, command: Command, asked_again: bool) -> None:
    agent = traced_agent(log, command, {"go": 1}, skip_frame=0)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    sim.tick()
    assert log[-1] == "tick"
    log.clear()
    sim.tick()
    assert any("decide" in line for line in log) is asked_again
    acted = any("act go" in line for line in log)
    assert acted is (command is Command.WAIT)


def test_resume_goes_on(log: Log) -> None:
    agent = traced_agent(log, Command.PAUSE, Command.RESUME, {"go": 1}, skip_frame=0)
    sim = ControlRequestor(traced_world(log), [agent])
    _after_reset(sim, log)
    for _ in range(3):
        sim.tick()
    assert "0: act go=1" in log


@pytest.mark.parametrize(("amount", "field"), [(-1.0, "negative"), (1.0, "positive")])
def test_done_at_reward(log: Log, amount: float, field: str) -> None:
    for wanted in (False, True):
        reward = TracedReward(log=[], amount=amount)
        agent = traced_agent(log, rewards=[reward], **{f"done_at_{field}_reward": wanted})
        sim = ControlRequestor(traced_world(log), [agent])
        sim.reset()
        sim.step()
        assert agent.terminated is wanted


def test_reward_scale_multiplies(log: Log) -> None:
    agent = traced_agent(log, reward_scale=0.5)
    agent.end_of_step.connect(lambda agent: agent.add_reward(3))
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    assert agent.reward_terms == {"pay": 0.5, "handlers": 1.5}


def test_a_handler_can_end_the_episode(log: Log) -> None:
    agent = traced_agent(log, skip_frame=1)
    agent.begin_of_step.connect(lambda agent: agent.add_reward(-2, request_done=True))
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    assert (agent.terminated, agent.reward) == (True, -1.0)


def test_events_can_be_disconnected(log: Log) -> None:
    agent = traced_agent(log)
    heard: list[BasicAgent] = []
    handler = agent.end_of_step.connect(heard.append)
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    agent.end_of_step.disconnect(handler)
    sim.step()
    assert heard == [agent]
