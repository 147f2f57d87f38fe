"""AI4U scripts at worlds elsewhere, through the bridge."""

import contextlib
import itertools
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu import ControlRequestor, RemoteBrain, Scene
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.links.ai4u import AI4UCodec
from ai4u_edu.blocks.brains.links.link import describe_agent
from ai4u_edu.page.server.scripts.settings import MIN_RECEIVE_TIMEOUT_MS
from ai4u_edu.remote import LostError, RefusedError
from ai4u_edu.remote.bridge import KEEPALIVE_INTERVAL_S, Bridge
from tests.page.server.rooms import served
from tests.remote.bridged import OPTIONS, TOKEN, bridged, run, scene_room
from tests.remote.faulty_proxy import Faults, FaultyProxy
from tests.remote.rooms import connect, log_of, log_room, patient_rules, unused_address
from tests.remote.test_ai4u_package import free_port, run_script
from tests.remote.udp_script import NOOP, RESET, WAIT, UDPScript, udp_script
from tests.waiting import LIMIT_S, Deadline, until

pytestmark = pytest.mark.slow


def test_the_unmodified_client_sees_what_the_world_recorded_whatever_the_network_does() -> None:
    faults = Faults(
        drop=0.05, duplicate=0.05, reorder=0.10, single_bytes=0.02, reset=0.02, latency=0.01
    )
    assert run(40, faults) == []


def test_pause_resume_and_stop_go_through() -> None:
    with scene_room() as room, bridged(room.url) as (port, _):
        seen = run_script("pausing.py", port)
    assert seen == [
        [1, False, False],
        [1, True, False],
        [1, True, False],
        [1, False, False],
        [2, False, False],
        [2, False, True],
        [2, False, True],
        [2, False, True],
        [2, False, True],
        [0, False, False],
        [1, False, False],
    ]


def offered(sim: ControlRequestor) -> AI4UCodec:
    """Return the codec of an agent for a script on the world's machine."""
    agent, found = sim.agents[0], []

    class Link(RemoteBrain):
        def on_setup(self, agent: AgentView, view: Any) -> None:
            found.append(describe_agent(agent, skip_frame=4, repeat_action=True, tick=view.dt))

    agent.use_brain(Link())
    return AI4UCodec(found[0])


@pytest.mark.parametrize("scene", ["box_chase", "sample_scene", "forage", "grid_world", "platform"])
def test_a_script_is_told_of_an_agent_what_it_is_told_beside_the_world(scene: str) -> None:
    with served(Scene.load(scene).build(), rules=patient_rules()) as room:
        agent = room.sim.agents[0].id
        bridge = Bridge(room.url, agent, port=free_port())
        assert bridge._codec.metadata == offered(Scene.load(scene).build()).metadata
        bridge._script.close()


# -- a script by hand ------------------------------------------------------------------------------


@contextlib.contextmanager
def listening_script() -> Iterator[UDPScript]:
    """A script that listens before a bridge looks for it, so that the bridge asks it once.

    One that asked again would discard an answer that came late, on a busy machine.
    """
    with pytest.MonkeyPatch.context() as patch, udp_script() as script:
        patch.setattr("ai4u_edu.remote.bridge.CONNECT_INTERVAL_S", LIMIT_S)
        yield script


@contextlib.contextmanager
def by_hand(url: str, **options: Any) -> Iterator[tuple[UDPScript, list[str]]]:
    """A script that says what a test says, and its bridge."""
    with listening_script() as script, bridged(url, port=script.port, **options) as (_, told):
        yield script, told


def begin(script: UDPScript) -> dict[str, Any]:
    """Goes through the beginning; the first state after the reset."""
    for expected, reply in (
        ("wait_command", NOOP),
        ("config", "max_steps;1;0@id;1;0"),
        ("wait_command", RESET),
    ):
        heard(script, expected)
        script.say(reply)
    return heard(script, "steps")


