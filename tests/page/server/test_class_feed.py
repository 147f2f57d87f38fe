"""Pages of a room in a class are told of it, and keys wait while the teacher holds the world."""

from typing import Any

from ai4u_edu.page.server.class_feed import ROLE_HEADER, SEAT_HEADER
from tests.page.server.rooms import Page, served
from tests.waiting import LIMIT_S, until


class Feed:
    """A class that says who asks."""

    version = 1
    is_silent = False

    def event(self, role: str, seat: int) -> dict[str, Any] | None:
        return None if self.is_silent else {"type": "class", "role": role, "seat": seat}


def test_each_page_gets_its_own_event_at_once_and_at_each_change() -> None:
    feed = Feed()
    with served(class_feed=feed) as room:
        with room.page() as page:
            assert page.receive("class") == {"type": "class", "role": "student", "seat": 0}
            page.receive("state")
            feed.version = 2
            page.receive("class")
        from_class = {ROLE_HEADER: "teacher", SEAT_HEADER: "12"}
        with _page(room.url, from_class) as page:
            assert page.receive("class", role="teacher")["seat"] == 12
        with _page(room.url, {SEAT_HEADER: "²x"}) as page:
            assert page.receive("class")["seat"] == 0


def _page(url: str, headers: dict[str, str]) -> Page:
    return Page(url + "ws/input", additional_headers=headers)


def test_a_room_without_a_class_says_nothing_of_one() -> None:
    silent = Feed()
    silent.is_silent = True
    for feed in (None, silent):
        with served(class_feed=feed) as room, room.page() as page:
            page.receive("state")
            page.do("pause")
            page.receive("state", paused=True)
            assert "class" not in page.last


def test_keys_do_nothing_while_the_world_is_held() -> None:
    with served() as room, room.page() as page:
        page.receive("hello")
        room.runner.hold(True).result(LIMIT_S)
        with page.holding("KeyW"):
            page.receive("state", waiting="teacher")
            page.do("resume")
            page.do("try_again")
            page.receive("state", episode=3)
            assert room.held == []
            assert room.runner.latest.tick == 0
            room.runner.hold(False).result(LIMIT_S)
            until(lambda: room.held == ["KeyW"])
