"""The input socket: worlds that are replaced, sticks, and pages that stop reading."""

import asyncio
import gc
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    WASDRBMoveController,
    World,
)
from ai4u_edu.blocks.keyboard import KEY_TIMEOUT_S, Stick
from tests.builders import small_sim
from tests.page.server import http_client
from tests.page.server.rooms import Clock, Room, served
from tests.waiting import LIMIT_S, until


def spin(_percept: Any) -> dict[str, Any]:
    return {"move": [0, 0.5, 0, 0]}


@pytest.fixture
def room() -> Iterator[Room]:
    with served(small_sim(controller=spin)) as room:
        yield room


def brain_of(room: Room) -> str:
    return room.sim.agents[0].brain.title()


def another(*ids: str) -> ControlRequestor:
    world = World()
    agents = []
    for number, agent_id in enumerate(ids):
        world.add_body(f"body {agent_id}", CircleShape(radius=0.5), position=(3 * number, 0))
        agents.append(
            BasicAgent(
                body=f"body {agent_id}",
                id=agent_id,
                actuators=[RBMoveActuator(move_amount=2)],
                brains=[LocalBrain(controller=WASDRBMoveController(), skip_frame=0)],
            )
        )
    return ControlRequestor(world, agents)


def test_another_world_sends_pages_away_and_has_them_back() -> None:
    with served() as room:
        old, new = room.sim.agents[0], another("first", "0")
        with room.page() as page:
            page.hold("KeyW")
            until(lambda: room.held == ["KeyW"])
            room.runner.replace_sim(new).result(LIMIT_S)
            assert page.end() == (1012, "another world")
        with room.page("?after_another&agent=0") as page:
            assert page.receive("hello")["agent"] == "0"
            page.hold("KeyW")
            until(lambda: new.agent("0").keyboard.held() == {"KeyW"})
            assert old.keyboard.held() == set()
            page.receive("state", held=["KeyW"])
        with room.page("?after_another&agent=gone") as page:
            assert page.receive("hello")["agent"] == "first"


def test_an_agent_of_the_old_world_is_not_given_back(room: Room) -> None:
    agent = room.sim.agents[0]
    with room.page() as page:
        page.hold("KeyW")
        page.receive("hello", others="")
        ours = agent.brain
        room.runner.replace_sim(another("0")).result(LIMIT_S)
        assert page.end()[0] == 1012
    http_client.get(room.url)  # the same event loop answers it after it has released the lock
    room.runner.submit(lambda: None).result(LIMIT_S)
    assert agent.brain is ours


# -- a stick -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("stick", "told"),
    [
        ({"forward": 1.5}, "stick.forward: expected float <= 1.0"),
        ({"turn": -1.01}, "stick.turn: expected float >= -1.0"),
        ({"forward": "1"}, "stick.forward: expected float, got str"),
        ({"up": 1}, "up"),
    ],
)
def test_a_stick_can_be_pushed_to_its_rim_and_no_further(
    room: Room, stick: dict[str, Any], told: str
) -> None:
    with room.page() as page:
        page.send("keys", held=[], stick=stick)
        assert told in page.receive("error")["text"]


def test_a_stick_is_finite(room: Room) -> None:
    with room.page() as page:
        page.socket.send('{"type": "keys", "held": [], "stick": {"forward": NaN}}')
        assert "expected JSON" in page.receive("error")["text"]


def test_a_stick_rests_when_its_page_falls_silent() -> None:
    clock = Clock()
    with served(small_sim(controller=spin), key_clock=clock) as room, room.page() as page:
        keyboard = room.sim.agents[0].keyboard
        page.send("keys", held=[], stick={"forward": 0.5})
        until(lambda: keyboard.stick() == Stick(0.5, 0))
        clock.now += KEY_TIMEOUT_S
        assert keyboard.stick() == Stick(0.5, 0)
        clock.now += 0.01
        assert keyboard.stick() == Stick(0, 0)


# -- a page that stops reading -------------------------------------------------------------------


def deaf_from_the_third_word_on(app: ASGIApp) -> ASGIApp:
    """Whoever asks for agent "0" by name takes two frames, and then no more."""

    async def wrapped(scope: Scope, receive: Receive, send: Send) -> None:
        taken = 0

        async def stuck(message: Message) -> None:
            nonlocal taken
            taken += message["type"] == "websocket.send"
            if taken > 2:
                await asyncio.Event().wait()
            await send(message)

        is_deaf = scope.get("query_string") == b"agent=0"
        await app(scope, receive, stuck if is_deaf else send)

    return wrapped


def test_a_page_that_stops_reading_slows_nobody() -> None:
    with served(wrap=deaf_from_the_third_word_on) as room, room.page() as other:
        with room.page("?agent=0") as deaf:
            deaf.receive("seat")
            deaf.hold("KeyW")
            other.receive("seat", pages=2, driver=2)
            until(lambda: room.held == ["KeyW"])  # it speaks all the same
            other.receive("state", held=["KeyW"])
            before = room.runner.latest.tick
            until(lambda: room.runner.latest.tick > before + 30)
            other.send("take")
            other.hold("KeyS")
            other.receive("state", held=["KeyS"])
        other.receive("seat", pages=1)


def test_a_reset_that_fails_after_its_page_has_left_writes_no_traceback(
    room: Room, caplog: pytest.LogCaptureFixture
) -> None:
    begins, goes_on = threading.Event(), threading.Event()

    def fail(_: BasicAgent) -> None:
        begins.set()
        assert goes_on.wait(LIMIT_S)
        raise ValueError("of a student's block")

    with room.page() as other:
        with room.page() as page:
            other.receive("seat", pages=2)
            room.sim.agents[0].begin_of_episode.connect(fail)
            page.send("do", id=0, command="reset")
            assert begins.wait(LIMIT_S)
        other.receive("seat", pages=1)
        goes_on.set()
        with pytest.raises(ValueError, match="of a student's block"):
            room.runner.reset().result(LIMIT_S)
        other.settle()
        gc.collect()
        other.settle()
    assert "never retrieved" not in caplog.text
