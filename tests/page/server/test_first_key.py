"""Pages start, repeat and lock episodes; everything that tells the state says what it waits for."""

import json
import urllib.request
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu import ControlRequestor, WASDRBMoveController
from tests.builders import small_sim
from tests.page.server.rooms import Page, Room, served
from tests.waiting import LIMIT_S, until


def get(room: Room, path: str) -> dict[str, Any]:
    with urllib.request.urlopen(room.url + path, timeout=LIMIT_S) as answer:  # noqa: S310  # our own
        found: dict[str, Any] = json.load(answer)
        return found


@pytest.fixture
def room() -> Iterator[Room]:
    with served(wait_for_key=True) as room:
        yield room


def waits(room: Room) -> bool:
    latest = room.runner.latest
    return latest.tick == 0 and latest.waiting == "key"


def settle(page: Page, room: Room) -> None:
    """Wait until all that a page has sent was carried out."""
    page.settle()
    room.runner.submit(lambda: None).result(LIMIT_S)


def runs(room: Room) -> bool:
    return room.runner.latest.tick > 0


def test_all_say_that_it_waits_and_a_key_starts_and_drives(room: Room) -> None:
    with room.page() as page:
        assert page.receive("state", waiting="key")["paused"] is False
        assert get(room, "api/snapshot")["waiting"] == "key"
        assert (get(room, "healthz")["waiting"], get(room, "healthz")["status"]) == ("key", "ok")
        page.hold("KeyW")
        page.receive("state", waiting="")
        until(lambda: runs(room))
        assert get(room, "healthz")["waiting"] == ""


def test_the_first_decision_has_the_key_that_started(room: Room) -> None:
    moves: list[float] = []
    room.sim.agents[0].end_of_step.connect(lambda agent: moves.append(agent.last_action["move"][0]))
    with room.page() as page:
        page.hold("KeyW")
        until(lambda: moves)
        assert moves[0] == 1


@pytest.mark.parametrize("start", ["stick", "unknown key"])
def test_a_stick_starts_and_so_does_a_key_that_drives_nothing(room: Room, start: str) -> None:
    with room.page() as page:
        number = page.receive("hello")["you"]
        if start == "stick":
            page.send("keys", held=[], stick={"forward": 0.5})
        else:
            page.send("start")
        until(lambda: runs(room))
        page.receive("seat", driver=number)


def test_keys_held_since_before_a_reset_do_not_start_the_world(room: Room) -> None:
    with room.page() as page:
        page.hold("KeyW")
        until(lambda: runs(room))
        page.hold("KeyW", "KeyR")
        until(lambda: waits(room))
        for _ in range(3):
            page.hold("KeyW", "KeyR")
        page.hold("KeyW")
        settle(page, room)
        assert waits(room)
        page.hold("KeyW", "KeyD")
        until(lambda: runs(room))


def test_a_page_without_control_does_not_start_the_world(room: Room) -> None:
    episode = room.runner.latest.episode
    with room.page() as driver, room.page() as other:
        driver.send("take")
        other.receive("seat", driver=driver.receive("hello")["you"])
        other.hold("KeyW")
        other.send("start")
        other.hold("KeyR")
        settle(other, room)
        assert waits(room)
        assert room.runner.latest.episode == episode
        driver.hold("KeyW")
        until(lambda: runs(room))


def reset_by(page: Page, room: Room, command: str, **arguments: Any) -> int:
    """Return the seed after a command that begins an episode."""
    episode = room.runner.latest.episode
    page.do(command, **arguments)
    until(lambda: room.runner.latest.episode == episode + 1)
    return room.runner.latest.seed


def test_r_and_try_again_repeat_the_start_and_a_new_one_is_drawn_when_asked(room: Room) -> None:
    first = room.runner.latest.episode
    with room.page() as page:
        for episode in (first + 1, first + 2):
            page.hold("KeyR")
            until(lambda episode=episode: room.runner.latest.episode == episode)  # type: ignore[misc]
            page.hold()
            assert room.runner.latest.seed == 1
        until(lambda: waits(room))
        assert reset_by(page, room, "try_again") == 1
        new = reset_by(page, room, "new_start")
        assert new != 1
        page.do("lock_seed", on=True)
        page.receive("state", seed_locked=True)
        assert reset_by(page, room, "reset") == new
        page.do("lock_seed", on=False)
        page.receive("state", seed_locked=False)
        assert reset_by(page, room, "reset") != new
        assert reset_by(page, room, "seed", seed="9") == 9
        assert get(room, "api/snapshot")["seed_locked"] is False


def test_r_works_after_an_error(room: Room) -> None:
    agent = room.sim.agents[0]

    def broken(_: object) -> None:
        raise RuntimeError("it broke")

    agent.end_of_step.connect(broken)
    with room.page() as page:
        page.hold("KeyW")
        until(lambda: room.runner.latest.error)
        agent.end_of_step.disconnect(broken)
        page.hold("KeyR")
        until(lambda: waits(room))
        assert room.runner.latest.seed == 1


def test_a_world_without_a_person_does_not_wait() -> None:
    sim: ControlRequestor = small_sim()
    with served(sim, wait_for_key=True) as room:
        until(lambda: runs(room))
    with served(small_sim(controller=WASDRBMoveController())) as room:
        until(lambda: runs(room))
