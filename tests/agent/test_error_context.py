"""Errors of blocks and handlers name the block or handler and its agent."""

from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    BasicAgent,
    Brain,
    ContinuousActuator,
    Controller,
    ControlRequestor,
    RBMoveActuator,
    RewardFunc,
    Sensor,
)
from ai4u_edu.base.errors import AI4UError, BlockError, ReadingError, WorldError
from tests.builders import small_sim, small_world

MOVE = {"move": [1, 0, 0, 0]}


class Pusher(Actuator):
    """Does what a test says."""

    job: Any = None
    when: str = "act"

    def space(self) -> Box:
        return Box(0.0, 1.0, (1,))

    def act(self, body: Any, action: Any) -> None:
        if self.when == "act":
            self.job(body)

    def on_tick(self, body: Any, view: Any) -> None:
        if self.when == "on_tick":
            self.job(body)


class Payer(RewardFunc):
    """Fails at a time that a test says."""

    when: str = "on_update"

    def on_setup(self, agent: Any, view: Any) -> None:
        self.fail("on_setup")

    def on_reset(self, agent: Any, view: Any) -> None:
        self.fail("on_reset")

    def on_tick(self, body: Any, view: Any) -> None:
        self.fail("on_tick")

    def on_update(self, body: Any, view: Any) -> float:
        self.fail("on_update")
        return 0.0

    def fail(self, now: str) -> None:
        if now == self.when:
            raise ZeroDivisionError(now)


def broken(_: Any) -> Any:
    raise ZeroDivisionError("odd")


def push_nan(body: Any) -> None:
    body.apply_force(float("nan"), 0.0)


def note_of(run: Any, kind: type[Exception] = ZeroDivisionError) -> str:
    with pytest.raises(kind) as caught:
        run()
    (note,) = caught.value.__notes__
    return str(note)


@pytest.mark.parametrize("skip_frame", [0, 4])
@pytest.mark.parametrize(("when", "doing"), [("act", "was acting"), ("on_tick", "was in its")])
def test_an_actuator(when: str, doing: str, skip_frame: int) -> None:
    def sim_with(job: Any) -> ControlRequestor:
        return small_sim(
            actuators=[RBMoveActuator(), Pusher(job=job, when=when)],
            controller=lambda percept: {**MOVE, "pusher": [1]},
            skip_frame=skip_frame,
            id="red",
        )

    assert note_of(sim_with(broken).step).startswith(
        f"while Pusher 'pusher' of agent 'red' {doing}"
    )
    with pytest.raises(WorldError) as caught:
        sim_with(push_nan).step()
    assert str(caught.value).startswith(
        "agent 'red', Pusher 'pusher': force of body 'robot': expected finite numbers"
    )


def test_a_handler_of_an_actuator() -> None:
    thruster = ContinuousActuator(size=1)
    sim = small_sim(actuators=[thruster], controller=lambda percept: {"continuous": [1]})
    with pytest.raises(BlockError, match=r"^agent '0', ContinuousActuator 'continuous': nobody"):
        sim.step()
    thruster.handler = lambda body, numbers: broken(body)
    assert note_of(sim.step) == ("while ContinuousActuator 'continuous' of agent '0' was acting")


@pytest.mark.parametrize("when", ["on_setup", "on_reset", "on_tick", "on_update"])
def test_a_reward_function(when: str) -> None:
    note = note_of(lambda: small_sim(rewards=[Payer(when=when)], skip_frame=2).step())
    assert note.startswith("while Payer 'payer' of agent '0' was ")


def test_a_brain_a_controller_and_a_function() -> None:
    class Clueless(Controller):
        """Doesn't know the way."""

        def get_action(self, percept: Any) -> Any:
            return percept["exit"]

    class Odd(Brain):
        """Fails."""

        def decide(self, percept: Any) -> Any:
            return broken(percept)

    assert note_of(small_sim(controller=broken).step) == (
        "while LocalBrain(ScriptController) of agent '0' was deciding"
    )
    assert note_of(small_sim(brains=[Odd()]).step) == "while Odd of agent '0' was deciding"
    with pytest.raises(AI4UError) as caught:
        small_sim(controller=Clueless()).step()
    assert str(caught.value).startswith(
        "agent '0', LocalBrain(Clueless): no reading is called 'exit'; known are"
    )


def test_a_brain_at_a_reset() -> None:
    class Forgetful(Controller):
        """Fails at a reset."""

        def on_reset(self, agent: Any, view: Any) -> None:
            broken(agent)

    assert note_of(lambda: small_sim(controller=Forgetful())) == (
        "while LocalBrain(Forgetful) of agent '0' was reset"
    )


def test_a_handler_of_an_event() -> None:
    def told(agent: BasicAgent) -> None:
        broken(agent)

    for name in ("end_of_step", "begin_of_apply_action", "end_of_update_state"):
        sim = small_sim()
        getattr(sim.agents[0], name).connect(told)
        assert note_of(sim.step) == f"while handler told of {name} of agent '0' was called"
    sim = small_sim()
    sim.agents[0].end_of_step.connect(lambda agent: agent.add_reward(float("nan")))
    with pytest.raises(ReadingError) as caught:
        sim.step()
    assert str(caught.value) == (
        "agent '0', handler <lambda> of end_of_step: add_reward of 'handlers': "
        "expected a finite number, got nan"
    )


def test_a_setup_that_fails_in_python() -> None:
    class Wild(Sensor):
        """Fails."""

        def space(self) -> Box:
            raise ZeroDivisionError("odd")

    assert note_of(lambda: small_sim([Wild()])) == "while Wild 'wild' of agent '0' was set up"


def test_an_error_names_its_block_once() -> None:
    class Proud(Sensor):
        """Reads more than it says."""

        def space(self) -> Box:
            return Box(0.0, 1.0, (1,))

        def read(self, body: Any, view: Any) -> Any:
            return np.array([np.nan])

    with pytest.raises(ReadingError) as caught:
        small_sim([Proud()], world=small_world())
    assert str(caught.value) == "agent '0', Proud 'proud': expected finite numbers, got [nan]"