def heard(script: UDPScript, expected: str) -> dict[str, Any]:
    """Return the next request."""
    request = script.hear()
    assert expected in request, request
    return request


def test_a_script_that_asks_for_time_gets_it() -> None:
    assert 1000 * KEEPALIVE_INTERVAL_S < MIN_RECEIVE_TIMEOUT_MS  # often enough for any world
    with log_room() as room, by_hand(room.url) as (script, _):
        state = begin(script)
        brain = room.sim.agents[0].brain
        assert isinstance(brain, RemoteBrain)
        asked_at: set[float] = set()  # when the world heard that its script wants time
        deadline = Deadline()
        while len(asked_at - {0.0}) < 3:
            deadline.left()
            script.say(WAIT)
            again = script.hear()
            assert again["place"].tolist() == state["place"].tolist()
            asked_at.add(brain._link.time_asked_at)  # type: ignore[union-attr]
        script.say("log;1;7")
        assert script.hear()["steps"] == 1
        assert (brain.status().missing, brain.status().decisions) == (0, 1)
        assert log_of(room)[-1] == (state["place"][0], 0, 7.0)


@pytest.mark.parametrize(
    ("reply", "complaint"),
    [
        ("log;1;nan", "action 'log': expected 1 finite number, got [nan]"),
        ("log;2;1;2", "action 'log': expected 1 finite number, got [1.0, 2.0]"),
        ("log;1;fast", "action: expected a number, got 'fast'"),
        ("lgo;1;1", "no actuator is called 'lgo'; did you mean 'log'?"),
    ],
)
def test_an_action_that_can_not_be_is_told_and_nothing_is_done(reply: str, complaint: str) -> None:
    with log_room() as room, by_hand(room.url) as (script, told):
        begin(script)
        before = len(log_of(room))
        script.say(reply)
        assert script.hear()["steps"] == 1
        assert told[-1] == f"{complaint}; the agent does nothing in this decision"
        script.say("log;1;3")
        assert script.hear()["steps"] == 2
        assert [number for _, _, number in log_of(room)[before:]] == [3.0]


def test_the_agent_is_the_scripts_only_while_there_is_one() -> None:
    with log_room(time_scale=1.0) as room:
        agent = room.sim.agents[0]
        own = agent.brain
        with by_hand(room.url) as (script, told):
            for _ in range(2):
                begin(script)
                assert isinstance(agent.brain, RemoteBrain)
                script.say("halt")
                until(lambda: agent.brain is own)
        drives = "an AI4U script drives agent 'a' of 'A room'"
        ended = "the AI4U script has ended; start another one, or end me with Ctrl-C"
        assert [each for each in told if each in (drives, ended)] == [drives, ended] * 2


def test_bridge_gets_the_agent_back_after_a_lost_farewell() -> None:
    with log_room() as room:
        bridge = Bridge(room.url, port=free_port())
        first, _ = bridge._connect()
        second, robot = bridge._connect()  # the world thinks that the first one is still there
        assert second.run(robot.sense())["id"] == "a"
        second.run(robot.end())
        for line in (first, second):
            line._close()
        bridge._script.close()


def test_a_lost_connection_is_a_delay_and_no_more() -> None:
    with (
        log_room() as room,
        FaultyProxy(room.url, Faults(reset=0.1), seed=3) as proxy,
        by_hand(proxy.url) as (script, _),
    ):
        begin(script)
        before = len(log_of(room))
        deadline = Deadline()
        for number in itertools.count(1):
            deadline.left()
            script.say(f"log;1;{number}")
            assert script.hear()["steps"] == number
            if number >= 30 and proxy.happened["reset"] >= 3:
                break
        assert [sent for _, _, sent in log_of(room)[before:]] == list(range(1, number + 1))


# -- what goes wrong -------------------------------------------------------------------------------


def test_a_script_that_is_not_there_yet() -> None:
    with log_room() as room:
        port = free_port()
        with bridged(room.url, port=port) as (_, told):
            until(lambda: told)
            assert told == [f"no AI4U script listens at 127.0.0.1:{port} yet; start it"]


