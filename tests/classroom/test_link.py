"""Links to a real class: who gets one, forged and repeated messages, and their end."""

from collections.abc import Iterator
from contextlib import suppress

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Origin

from ai4u_edu.wire.class_link import (
    MAX_FRAME_BYTES,
    VERSION,
    Ack,
    Assignment,
    Attention,
    Drawing,
    DrawnShape,
    LinkHello,
    LinkProblem,
    LinkWelcome,
    People,
    Poses,
    encode_from_room,
)
from tests.classroom.link_client import RawLink, TeacherSocket, check, state
from tests.classroom.served_class import ServedClass, served_class
from tests.page.server.rooms import open_socket
from tests.waiting import until

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


def number_of(served: ServedClass) -> int:
    return max(int(each["number"]) for each in served.state()["seats"])


def test_a_seat_gets_a_link_and_the_present_state(served: ServedClass) -> None:
    ada = served.joined()
    (name,) = [
        seat["name"] for seat in served.state()["seats"] if seat["number"] == number_of(served)
    ]
    with RawLink(served, ada) as link:
        welcome = link.next(LinkWelcome)
        assert (welcome.version, welcome.name) == (VERSION, name)
        people = link.next(People, lambda message: message.people[0].is_here)
        assert [each.name for each in people.people] == [name]
        kinds = {type(each) for each in link.received}
        assert {LinkWelcome, Assignment, Attention, People} <= kinds


def test_the_wall_shows_what_a_link_tells(served: ServedClass) -> None:
    ada = served.joined()
    room = f"seat-{number_of(served)}"
    with RawLink(served, ada) as link, TeacherSocket(served) as teacher:
        link.send(state(status="fell", falls=6))
        link.send(Drawing(3, (0, 0, 4, 3), (), ()))
        link.send(Poses(3, (1, 2, 0.5, 1)))
        seen = teacher.next("class", lambda e: any(r["status"] == "fell" for r in e["rooms"]))
        told = next(each for each in seen["rooms"] if each["id"] == room)
        assert (told["status"], told["kind"], told["why"]) == ("fell", "remote", "fell 6 times")
        assert seen["rooms"][0] == told  # whoever needs help comes first
        drawing = teacher.next("drawing", lambda e: e["room"] == room)
        assert (drawing["number"], drawing["bounds"]) == (3, [0, 0, 4, 3])
        poses = teacher.next("poses", lambda e: room in e["rooms"])
        assert poses["rooms"][room] == {"drawing": 3, "values": [1, 2, 0.5, 1]}
        link.send(Poses(3, (1.25, 2, 0.5, 1)))
        poses = teacher.next("poses", lambda e: room in e["rooms"])
        assert poses["rooms"][room]["values"][0] == 1.25


def test_a_wrong_secret_gets_no_link(served: ServedClass) -> None:
    for secret in ("", "x" * 32, served.token):
        with RawLink(served, secret) as link:
            code, problem = link.end()
            assert code == 1008
            assert problem is not None
            assert problem.code == "secret"


def test_another_version_is_told(served: ServedClass) -> None:
    with RawLink(served, "", hello=LinkHello(VERSION + 1, "x", "room")) as link:
        _, problem = link.end()
        assert problem is not None
        assert problem.code == "version"
        assert str(VERSION) in problem.text


def test_link_ends_if_the_first_message_is_not_hello(served: ServedClass) -> None:
    with RawLink(served, "", hello=state()) as link:
        code, problem = link.end()
        assert (code, problem and problem.code) == (1008, "message")


def test_malformed_messages_are_told_and_too_many_end_the_link(served: ServedClass) -> None:
    ada = served.joined()
    with RawLink(served, ada) as link:
        link.next(LinkWelcome)
        forged: list[bytes | str] = [b"\xc1", b"\x93\xa4work", "text", b"\x91\xa7welcome"]
        for each in forged:
            link.socket.send(each)
            assert "expected" in link.next(LinkProblem).text
        link.send(check("right"))
        link.next(Ack)  # the link lives, and the count begins again
        for _ in range(5):
            link.send(LinkHello(VERSION, "x", "room"))
        assert link.end()[0] == 1008


def test_a_message_that_is_too_large_ends_the_link(served: ServedClass) -> None:
    ada = served.joined()
    with RawLink(served, ada) as link:
        link.next(LinkWelcome)
        with suppress(ConnectionClosed):  # it may be closed while that is sent
            link.socket.send(b"\xc4" * (MAX_FRAME_BYTES + 1))
        with pytest.raises(ConnectionClosed):
            link.receive_all()


def test_a_drawing_that_is_too_large_for_the_wall_is_refused(served: ServedClass) -> None:
    shape = DrawnShape("#ffffff", 0.0, (0.5,) * 1000)
    with RawLink(served, served.joined()) as link:
        link.send(Drawing(1, (0, 0, 1, 1), (shape,) * 40, ()))
        assert "bytes" in link.next(LinkProblem).text
        link.send(check("right"))
        link.next(Ack)


def test_a_result_is_acknowledged_each_time_and_counts_once(served: ServedClass) -> None:
    ada = served.joined()
    number = str(number_of(served))
    wrong = check("wrong", "04.2/narrow")
    for _ in range(2):
        with RawLink(served, ada) as link:
            link.next(LinkWelcome)
            link.send(wrong)
            link.send(wrong)
            assert link.next(Ack).key == link.next(Ack).key == wrong.key
    told = served.state()["progress"][number]
    assert told["04.2"]["tries"] == 1


def test_an_exercise_that_does_not_exist_is_refused_for_good(served: ServedClass) -> None:
    with RawLink(served, served.joined()) as link:
        forged = check("right", exercise="<b>99</b>")
        link.send(forged)
        assert "no exercise" in link.next(LinkProblem).text
        assert link.next(Ack).key == forged.key
    assert "<b>" not in str(served.state()["progress"])


def test_the_second_link_of_a_seat_takes_the_place_of_the_first(served: ServedClass) -> None:
    ada = served.joined()
    with RawLink(served, ada) as first, RawLink(served, ada) as second:
        code, problem = first.end()
        assert (code, problem and problem.code) == (1008, "over")
        second.send(check("right"))
        second.next(Ack)


def test_whoever_is_sent_out_loses_the_link_at_once(served: ServedClass) -> None:
    ada = served.joined()
    with RawLink(served, ada) as link:
        link.next(LinkWelcome)
        assert served.command("kick", seat=number_of(served)).status_code == 200
        code, problem = link.end()
        assert (code, problem and problem.code) == (1008, "over")
    with RawLink(served, ada) as link:
        assert link.end()[1] == LinkProblem(
            "secret", "This place in the class is not yours any more. Join again."
        )


def test_no_page_of_another_site_gets_a_link(served: ServedClass) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        open_socket(f"{served.url}link", origin=Origin("http://evil.example"))


def test_a_flood_is_throttled_and_loses_nothing(served: ServedClass) -> None:
    ada = served.joined()
    results = [check("wrong", "04.2/narrow") for _ in range(120)]
    with RawLink(served, ada) as link:
        for each in results:
            link.socket.send(encode_from_room(each))
        acknowledged = {link.next(Ack).key for _ in results}
        assert acknowledged == {each.key for each in results}


def test_a_world_of_ones_own_starts_no_process_here(served: ServedClass) -> None:
    ada = served.joined()
    with RawLink(served, ada) as link:
        link.send(state())
        own, here = f"seat-{number_of(served)}", ada.room.split("/")[2]
        # the own one is there with the link, and takes the other's place with its first state
        until(lambda: {own, here} & {each["id"] for each in served.state()["rooms"]} == {own})
