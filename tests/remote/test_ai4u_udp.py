"""AI4U's protocol over real sockets: a session, and everything that can happen to it."""

import gc
import threading
from collections.abc import Iterator
from json import dumps
from typing import Any, Literal

import psutil
import pytest

from ai4u_edu import (
    AgentArraySensor,
    BasicAgent,
    BearingSensor,
    CircleShape,
    ControlRequestor,
    EventSensor,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    RewardFunc,
    Scene,
    World,
)
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.links.ai4u import AI4ULink
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.validation import WireError
from tests.builders import small_sim
from tests.remote.udp_script import NOOP, RESET, TICK_S, WAIT, UDPScript, udp_script
from tests.waiting import LIMIT_S, Deadline, until

AHEAD, BACK = "move;4;1.0;0;0;0", "move;4;-1.0;0;0;0"
RECEIVE_TIMEOUT_S = 0.2
"""Time for which a script may be silent, by its clock."""


@pytest.fixture
def script() -> Iterator[UDPScript]:
    with udp_script() as script:
        yield script


def remote_sim(script: UDPScript, **fields: Any) -> tuple[ControlRequestor, RemoteBrain]:
    """One agent whose brain is that script."""
    given = {
        name: fields.pop(name) for name in ("mode", "on_missing", "skip_frame") if name in fields
    }
    brain = remote_brain(script, **given)
    sim = small_sim([BearingSensor(target="box")], brains=[brain], **fields)
    return sim, brain


def remote_brain(script: UDPScript, **given: Any) -> RemoteBrain:
    """A brain that knows no time but the script's."""
    link = AI4ULink(
        "127.0.0.1",
        script.port,
        receive_timeout=RECEIVE_TIMEOUT_S,
        threaded=given.get("mode") == "realtime",
        clock=script.clock,
    )
    timeout = int(1000 * RECEIVE_TIMEOUT_S)
    return RemoteBrain.with_link(link, clock=script.clock, receive_timeout=timeout, **given)


def silent(script: UDPScript, sim: ControlRequestor, brain: RemoteBrain) -> None:
    """Let time pass until a script that says nothing is given up."""
    script.clock.advance(RECEIVE_TIMEOUT_S)
    until(lambda: brain.status().state == "lost", lambda _: script.tick(sim))


# -- a session -------------------------------------------------------------------------------------