def test_a_script_that_falls_silent() -> None:
    with log_room() as room, listening_script() as script:
        own = room.sim.agents[0].brain
        told: list[str] = []
        bridge = Bridge(room.url, port=script.port, patience=LIMIT_S, tell=told.append)
        thread = threading.Thread(target=bridge.run, daemon=True)
        thread.start()
        begin(script)
        bridge._script.patience = 0.3  # from the next request on, which gets no answer
        script.say(WAIT)
        until(lambda: any("gone" in each for each in told))
        assert told[-1] == (
            f"the AI4U script at 127.0.0.1:{script.port} is gone (no answer for 0.3 s); start it "
            "again"
        )
        until(lambda: room.sim.agents[0].brain is own)
        bridge.stop()
        thread.join(LIMIT_S)
        assert not thread.is_alive()


def test_whoever_ends_the_bridge_waits_for_no_script() -> None:
    with log_room() as room, listening_script() as script:
        bridge = Bridge(room.url, port=script.port, patience=2 * LIMIT_S)
        thread = threading.Thread(target=bridge.run, daemon=True)
        thread.start()
        begin(script)  # and it does not answer what it is told
        bridge.stop()
        assert "__stop__" in script.hear()
        thread.join(LIMIT_S)
        assert not thread.is_alive()


def test_no_world_is_there() -> None:
    with (
        unused_address() as address,
        pytest.raises(LostError, match="is it running, and is the address right"),
    ):
        Bridge(f"ws://{address}", port=free_port(), patience=0)


def test_a_world_that_ends() -> None:
    with listening_script() as script:
        # real time: for as long the bridge tries to reach a world that has ended
        with log_room(grace=0.3) as room:
            bridge = Bridge(room.url, port=script.port, patience=LIMIT_S)
            told: list[str] = []

            def drive() -> None:
                try:
                    bridge.run()
                except LostError as error:
                    told.append(str(error))

            thread = threading.Thread(target=drive)
            thread.start()
            begin(script)
            bridge._robot._patience = 0.3
        script.say("log;1;1")
        assert "__stop__" in script.hear()
        script.say("halt")
        thread.join(LIMIT_S)
        assert "expected connect" in told[-1] or "ended the session" in told[-1]


def test_an_agent_that_is_taken_and_one_that_is_not_there() -> None:
    with log_room(2) as room, connect(room.url, "a"):
        with pytest.raises(RefusedError, match="agent 'a' is driven by another script; free are"):
            Bridge(room.url, "a", port=free_port(), patience=0)
        with pytest.raises(RefusedError, match="no agent has the id 'red'; known are 'a', 'b'"):
            Bridge(room.url, "red", port=free_port())


def test_a_bad_token() -> None:
    with scene_room() as room:
        with pytest.raises(RefusedError, match="expected this world's token, got another one"):
            Bridge(room.url, port=free_port(), token="guessed")
        with pytest.raises(RefusedError, match="expected this world's token, got none"):
            Bridge(room.url, port=free_port())
        Bridge(f"{room.url}?token={TOKEN.replace(' ', '%20')}", port=free_port())._script.close()
        assert OPTIONS["token"] == TOKEN


def test_a_bridge_can_be_stopped_while_it_waits_for_a_world_that_stands_still() -> None:
    with log_room() as room, listening_script() as script:
        bridge = Bridge(room.url, port=script.port, patience=LIMIT_S, tell=lambda _: None)
        thread = threading.Thread(target=bridge.run, daemon=True)
        thread.start()
        begin(script)
        room.runner.pause().result(LIMIT_S)
        script.say("log;1;7")
        until(lambda: len(room.sim.agents[0].brain._link.exchange) == 1)  # type: ignore[attr-defined]
        bridge.stop()
        thread.join(LIMIT_S)
        assert not thread.is_alive()
