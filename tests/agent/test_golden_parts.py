"""Golden traces: two actuators in one action, conditions, sensors that are not resetable."""

from typing import Any

import pytest

from ai4u_edu import (
    AgentArraySensor,
    AndRewardFunc,
    BodyView,
    ControlRequestor,
    EvalBoolValue,
    EvalFloatValue,
    EvalIntValue,
    FloatArrayCompositeSensor,
    OrRewardFunc,
    WorldView,
)
from ai4u_edu.blocks.agent_view import AgentView
from tests.agent.test_golden_trace import check
from tests.agent.tracing import (
    Log,
    TracedActuator,
    TracedReward,
    TracedSensor,
    traced_agent,
    traced_world,
)
from tests.builders import small_sim


@pytest.fixture
def log() -> Log:
    return []


def two_actuators(log: Log, *answers: Any, **fields: Any) -> ControlRequestor:
    actuators = [TracedActuator(log=log), TracedActuator(log=log, action_name="grab")]
    agent = traced_agent(log, *answers, actuators=actuators, **fields)
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    log.clear()
    return sim


def test_all_actuators_act_between_one_begin_and_one_end_of_a_tick(log: Log) -> None:
    sim = two_actuators(log, {"grab": 2, "go": 1}, {"go": 3}, {}, skip_frame=1)
    for _ in range(3):
        sim.step()
    check(
        log,
        """
        0: decide eye=0 done=False -> grab=2 go=1
        0: begin_of_step
        0: begin_of_apply_action
        0: act grab=2
        0: act go=1
        0: end_of_apply_action
        tick
        0: begin_of_apply_action
        0: act grab=2
        0: act go=1
        0: end_of_apply_action
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=1
        0: end_of_update_state
        0: decide eye=1 done=False -> go=3
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=3
        0: end_of_apply_action
        tick
        0: begin_of_apply_action
        0: act go=3
        0: end_of_apply_action
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=2
        0: end_of_update_state
        0: decide eye=2 done=False -> nothing
        0: begin_of_step
        0: begin_of_apply_action
        0: end_of_apply_action
        tick
        0: begin_of_apply_action
        0: end_of_apply_action
        tick
        0: reward pay
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=3
        0: end_of_update_state
        """,
    )


def test_without_repeat_action_both_act_on_the_first_tick_only(log: Log) -> None:
    sim = two_actuators(log, {"go": 1, "grab": 2}, skip_frame=2, repeat_action=False)
    sim.step()
    check(
        log,
        """
        0: decide eye=0 done=False -> go=1 grab=2
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=1
        0: act grab=2
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


class Watching(TracedReward):
    """Says when it is asked whether it holds; it does so in every second decision."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        super().on_reset(agent, view)
        self.turn = 0

    def on_update(self, body: BodyView, view: WorldView) -> float:
        self.turn += 1
        return super().on_update(body, view)

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        holds = self.turn % 2 == 0
        self.log.append(f"{self.who}: {self.name} paid {paid:g}, holds={holds}")
        return holds


def test_conditions_are_asked_in_their_order_after_each_child_was_updated(log: Log) -> None:
    children = [Watching(log=log, name="one", amount=0.0), Watching(log=log, name="two")]
    both = AndRewardFunc(
        name="both",
        reward=10,
        children=[
            *children,
            EvalBoolValue(property="on_ground"),
            EvalIntValue(name="late", property="steps", min_value=1, max_value=1),
            OrRewardFunc(
                children=[
                    EvalFloatValue(property="x", min_value=5, max_value=6),
                    EvalFloatValue(name="near", property="x", min_value=-1, max_value=1),
                ]
            ),
        ],
    )
    last = Watching(log=log, name="last")
    agent = traced_agent(log, {"go": 0}, skip_frame=0, sensors=[TracedSensor(log=log)])
    agent.rewards = [both, last]
    for each in (*children, last):
        each.log = log  # a list given as a parameter is copied
    sim = ControlRequestor(traced_world(log), [agent])
    assert log[:3] == [
        "0: setup reward one",
        "0: setup reward two",
        "0: setup reward last",
    ]
    sim.reset()
    log.clear()
    sim.step()
    sim.step()
    check(
        log,
        """
        0: decide eye=0 done=False -> go=0
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=0
        0: end_of_apply_action
        tick
        0: reward one
        0: one paid 0, holds=False
        0: reward two
        0: two paid 1, holds=False
        0: reward last
        0: end_of_step reward=1
        0: begin_of_update_state
        0: read eye=1
        0: end_of_update_state
        0: decide eye=1 done=False -> go=0
        0: begin_of_step
        0: begin_of_apply_action
        0: act go=0
        0: end_of_apply_action
        tick
        0: reward one
        0: one paid 0, holds=True
        0: reward two
        0: two paid 1, holds=True
        0: reward last
        0: end_of_step reward=11
        0: begin_of_update_state
        0: read eye=2
        0: end_of_update_state
        """,
    )


class Lasting(TracedSensor):
    """Begins to count when it is set up."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        super().on_setup(agent, view)
        self.count = -1


def test_what_is_not_resetable_hears_of_no_reset(log: Log) -> None:
    sensors = [
        Lasting(log=log, resetable=False),
        TracedSensor(log=log, perception_key="ear", stacked_observations=2),
    ]
    agent = traced_agent(log, {"go": 1}, skip_frame=0, sensors=sensors)
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    log.clear()
    sim.reset()
    check(
        log,
        """
        0: before_the_reset
        world reset
        0: reset reward pay
        0: reset sensor ear
        0: reset actuator go
        0: reset brain
        0: begin_of_update_state
        0: read eye=2
        0: read ear=0
        0: end_of_update_state
        0: begin_of_episode
        """,
    )
    assert agent.percept["eye"].tolist() == [2]
    assert agent.percept["ear"].tolist() == [[0], [0]]


def test_inside_a_composite_it_is_the_same(log: Log) -> None:
    children: list[Any] = [
        Lasting(log=log, resetable=False),
        TracedSensor(log=log, perception_key="ear"),
    ]
    composite = FloatArrayCompositeSensor(sensors=children, range_max=9)
    for each in children:
        each.log = log
    agent = traced_agent(log, {"go": 1}, skip_frame=0)
    agent.sensors = [composite]
    sim = ControlRequestor(traced_world(log), [agent])
    sim.reset()
    sim.step()
    sim.reset()
    assert log.count("0: reset sensor ear") == 2
    assert "0: reset sensor eye" not in log
    assert agent.percept["array"].tolist() == [2, 0]


def test_what_a_script_set_outlives_the_reset() -> None:
    message = AgentArraySensor(size=2, resetable=False)
    sim = small_sim([message])
    message.set_values([0.25, 1.0])
    sim.reset()
    assert sim.agents[0].percept["__initial_input__"].tolist() == [0.25, 1.0]