def test_a_session(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    agent = sim.agents[0]
    state = script.meet(sim)
    assert brain.status().state == "connected"
    assert (state["done"], state["steps"], state["id"]) == (False, 0, "0")
    assert state["bearing"].tolist() == [0.0, 1.0]
    script.say(AHEAD)
    state = script.next(sim)
    assert (state["steps"], agent.steps) == (1, 1)
    assert agent.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert sim.world.ticks == 5  # its whole cycle is over
    assert brain.status().decisions == 1
    brain.close()


def test_a_script_reacts_to_an_event_of_the_body(script: UDPScript) -> None:
    brain = remote_brain(script)
    sim = small_sim([EventSensor(target="box", perception_key="hit")], brains=[brain])
    script.meet(sim)
    hits = [0.0]
    for _ in range(80):
        script.say(BACK if sum(hits) else AHEAD)
        hits += script.next(sim)["hit"].tolist()
    assert sum(hits) == 1.0
    assert sim.world["robot"].velocity[0] < 0
    brain.close()


def test_a_script_is_told_as_soon_as_the_agent_has_sensed(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say(AHEAD)
    while sim.agents[0].steps < 1:
        assert script.heard() is None
        sim.tick()
    assert script.hear()["steps"] == 1  # and not only when the next tick asks for an action
    brain.close()


def test_the_handshake_tells_of_the_sensors_and_of_the_actuator(script: UDPScript) -> None:
    sim, brain = remote_sim(script, max_steps_per_episode=300)
    script.next(sim)
    script.say(NOOP)
    request = script.next(sim)
    assert request.pop("modelmetadata") == (
        '{"inputs": [{"name": "bearing", "shape": [2], "type": 5, "rangeMin": -1.0, '
        '"rangeMax": 1.0, "dataType": 5}], "outputs": [{"name": "move", "isContinuous": true, '
        '"shape": [4], "rangeMin": [-1.0, -1.0, 0.0, 0.0], "rangeMax": [1.0, 1.0, 1.0, 1.0]}]}'
    )
    assert request == {"__target__": "envcontrol", "max_steps": 300, "id": "0", "config": 1}
    brain.close()


def test_a_script_that_is_not_there_yet_keeps_nobody_waiting(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.close()
    for _ in range(300):
        script.tick(sim)
    assert (sim.world.ticks, sim.agents[0].steps) == (300, 0)
    status = brain.status()
    assert status.state == "waiting"
    assert status.reason == f"no AI4U script listens at 127.0.0.1:{script.port} yet"
    with udp_script(script.port) as late:
        late.clock = script.clock
        late.meet(sim)
        assert brain.status().state == "connected"
        assert brain.status().reason == ""
    brain.close()


def test_the_world_stands_still_while_the_script_asks_for_time(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    ticks = sim.world.ticks
    for _ in range(10):  # for more than the timeout: it is there, and says so
        script.clock.advance(RECEIVE_TIMEOUT_S / 2)
        script.say(WAIT)
        state = script.next(sim)
        assert state["steps"] == 0
    assert sim.waiting_for_brain
    assert sim.world.ticks == ticks
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    brain.close()


def test_noop_lets_a_tick_pass_and_asks_again(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    ticks = sim.world.ticks
    script.say(NOOP)
    assert script.next(sim)["steps"] == 0
    assert sim.world.ticks == ticks + 1
    brain.close()


def test_pause_and_resume(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    agent = sim.agents[0]
    script.meet(sim)
    script.say("__pause__;1;0")
    assert script.next(sim)["__ctrl_paused__"] is True
    assert agent.paused
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 0  # it takes no decisions now
    script.say("__resume__;1;0")
    assert script.next(sim)["__ctrl_paused__"] is False
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    brain.close()


def test_stop_lasts_until_the_reset(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("__stop__;1;0")
    assert script.next(sim)["__ctrl_stopped__"] is True
    for reply in (AHEAD, "__resume__;1;0", AHEAD):
        script.say(reply)
        assert script.next(sim)["steps"] == 0
    script.say(RESET)
    state = script.next(sim)
    assert (state["__ctrl_stopped__"], state["steps"]) == (False, 0)
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    brain.close()


def test_an_episode_ends_and_the_next_begins(script: UDPScript) -> None:
    sim, brain = remote_sim(script, max_steps_per_episode=2)
    script.meet(sim)
    states = []
    for _ in range(2):
        script.say(AHEAD)
        states.append(script.next(sim))
    assert [(each["done"], each["truncated"]) for each in states] == [(False, False), (True, True)]
    script.say(WAIT)
    assert script.next(sim)["done"] is True
    episode = sim.episode
    script.say(RESET)
    state = script.next(sim)
    assert (state["done"], state["truncated"], state["steps"]) == (False, False, 0)
    assert sim.episode == episode + 1
    brain.close()


def test_envcontrol_goes_back_to_the_beginning(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("__envcontrol__;1;0")
    request = script.next(sim)
    assert request["__target__"] == "envcontrol"
    assert request["__envcontrol__"] == "__envcontrol__"
    ticks = sim.world.ticks
    for _ in range(10):
        script.tick(sim)
    assert sim.world.ticks == ticks + 10  # nobody waits for a script that doesn't play
    script.say(RESET)
    assert script.next(sim)["done"] is False
    brain.close()


def test_halt_ends_the_session_and_a_new_one_may_begin(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("halt")
    assert "wait_command" in script.next(sim)  # it knocks again
    status = brain.status()
    assert status.state == "waiting"
    assert status.reason == f"the script at 127.0.0.1:{script.port} has ended"
    script.say(NOOP)
    assert "config" in script.next(sim)
    brain.close()


def test_closing_says_goodbye(script: UDPScript) -> None:
    sim, _ = remote_sim(script)
    script.meet(sim)
    script.say(AHEAD)
    script.next(sim)
    sim.agents[0].use_brain(LocalBrain(controller=lambda percept: {}))
    request = script.hear()
    assert request == {"__target__": "envcontrol", "__stop__": "stop", "id": "0"}
    steps = sim.agents[0].steps
    sim.step()
    assert sim.agents[0].steps == steps + 1  # the other brain drives


def test_a_reset_that_the_script_did_not_ask_for_ends_its_episode(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say(AHEAD)
    before = script.next(sim)
    sim.reset()
    script.say(AHEAD)  # meant for the episode before
    state = script.next(sim)
    assert (state["done"], state["truncated"], state["steps"]) == (True, True, before["steps"])
    assert sim.agents[0].steps == 0
    script.say(RESET)
    assert script.next(sim)["done"] is False
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    brain.close()


def test_with_others_there_a_reset_is_the_agents_own(script: UDPScript) -> None:
    world = World()
    agents = []
    for index in range(2):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        remote = remote_brain(script, skip_frame=0)
        local = LocalBrain(controller=lambda percept: {"move": [1, 0, 0, 0]}, skip_frame=0)
        agents.append(
            BasicAgent(
                body=f"robot{index}",
                id=str(index),
                sensors=[BearingSensor(target="robot0")] if index else [],
                actuators=[RBMoveActuator()],
                brains=[remote if index else local],
            )
        )
    sim = ControlRequestor(world, agents)
    sim.reset(1)
    state = script.meet(sim, agent="1")
    assert (state["id"], state["done"]) == ("1", False)
    assert sim.episode == 1
    assert [agent.episode for agent in sim.agents] == [1, 2]
    assert sim.agents[0].steps > 0
    sim.agents[1].brain.close()


def test_the_fields_of_a_command_drive_other_actuators(script: UDPScript) -> None:
    actuators = [RBMoveActuator(), RBMoveActuator(action_name="other")]
    sim, brain = remote_sim(script, actuators=actuators)
    script.meet(sim)
    script.say(f"{AHEAD}@other;4;0;1;0;0@note;1;hello")
    script.next(sim)
    assert sim.agents[0].last_action == {
        "move": (1.0, 0.0, 0.0, 0.0),
        "other": (0.0, 1.0, 0.0, 0.0),
    }
    brain.close()


class One(RewardFunc):
    """Pays 1 for each decision."""

    def on_update(self, body: Any, view: Any) -> float:
        return 1.0


def test_a_late_script_is_told_the_rewards_of_all_decisions_since(script: UDPScript) -> None:
    sim, brain = remote_sim(script, mode="realtime", skip_frame=0, rewards=[One()])
    told = script.meet(sim)["reward"]

    def go_on() -> None:
        last = sim.agents[0].steps + 3
        until(lambda: sim.agents[0].steps > last, lambda _: script.tick(sim, 0.001))

    for _ in range(5):
        go_on()
        script.say(AHEAD)
        state = script.next(sim)
        told += state["reward"]
        assert told == state["steps"]
    go_on()
    script.say(RESET)
    state = script.next(sim)
    assert state["reward"] == state["steps"]
    brain.close()


# -- wrong actions ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        ("move;2;1;0", "action 'move': expected 4 numbers, got 2"),
        ("move;4;nan;0;0;0", "action 'move': expected finite numbers"),
        ("move;4;inf;0;0;0", "action 'move': expected finite numbers"),
        ("move;4;1,5;0;0;0", "action 'move': expected 4 numbers, got ('1,5', '0', '0', '0')"),
        ("mvoe;4;1;0;0;0", "agent '0' has no actuator 'mvoe'; did you mean 'move'?"),
    ],
)
def test_a_wrong_action_is_refused_and_the_script_gets_the_next_state(
    script: UDPScript, reply: str, says: str
) -> None:
    sim, brain = remote_sim(script, on_missing="coast")
    script.meet(sim)
    script.say(reply)
    assert script.next(sim)["steps"] == 1
    status = brain.status()
    assert (status.refused, status.missing, status.decisions) == (1, 1, 0)
    assert says in status.reason
    assert says in status.warning
    assert status.warnings == 1
    assert sim.agents[0].last_action == {}
    script.say(AHEAD)
    script.next(sim)
    assert (brain.status().decisions, brain.status().reason) == (1, "")
    assert says in brain.status().warning  # a person may not have read it yet
    brain.close()


@pytest.mark.parametrize(
    ("reply", "says"),
    [
        (
            f"{AHEAD}@goalDist;1;3",
            "field 'goalDist' of 'move' had no effect: expected names of other actuators "
            "(known are 'other'), once each",
        ),
        (
            f"{AHEAD}@othr;4;0;1;0;0@goalDist;1;3",
            "fields 'othr', 'goalDist' of 'move' had no effect: expected names of other actuators "
            "(did you mean 'other'?), once each",
        ),
        (f"{AHEAD}@move;4;0;1;0;0", "field 'move' of 'move' had no effect"),
        (f"{AHEAD}@other;4;0;1;0;0@other;4;0;1;0;0", "field 'other' of 'move' had no effect"),
        (
            f"{RESET}@goalDist;1;3",
            "field 'goalDist' of '__reset__' had no effect: expected no fields",
        ),
        (f"__pause__;1;0@{AHEAD}", "field 'move' of '__pause__' had no effect: expected no fields"),
    ],
)
def test_fields_that_nothing_reads_are_reported(script: UDPScript, reply: str, says: str) -> None:
    actuators = [RBMoveActuator(), RBMoveActuator(action_name="other")]
    sim, brain = remote_sim(script, actuators=actuators)
    script.meet(sim)
    script.say(reply)
    script.next(sim)
    status = brain.status()
    assert says in status.warning
    assert (status.warnings, status.refused) == (1, 0)
    brain.close()


def test_fields_that_actuators_take_are_no_mistake(script: UDPScript) -> None:
    actuators = [RBMoveActuator(), RBMoveActuator(action_name="other")]
    sim, brain = remote_sim(script, actuators=actuators)
    script.meet(sim)
    script.say(f"{AHEAD}@other;4;0;1;0;0")
    script.next(sim)
    assert (brain.status().warnings, brain.status().warning) == (0, "")
    brain.close()


def array_sim(script: UDPScript) -> tuple[ControlRequestor, RemoteBrain]:
    """An agent with a sensor of two numbers, which the script sets by a field."""
    brain = remote_brain(script)
    return small_sim([AgentArraySensor(perception_key="goal", size=2)], brains=[brain]), brain


def test_fields_reach_the_agent_and_its_sensor_of_numbers(script: UDPScript) -> None:
    sim, brain = array_sim(script)
    state = script.meet(sim)
    assert state["goal"].tolist() == [0, 0]
    script.say(f"{AHEAD}@goal;2;0.25;1@note;1;hello")
    state = script.next(sim)
    assert state["goal"].tolist() == [0.25, 1]
    assert sim.agents[0].fields == {"goal": ("0.25", "1"), "note": ("hello",)}
    assert brain.status().warning == (
        "field 'note' of 'move' had no effect: expected names of other actuators or sensors of "
        "numbers (known are 'goal'), once each"
    )
    assert state["__warning__"] == brain.status().warning, "the script finds it in its info"
    script.say(AHEAD)
    state = script.next(sim)
    assert state["goal"].tolist() == [0.25, 1]
    assert "__warning__" not in state
    assert sim.agents[0].fields == {}
    brain.close()


def test_fields_of_a_reset_are_in_its_first_percept(script: UDPScript) -> None:
    sim, brain = array_sim(script)
    script.meet(sim)
    script.say(f"{RESET}@goal;2;0.5;0.75")
    assert script.next(sim)["goal"].tolist() == [0.5, 0.75]
    assert brain.status().warnings == 0
    sim.reset()
    assert sim.agents[0].percept["goal"].tolist() == [0, 0]
    brain.close()


@pytest.mark.parametrize(
    ("field", "says"),
    [
        ("goal;1;0.5", "expected 2 values, got 1"),
        ("goal;2;0.5;7", "expected values from 0 to 1, got 7.0"),
        ("goal;2;0.5;far", "could not convert string to float: 'far'"),
    ],
)
def test_fields_that_do_not_fit_are_reported(script: UDPScript, field: str, says: str) -> None:
    sim, brain = array_sim(script)
    script.meet(sim)
    script.say(f"{AHEAD}@{field}")
    assert script.next(sim)["goal"].tolist() == [0, 0]
    assert "field 'goal' had no effect" in brain.status().warning
    assert says in brain.status().warning
    brain.close()


def test_a_message_that_is_no_command_is_named_with_the_next_reply(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("move;4;1;0")
    script.say(AHEAD)
    script.next(sim)
    assert brain.status().warning == (
        "a message of the script was ignored: 'move': expected 4 arguments as it says, got 2"
    )
    brain.close()


@pytest.mark.parametrize(
    ("before", "says"),
    [
        ([AHEAD], "action 'move' had no effect: the episode is over; expected a reset"),
        (
            ["__pause__;1;0"],
            "action 'move' had no effect: the agent is paused; expected a command to resume",
        ),
        (["__stop__;1;0"], "action 'move' had no effect: the agent was stopped; expected a reset"),
    ],
)
def test_an_action_that_can_have_no_effect_now_is_named(
    script: UDPScript, before: list[str], says: str
) -> None:
    sim, brain = remote_sim(script, max_steps_per_episode=1)
    script.meet(sim)
    for reply in before:
        script.say(reply)
        script.next(sim)
    assert brain.status().warning == ""
    script.say(AHEAD)
    script.next(sim)
    assert (brain.status().warning, brain.status().warnings) == (says, 1)
    brain.close()


def test_an_unknown_action_is_named_before_its_fields(script: UDPScript) -> None:
    sim, brain = remote_sim(script, on_missing="coast")
    script.meet(sim)
    script.say("mvoe;4;1;0;0;0@note;1;2")
    script.next(sim)
    status = brain.status()
    assert status.warning.startswith(
        "agent '0' has no actuator 'mvoe'; did you mean 'move'?; field"
    )
    assert status.warnings == 1
    brain.close()


def test_an_action_before_the_first_reset_is_named(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    for reply in (NOOP, "max_steps;1;0@id;1;0", "__start_agent__;1;0"):
        script.next(sim)
        script.say(reply)
    assert script.next(sim)["done"] is True
    script.say(AHEAD)
    script.next(sim)
    script.say(RESET)
    assert script.next(sim)["done"] is False
    assert brain.status().warning == (
        "action 'move' had no effect: expected '__reset__' first, with which an episode begins"
    )
    brain.close()


def test_a_session_that_ends_after_a_wrong_message_says_which(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("move;4;1;0")  # its only answer to that state
    silent(script, sim, brain)
    assert "'move': expected 4 arguments as it says, got 2" in brain.status().reason
    brain.close()


def test_a_warning_changes_seldom_and_goes_when_the_script_is_mended(script: UDPScript) -> None:
    sim, brain = remote_sim(script, on_missing="coast")
    script.meet(sim)
    for number in range(30):
        script.say(f"move;4;nan;{number};0;0")
        script.next(sim)
    status = brain.status()
    assert status.warnings == 30
    assert "('nan', '0', " in status.warning  # the first sentence still stands
    script.clock.advance(5.0)
    script.say("mvoe;4;1;0;0;0")
    script.next(sim)
    assert "'mvoe'" in brain.status().warning
    script.say(AHEAD)
    script.next(sim)
    assert "'mvoe'" in brain.status().warning
    script.clock.advance(10.0)
    script.say(AHEAD)
    script.next(sim)
    assert (brain.status().warning, brain.status().warnings) == ("", 31)
    brain.close()


def test_a_new_session_begins_without_a_warning(script: UDPScript) -> None:
    sim, brain = remote_sim(script, on_missing="coast")
    script.meet(sim)
    script.say("mvoe;4;1;0;0;0")
    script.next(sim)
    assert brain.status().warning
    script.say("halt")
    until(lambda: brain.status().state == "waiting", lambda _: script.tick(sim))
    assert brain.status().warning  # what went wrong can still be read
    while script.heard() is not None:
        pass
    script.meet(sim)
    assert (brain.status().warning, brain.status().warnings) == ("", 1)
    brain.close()


def test_out_of_range_action_is_clipped_and_counted_once(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say("move;4;500;0;-1;0")
    script.next(sim)
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert brain.status().clipped == 2
    assert sim.agents[0].actuators[0].clipped == 2
    brain.close()


# -- faults ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("on_missing", "action"),
    [("hold", {"move": (1.0, 0.0, 0.0, 0.0)}), ("coast", {}), ("stop", {"move": (0.0,) * 4})],
)
def test_a_lost_reply_ends_the_session_and_the_world_goes_on(
    script: UDPScript, on_missing: str, action: dict[str, Any]
) -> None:
    sim, brain = remote_sim(script, on_missing=on_missing)
    script.meet(sim)
    script.say(AHEAD)
    script.next(sim)  # and its reply is lost
    silent(script, sim, brain)
    status = brain.status()
    assert status.reason.startswith(
        f"the script at 127.0.0.1:{script.port} did not answer for 0.2 s: its session is over"
    )
    steps = sim.agents[0].steps
    for _ in range(50):
        sim.tick()
    assert sim.agents[0].steps >= steps + 9
    assert sim.agents[0].last_action == action
    assert brain.status().missing >= 9
    while (request := script.heard()) is not None:
        assert "wait_command" in request  # the state was not sent again
    brain.close()


def test_after_a_loss_a_new_session_begins_without_a_restart(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    silent(script, sim, brain)
    script.say(AHEAD)  # much too late
    ignored = brain.status().ignored
    while script.heard() is not None:
        pass
    state = script.meet(sim)
    assert (state["steps"], brain.status().state) == (0, "connected")
    assert brain.status().ignored == ignored + 1
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    brain.close()


def test_a_repeated_reply_counts_once(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    for step in range(1, 20):
        script.say(f"move;4;{step / 100};0;0;0", times=2)
        state = script.next(sim)
        assert state["steps"] == step
        assert sim.agents[0].last_action["move"][0] == pytest.approx(step / 100)
    assert brain.status().ignored == 19
    brain.close()


def test_replies_from_elsewhere_and_garbage_are_ignored(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    script.say_from_elsewhere("move;4;0;1;0;0")
    for garbage in (b"", b"\xff\x00", b"move;4;1", b"max_steps;1;0@id;1;0", b"x" * 9000):
        script.say(garbage)
    script.say(AHEAD)
    assert script.next(sim)["steps"] == 1
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert brain.status().ignored == 6
    brain.close()


def test_a_large_reply_is_read_to_its_end(script: UDPScript) -> None:
    actuators = [RBMoveActuator(), RBMoveActuator(action_name="last")]
    sim, brain = remote_sim(script, actuators=actuators)
    script.meet(sim)
    script.say(f"move;4;1.0;0;0;0@note;1;{'x' * 5000}@last;4;0;1;0;0")
    assert script.next(sim)["steps"] == 1
    assert sim.agents[0].last_action["last"] == (0.0, 1.0, 0.0, 0.0)
    assert brain.status().ignored == 0
    assert brain.status().decisions == 1
    brain.close()


def test_a_script_that_is_killed_and_one_that_comes_after_it(script: UDPScript) -> None:
    sim, brain = remote_sim(script, on_missing="stop")
    script.meet(sim)
    script.say(AHEAD)
    script.close()
    until(lambda: brain.status().state == "lost", lambda _: script.tick(sim))
    assert "is gone (Connection refused); start it again" in brain.status().reason
    with udp_script(script.port) as another:
        another.clock = script.clock
        assert another.meet(sim)["done"] is False
        another.say(AHEAD)
        assert another.next(sim)["steps"] == 1
    brain.close()


def test_the_others_go_on_when_a_script_is_lost(script: UDPScript) -> None:
    world = World()
    agents = []
    for index in range(2):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        brain = (
            remote_brain(script, skip_frame=0)
            if index
            else LocalBrain(controller=lambda percept: {}, skip_frame=0)
        )
        agents.append(
            BasicAgent(
                body=f"robot{index}",
                id=str(index),
                sensors=[BearingSensor(target="robot0")],
                actuators=[RBMoveActuator()],
                brains=[brain],
            )
        )
    sim = ControlRequestor(world, agents)
    sim.reset(1)
    script.meet(sim, agent="1")
    remote = agents[1].brain
    assert isinstance(remote, RemoteBrain)
    silent(script, sim, remote)
    before = [agent.steps for agent in sim.agents]
    for _ in range(20):
        sim.tick()
    assert [agent.steps for agent in sim.agents] == [steps + 20 for steps in before]
    remote.close()


def test_a_host_that_there_is_not() -> None:
    with pytest.raises(SetupError, match="host: expected a name or an IPv4 address, got 'no such'"):
        small_sim([BearingSensor(target="box")], brains=[RemoteBrain(host="no such")])


# -- the runner ------------------------------------------------------------------------------------


def test_a_world_that_waits_still_does_what_the_page_asks_for(script: UDPScript) -> None:
    sim, brain = remote_sim(script)  # whose clock stands still: it never stops waiting
    script.meet(sim)
    runner = Runner(sim, seed=1, time_scale=float("inf"))  # resets the world, too
    script.say(WAIT)
    runner.start()
    ticks = runner.submit(lambda: sim.world.ticks).result(LIMIT_S)
    runner.pause().result(LIMIT_S)
    assert runner.latest.paused
    runner.reset(seed=5).result(LIMIT_S)
    assert runner.latest.seed == 5
    assert (ticks, brain.status().missing) == (0, 0)
    runner.stop(LIMIT_S)


def test_a_page_that_pauses_does_not_lose_the_script(script: UDPScript) -> None:
    sim, brain = remote_sim(script)
    runner = Runner(sim, seed=1, time_scale=float("inf"))

    def rest() -> dict[str, Any]:
        """Let the paused world rest until it asks something."""
        deadline = Deadline()
        while (request := script.heard()) is None:
            deadline.left()
            script.clock.advance(TICK_S)
            runner.advance()
        return request

    runner.pause()
    for expected, reply in (("wait_command", NOOP), ("config", "max_steps;1;0@id;1;0")):
        assert expected in rest()
        script.say(reply)
    for _ in range(3):  # it is asked again and again, so that it doesn't take us for dead
        assert "wait_command" in rest()
        script.say(NOOP)
    rest()
    script.say(RESET)
    for _ in range(5):
        script.clock.advance(RECEIVE_TIMEOUT_S)
        runner.advance()
    assert script.heard() is None  # its reset waits until the time goes on
    runner.resume()
    assert rest()["steps"] == 0
    script.say(WAIT)
    runner.stop()
    assert brain.status().state == "waiting"


# -- real time -------------------------------------------------------------------------------------


def test_in_real_time_the_world_never_waits(script: UDPScript) -> None:
    sim, brain = remote_sim(script, mode="realtime", on_missing="stop", skip_frame=0)
    agent = sim.agents[0]
    for expected, reply in (
        ("wait_command", NOOP),
        ("config", "max_steps;1;0@id;1;0"),
        ("wait_command", RESET),
    ):
        assert expected in script.next(sim)
        script.say(reply)
    until(lambda: sim.episode > 1, lambda _: sim.tick())
    assert script.hear()["steps"] == 0  # as soon as it is sensed, and not with the next tick
    before = (sim.world.ticks, agent.steps, brain.status().missing)
    for _ in range(10):
        sim.tick()
    assert (sim.world.ticks, agent.steps) == (before[0] + 10, before[1] + 10)
    assert brain.status().missing == before[2] + 10
    assert brain.status().state == "late"
    assert agent.last_action == {"move": (0.0, 0.0, 0.0, 0.0)}
    script.say(AHEAD)  # late: it counts for the next decision
    until(lambda: brain.status().decisions, lambda _: sim.tick())
    assert agent.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert brain.status().decisions == 1
    state = script.hear()
    assert state["steps"] >= before[1] + 10
    brain.close()


def test_a_scene_that_is_read_opens_nothing_and_one_that_is_dropped_leaves_nothing() -> None:
    plain = Scene.load("box_chase").plain()
    plain["agents"][0]["brains"] = [{"type": "RemoteBrain", "port": 7, "mode": "realtime"}]

    def threads() -> list[str]:
        return [each.name for each in threading.enumerate() if each.name == "ai4u 127.0.0.1:7"]

    sim = Scene.loads(dumps(plain), name="scene.yaml").build()  # JSON is YAML as well
    sim.reset()
    assert not threads()
    sim.tick()
    assert threads()
    del sim
    until(lambda: gc.collect() >= 0 and not threads())


@pytest.mark.parametrize("mode", ["lockstep", "realtime"])
def test_percept_too_large_for_a_datagram_raises(
    script: UDPScript, mode: Literal["lockstep", "realtime"]
) -> None:
    brain = remote_brain(script, mode=mode)
    sensor = AgentArraySensor(size=1000, stacked_observations=40)
    sim = small_sim([sensor], brains=[brain])
    for reply in (NOOP, "max_steps;1;0@id;1;0", RESET):
        script.next(sim)
        script.say(reply)
    with pytest.raises(WireError, match="make sensors that read much smaller"):
        script.next(sim)
    brain.close()


@pytest.mark.parametrize("where", ["before it sends", "after it received nothing"])
def test_a_world_that_was_held_up_is_no_silence_of_the_script(
    script: UDPScript, where: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    sim, brain = remote_sim(script)
    script.meet(sim)
    link: Any = brain._link
    send, receive = link._socket.send, link._socket.receive

    def send_late(data: bytes) -> None:
        script.clock.advance(10 * RECEIVE_TIMEOUT_S)
        send(data)

    def receive_late() -> tuple[bytes, bool]:
        try:
            received: tuple[bytes, bool] = receive()
        except BlockingIOError:
            script.clock.advance(10 * RECEIVE_TIMEOUT_S)
            raise
        return received

    if where == "before it sends":
        monkeypatch.setattr(link._socket, "send", send_late)
        script.say(AHEAD)
        script.next(sim)
    else:
        monkeypatch.setattr(link._socket, "receive", receive_late)
    sim.tick()
    assert brain.status().state in ("connected", "late")  # and not lost
    brain.close()


def test_a_closed_brain_leaves_nothing_behind(script: UDPScript) -> None:
    before = psutil.Process().num_fds()
    for mode in ("lockstep", "realtime"):
        sim, brain = remote_sim(script, mode=mode)
        for _ in range(5):
            sim.tick()
        brain.close()
        brain.close()
    until(lambda: psutil.Process().num_fds() <= before)  # other threads may open files, too
    assert not [each for each in threading.enumerate() if f":{script.port}" in each.name]


@pytest.mark.parametrize("mode", ["lockstep", "realtime"])
def test_garbage_without_an_end_does_not_stop_the_world(
    script: UDPScript, mode: Literal["lockstep", "realtime"], monkeypatch: pytest.MonkeyPatch
) -> None:
    sim, brain = remote_sim(script, mode=mode)
    script.meet(sim)
    link: Any = brain._link
    monkeypatch.setattr(link._socket, "receive", lambda: (b"garbage", False))
    ticks = sim.world.ticks
    silent(script, sim, brain)
    assert sim.world.ticks >= ticks
    assert link.ignored > 0
