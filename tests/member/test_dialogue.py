"""Dialogue of a room with its class, without a network and with a clock of the test."""

from random import Random

import pytest

from ai4u_edu.member import LinkTimeouts, ResultOutbox
from ai4u_edu.member.dialogue import (
    MAX_BACKOFF_S,
    MAX_RESULTS_IN_FLIGHT,
    MIN_BACKOFF_S,
    LinkDialogue,
    LinkPhase,
)
from ai4u_edu.wire.class_link import (
    VERSION,
    Ack,
    Attention,
    EpisodeResult,
    ExerciseResult,
    FromClass,
    FromRoom,
    LinkHello,
    LinkProblem,
    LinkWelcome,
    decode_from_room,
    encode_from_class,
)
from tests.member.messages import drawing, poses, result, state

HELLO = LinkHello(VERSION, "secret", "room")
TIMEOUTS = LinkTimeouts(welcome=7.0, ack=9.0)
WELCOME = LinkWelcome(VERSION, "Red Fox", "#d55e00")


class Talk:
    """A dialogue and a clock."""

    def __init__(self, outbox: ResultOutbox | None = None) -> None:
        self.outbox = outbox or ResultOutbox()
        self.dialogue = LinkDialogue(HELLO, self.outbox, lambda: 1.0, TIMEOUTS)
        self.now = 100.0

    def link(self) -> "Talk":
        self.greet()
        self.hear(WELCOME)
        return self

    def greet(self) -> None:
        self.dialogue.open()
        assert decode_from_room(self.dialogue.opened(self.now)) == HELLO

    def hear(self, message: FromClass) -> FromClass | None:
        return self.dialogue.receive(encode_from_class(message))

    def lose(self) -> None:
        self.dialogue.lost(self.now, "the connection was lost")

    def sent(self) -> list[FromRoom]:
        frames = []
        while (frame := self.dialogue.next_frame(self.now)) is not None:
            frames.append(decode_from_room(frame))
        return frames


def test_nothing_but_the_hello_is_sent_before_the_welcome() -> None:
    talk = Talk()
    talk.dialogue.set(state(1))
    talk.outbox.add(result(1))
    talk.greet()
    assert talk.sent() == []
    assert talk.hear(WELCOME) == WELCOME
    assert talk.sent() == [result(1), state(1)]
    assert talk.sent() == []


def test_only_the_latest_state_of_each_kind_is_sent_and_all_again_after_a_reconnect() -> None:
    talk = Talk().link()
    for number in range(3):
        talk.dialogue.set(state(number))
    talk.dialogue.set(drawing(1))
    talk.dialogue.set(poses(1, 2.0))
    assert talk.sent() == [state(2), drawing(1), poses(1, 2.0)]
    talk.dialogue.set(poses(1, 3.0))
    talk.lose()
    assert talk.sent() == []
    assert talk.link().sent() == [drawing(1), poses(1, 3.0), state(2)]


def test_states_of_a_world_that_is_gone_are_not_sent_again() -> None:
    talk = Talk().link()
    talk.dialogue.set(state(1))
    talk.sent()
    talk.dialogue.set(drawing(1))
    talk.dialogue.clear()
    talk.outbox.add(result(1))
    assert talk.sent() == [result(1)]
    talk.lose()
    assert talk.link().sent() == [result(1)]


def test_poses_of_an_older_drawing_are_not_sent() -> None:
    talk = Talk().link()
    talk.dialogue.set(drawing(1))
    talk.dialogue.set(poses(1))
    talk.dialogue.set(drawing(2))
    assert talk.sent() == [drawing(2)]


def test_the_pause_between_attempts_doubles_up_to_a_limit_and_begins_anew_after_a_welcome() -> None:
    talk = Talk()
    pauses = []
    for _ in range(7):
        talk.dialogue.open()
        talk.lose()
        pauses.append(talk.dialogue.wait_s(talk.now))
    assert pauses == [0.5, 1.0, 2.0, 4.0, 8.0, MAX_BACKOFF_S, MAX_BACKOFF_S]
    talk.link().lose()
    assert talk.dialogue.retry_at == talk.now + MIN_BACKOFF_S


def test_rooms_of_a_class_do_not_come_back_in_the_same_moment() -> None:
    times = set()
    for number in range(10):
        dialogue = LinkDialogue(HELLO, ResultOutbox(), Random(number).random)
        dialogue.open()
        dialogue.lost(0.0, "gone")
        assert MIN_BACKOFF_S / 2 <= dialogue.retry_at <= MIN_BACKOFF_S
        times.add(dialogue.retry_at)
    assert len(times) == 10


