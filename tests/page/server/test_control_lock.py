"""The control lock, over real sockets and with a running world."""

import socket
from collections.abc import Iterator

import pytest
from pydantic import Field

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    Controller,
    ControlRequestor,
    LocalBrain,
    Percept,
    WASDRBMoveController,
    World,
)
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.keyboard import KEY_TIMEOUT_S
from tests.builders import small_sim, still
from tests.page.server.rooms import Clock, Room, served
from tests.waiting import LIMIT_S, until


@pytest.fixture
def room() -> Iterator[Room]:
    with served() as room:
        yield room


def test_a_page_is_told_who_it_is_and_which_keys_drive(room: Room) -> None:
    with room.page() as page:
        hello = page.receive("hello")
        assert hello["you"] == 1
        assert hello["agent"] == "0"
        assert hello["brain"] == "LocalBrain(WASDRBMoveController)"
        assert hello["keys"]["forward"] == ["KeyW", "ArrowUp"]
        assert set(hello["keys"]) == {
            *("forward", "backward", "left", "right", "jump", "jump_forward", "restart")
        }
        assert page.receive("seat") == {"type": "seat", "driver": None, "pages": 1}
        state = page.receive("state")
        assert not state["paused"]
        assert not state["terminated"]
        assert state["error"] == ""


def test_who_presses_first_drives_and_nobody_else(room: Room) -> None:
    with room.page() as first, room.page() as second:
        second.hold("KeyW")
        until(lambda: room.held == ["KeyW"])
        driver = second.receive("seat", pages=2, driver=second.receive("hello")["you"])["driver"]
        first.hold("KeyS")
        first.receive("seat", driver=driver)
        first.settle()
        assert room.held == ["KeyW"]
        second.hold("KeyW", "KeyD")
        until(lambda: room.held == ["KeyD", "KeyW"])
        first.hold()
        first.settle()
        assert room.held == ["KeyD", "KeyW"]
        second.hold("KeyW")
        until(lambda: room.held == ["KeyW"])


def test_empty_key_list_does_not_take_control(room: Room) -> None:
    with room.page() as page, room.page() as other:
        page.hold()
        page.settle()
        other.hold("KeyW")  # it would be ignored if the lock were not free
        other.receive("seat", driver=2)
        assert room.held == ["KeyW"]


def test_the_seat_can_be_taken_and_the_old_drivers_keys_are_let_go(room: Room) -> None:
    with room.page() as old, room.page() as new:
        old.hold("KeyW")
        until(lambda: room.held == ["KeyW"])
        new.send("take")
        seat = old.receive("seat", driver=new.receive("hello")["you"])
        assert seat["pages"] == 2
        until(lambda: room.held == [])
        old.hold("KeyW")
        old.settle()
        assert room.held == []
        new.hold("KeyA")
        until(lambda: room.held == ["KeyA"])


def test_a_page_that_goes_lets_go_and_frees_control(room: Room) -> None:
    with room.page() as staying:
        with room.page() as going:
            going.hold("KeyW")
            staying.receive("seat", driver=2, pages=2)
            assert room.held == ["KeyW"]
        until(lambda: room.held == [])
        staying.receive("seat", driver=None, pages=1)
        staying.hold("KeyD")
        until(lambda: room.held == ["KeyD"])


def test_a_page_that_is_cut_off_releases_control_too(room: Room) -> None:
    with room.page() as page, room.page() as other:
        page.hold("KeyW")
        other.receive("seat", driver=1)
        page.socket.socket.shutdown(socket.SHUT_RDWR)
        other.receive("seat", driver=None, pages=1)
        until(lambda: room.held == [])


def test_a_silent_page_keeps_the_lock_but_not_its_keys() -> None:
    clock = Clock()
    with served(key_clock=clock) as room, room.page() as page, room.page() as other:
        page.hold("KeyW")
        until(lambda: room.held == ["KeyW"])
        clock.now += KEY_TIMEOUT_S
        assert room.held == ["KeyW"]
        clock.now += 0.01
        assert room.held == []
        other.hold("KeyS")
        other.settle()
        assert room.held == []
        page.hold("KeyD")
        until(lambda: room.held == ["KeyD"])


def test_the_world_tells_which_keys_it_sees(room: Room) -> None:
    with room.page() as driver, room.page() as watcher:
        driver.hold("KeyW", "KeyA")
        watcher.receive("state", held=["KeyA", "KeyW"])


def test_a_tap_that_is_over_before_the_next_decision_counts() -> None:
    with served() as room:
        room.runner.pause().result(LIMIT_S)
        with room.page() as page:
            page.hold("KeyW")
            page.hold()
            page.settle()
            room.runner.step().result(LIMIT_S)
            assert room.move[0] == 1.0


