"""The teacher's pause: it holds the world whatever happens, and ends when it should."""

from ai4u_edu import Scene
from ai4u_edu.member.member import MAX_UNLINKED_HOLD_S, REST_AFTER_S
from ai4u_edu.wire.class_link import Attention, LinkProblem, LinkWelcome, People, Person, State
from tests.member.fake_link import Joined, joined
from tests.waiting import LIMIT_S, until

END = Attention("", "", 0.0)
ADA = Person(3, "Red Fox", "#d55e00", True)
BEN = Person(4, "Blue <b>Owl</b>", "#0072b2", False)


def is_held(room: Joined) -> bool:
    return room.runner.latest.waiting == "teacher"


def stands_still(room: Joined) -> bool:
    """Return True if the world does not tick while the pages ask for it."""
    ticks = room.runner.latest.tick
    room.runner.resume().result(LIMIT_S)
    room.runner.start_episode().result(LIMIT_S)
    seen = room.runner.latest
    until(lambda: room.runner.latest is not seen)
    return room.runner.latest.tick == ticks


def test_pause_and_blank_hold_until_the_teacher_ends_them() -> None:
    with joined() as room:
        for kind in ("pause", "blank"):
            room.link.sent.clear()
            room.tell(Attention(kind, "Look here", 0.0))
            until(lambda: is_held(room))
            assert stands_still(room)
            room.state(status="paused")
            event = room.member.view.event("student", 0)
            assert event is not None
            assert event["attention"] == {"kind": kind, "message": "Look here", "ends_in": 0.0}
            room.link.sent.clear()
            room.tell(END)
            until(lambda: not is_held(room))
            room.next(State, lambda state: state.status != "paused")  # the next pause is new to it


def test_a_message_alone_stops_nothing() -> None:
    with joined() as room:
        room.tell(Attention("", "Five minutes left", 20.0))
        tick = room.runner.latest.tick
        until(lambda: room.runner.latest.tick > tick)
        room.clock.now += 20
        until(lambda: attention(room) == {"kind": "", "message": "", "ends_in": 0.0})


def attention(room: Joined) -> object:
    event = room.member.view.event("student", 0)
    return event and event["attention"]


def test_it_holds_without_a_link_and_ends_at_its_time() -> None:
    with joined() as room:
        room.tell(Attention("blank", "Listen", 60.0))
        until(lambda: is_held(room))
        room.link.is_connected = False
        room.clock.now += 59
        room.poll()
        assert stands_still(room)
        room.editor.open(Scene.load("maze")).result(LIMIT_S)  # another world is held too
        assert stands_still(room)
        version = room.member.view.version
        room.clock.now += 1
        until(lambda: not is_held(room))
        until(lambda: attention(room) == {"kind": "", "message": "", "ends_in": 0.0})
        assert room.member.view.version > version


def test_a_world_that_nobody_visits_rests_until_somebody_comes() -> None:
    with joined() as room:
        room.tell(People((BEN,), is_visited=False))
        tick = room.runner.latest.tick
        until(lambda: room.runner.latest.tick > tick)  # a page that is reloaded stops nothing
        room.clock.now += REST_AFTER_S
        until(lambda: is_held(room))
        assert stands_still(room)
        room.tell(People((ADA,)))
        until(lambda: not is_held(room))
        room.tell(People((BEN,), is_visited=False))
        room.clock.now += REST_AFTER_S
        until(lambda: is_held(room))
        room.link.is_connected = False  # nobody would tell it who comes
        until(lambda: not is_held(room))


def test_a_class_that_never_comes_back_does_not_hold_a_world_for_ever() -> None:
    with joined() as room:
        room.tell(Attention("pause", "", 0.0))
        until(lambda: is_held(room))
        room.link.is_connected = False
        room.clock.now += MAX_UNLINKED_HOLD_S
        room.poll()
        assert stands_still(room)
        room.clock.now += 1
        until(lambda: not is_held(room))


def test_the_end_of_the_class_ends_it() -> None:
    with joined() as room:
        room.tell(Attention("pause", "", 0.0))
        until(lambda: is_held(room))
        room.tell(LinkProblem("over", "you were sent out"))
        until(lambda: not is_held(room))


def test_whoever_leaves_the_class_is_not_held() -> None:
    with joined() as room:
        room.tell(Attention("pause", "", 0.0))
        until(lambda: is_held(room))
        room.member.stop()
        until(lambda: not is_held(room))


def test_pages_are_told_who_they_are_and_who_else_is_there() -> None:
    with joined() as room:
        view = room.member.view
        assert (view.version, view.event("student", 3)) == (0, None)
        room.tell(LinkWelcome(1, "", ""), People((ADA, BEN)))
        assert view.version == 2
        event = view.event("student", 4)
        assert event is not None
        assert (event["name"], event["colour"], event["role"]) == (BEN.name, BEN.colour, "student")
        assert [each["is_here"] for each in event["people"]] == [True, False]
        teacher = view.event("teacher", 0)
        assert teacher is not None
        assert (teacher["name"], teacher["role"]) == ("", "teacher")
        room.tell(LinkWelcome(1, "Red Fox", "#d55e00"))  # on a student's own machine
        own = view.event("student", 0)
        assert own is not None
        assert own["name"] == "Red Fox"
        room.tell(People((ADA, BEN)))
        assert view.version == 3  # nothing new