def test_a_class_that_takes_the_socket_and_says_nothing_is_overdue() -> None:
    talk = Talk()
    talk.greet()
    assert talk.dialogue.wait_s(talk.now) == TIMEOUTS.welcome
    assert not talk.dialogue.is_overdue(talk.now + TIMEOUTS.welcome - 0.1)
    assert talk.dialogue.is_overdue(talk.now + TIMEOUTS.welcome)


def test_a_result_without_acknowledgement_is_sent_again_with_the_same_key() -> None:
    talk = Talk().link()
    talk.outbox.add(result(1))
    assert talk.sent() == [result(1)]
    assert talk.dialogue.wait_s(talk.now) == TIMEOUTS.ack
    talk.now += TIMEOUTS.ack
    assert talk.sent() == [result(1)]
    talk.lose()
    assert talk.link().sent() == [result(1)]
    assert talk.hear(Ack(result(1).key)) is None
    talk.now += TIMEOUTS.ack
    assert talk.sent() == []
    assert talk.dialogue.wait_s(talk.now) is None


def test_a_few_results_are_on_their_way_at_a_time() -> None:
    talk = Talk().link()
    results = [result(number) for number in range(MAX_RESULTS_IN_FLIGHT + 2)]
    for each in results:
        talk.outbox.add(each)
    assert talk.sent() == results[:-2]
    talk.hear(Ack(results[3].key))
    assert talk.sent() == [results[-2]]
    talk.hear(Ack("unknown-key"))
    assert talk.sent() == []


@pytest.mark.parametrize("seed", range(20))
def test_every_result_arrives_once_whatever_is_lost(seed: int) -> None:
    chance = Random(seed)
    talk = Talk()
    results = [result(number) for number in range(20)]
    stored: dict[str, FromRoom] = {}
    to_come = list(results)
    for _ in range(10_000):
        talk.now += chance.uniform(0, 3)
        if to_come and chance.random() < 0.3:
            talk.outbox.add(to_come.pop(0))
        if talk.dialogue.phase is LinkPhase.WAITING and talk.now >= talk.dialogue.retry_at:
            talk.greet()
            if chance.random() < 0.3:  # the welcome is lost
                talk.lose()
            else:
                talk.hear(WELCOME)
        for message in talk.sent():
            assert isinstance(message, ExerciseResult | EpisodeResult)
            if chance.random() < 0.4:  # the connection breaks before it, and loses it
                talk.lose()
                break
            stored.setdefault(message.key, message)
            if chance.random() < 0.3:  # or after it, and loses the acknowledgement
                talk.lose()
                break
            talk.hear(Ack(message.key))
        if not to_come and not len(talk.outbox):
            break
    assert [*stored.values()] == results


@pytest.mark.parametrize("code", ["version", "secret", "over"])
def test_a_permanent_problem_ends_the_link(code: str) -> None:
    talk = Talk().link()
    problem = LinkProblem(code, "This seat is not known. Join again.")  # type: ignore[arg-type]
    assert talk.hear(problem) == problem
    talk.lose()
    assert talk.dialogue.phase is LinkPhase.OVER
    assert talk.dialogue.problem == problem.text
    assert talk.dialogue.wait_s(talk.now) is None
    with pytest.raises(RuntimeError, match="OPENING"):
        talk.dialogue.open()
    talk.dialogue.renew(talk.now)
    assert (talk.dialogue.wait_s(talk.now), talk.dialogue.problem) == (0.0, "")
    talk.outbox.add(result(1))
    assert talk.link().sent() == [result(1)]


def test_a_close_for_good_ends_the_link_with_its_reason() -> None:
    talk = Talk().link()
    talk.dialogue.lost(talk.now, "You may not join this class.", 1008)
    assert talk.dialogue.phase is LinkPhase.OVER
    assert talk.dialogue.problem == "You may not join this class."


def test_a_refused_message_and_a_frame_that_is_none_leave_the_link() -> None:
    talk = Talk().link()
    assert talk.hear(LinkProblem("message", "scene: too long")) is not None
    assert (talk.dialogue.phase, talk.dialogue.problem) == (LinkPhase.LINKED, "scene: too long")
    assert talk.dialogue.receive(b"\x93\x01") is None
    assert "can't read" in talk.dialogue.problem
    attention = Attention("pause", "Look here", 0.0)
    assert talk.hear(attention) == attention


def test_phases_can_not_be_skipped() -> None:
    dialogue = LinkDialogue(HELLO, ResultOutbox())
    with pytest.raises(RuntimeError, match="expected a phase after WAITING, got GREETING"):
        dialogue.opened(0.0)
    assert dialogue.receive(encode_from_class(WELCOME)) is None
    assert dialogue.phase is LinkPhase.WAITING