def test_pause_resume_and_reset(room: Room) -> None:
    with room.page() as page:
        page.hold("KeyW")
        page.do("pause")
        page.receive("state", paused=True)
        until(lambda: room.held == [])
        episode = room.runner.latest.episode
        page.do("seed", seed="7")
        page.receive("state", episode=episode + 1)
        assert room.runner.latest.seed == 7
        page.do("resume")
        page.receive("state", paused=False)


def test_a_reset_that_fails_says_so_and_keys_go_on(room: Room) -> None:
    def broken(_: BasicAgent) -> None:
        raise RuntimeError("this block can't be reset")

    room.sim.agents[0].before_the_reset.connect(broken)
    with room.page() as page:
        page.do("reset")
        assert page.receive("error")["text"] == "RuntimeError: this block can't be reset"
        page.hold("KeyW")
        until(lambda: room.held == ["KeyW"])


def test_an_error_in_the_world_reaches_the_page_and_a_reset_clears_it(room: Room) -> None:
    def broken(_: BasicAgent) -> None:
        raise RuntimeError("odd")

    event = room.sim.agents[0].end_of_step
    event.connect(broken)
    with room.page() as page:
        told = "RuntimeError: odd (while handler broken of end_of_step of agent '0' was called)"
        page.receive("state", error=told)
        event.disconnect(broken)
        page.do("reset")
        page.receive("state", error="")


def test_the_end_of_an_episode_is_told(room: Room) -> None:
    with room.page() as page:
        page.receive("state", terminated=False)
        agent = room.sim.agents[0]
        room.runner.submit(lambda: agent.add_reward(100, request_done=True, name="goal"))
        state = page.receive("state", terminated=True)
        assert state["reward"] == 100
        assert state["terms"] == {"goal": 100}
        assert not state["fallen"]


def two_agents() -> ControlRequestor:
    world = World()
    agents = []
    brains = (
        LocalBrain(controller=still),
        LocalBrain(controller=WASDRBMoveController(forward=["KeyI"])),
    )
    for index, brain in enumerate(brains):
        world.add_body(f"robot {index}", CircleShape(radius=0.5), position=(3 * index, 0))
        agents.append(BasicAgent(body=f"robot {index}", id=f"agent {index}", brains=[brain]))
    return ControlRequestor(world, agents)


def test_each_agent_has_its_own_lock_and_keys() -> None:
    with served(two_agents()) as room:
        still_agent, driven = (agent.keyboard for agent in room.sim.agents)
        with room.page() as page, room.page("?agent=agent%200") as other:
            assert page.receive("hello")["agent"] == "agent 1"
            assert page.last["hello"]["keys"]["forward"] == ["KeyI"]
            assert other.receive("hello")["keys"] == {}
            other.receive("seat", pages=1)
            other.hold("KeyX")
            until(lambda: still_agent.held() == {"KeyX"})
            assert driven.held() == set()


def test_an_unknown_agent_is_refused_with_the_known_ones(room: Room) -> None:
    with room.page("?agent=7") as page:
        assert page.receive("error")["text"] == "no agent has the id '7'; known are '0'"
        assert page.end() == (1008, "there is no such agent")


def test_another_brain_is_told_to_the_page(room: Room) -> None:
    with room.page() as page:
        page.receive("hello", brain="LocalBrain(WASDRBMoveController)")
        brain = LocalBrain(controller=WASDRBMoveController(forward=["KeyZ"]))
        agent = room.sim.agents[0]
        room.runner.submit(lambda: agent.use_brain(brain)).result(LIMIT_S)
        keys = page.receive("hello")["keys"]
        assert keys["forward"] == ["KeyZ"]


def test_any_controller_that_declares_keys_tells_them() -> None:
    class Crane(Controller):
        """Lifts while a key is held."""

        lift: list[str] = Field(default_factory=lambda: ["KeyL"])
        none: list[str] = Field(default_factory=list)
        bodies: list[str] = Field(default_factory=lambda: ["box"])
        switches: dict[str, list[str]] = Field(default_factory=lambda: {"grab": ["KeyG", "Space"]})
        extra: list[list[str]] = Field(default_factory=lambda: [["Digit1"], ["Digit2"]])

        def get_action(self, percept: Percept) -> Answer:
            return {}

    sim = small_sim(controller=Crane())
    assert keys_of(sim.agents[0]) == {
        "lift": ["KeyL"],
        "grab": ["KeyG", "Space"],
        "extra 1": ["Digit1"],
        "extra 2": ["Digit2"],
    }
