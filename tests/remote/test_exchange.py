"""The states of a script's percepts and answers."""

from typing import Any

from ai4u_edu.blocks.brains.links.link import Observation, Reply, ResetRequest
from ai4u_edu.page.server.scripts.session import Exchange, Turn

NOTHING: Any = None


def observation(number: int) -> Observation:
    return Observation(number, 1, NOTHING, 0.0, {}, number, number, False, False, False, False)


FIRST, SECOND = observation(1), observation(2)
ACTION = {"move": (1.0,)}


def turn(exchange: Exchange) -> Turn:
    """The state; a type checker takes an attribute to stay as it was."""
    return exchange.turn


def asked() -> Exchange:
    exchange = Exchange()
    assert turn(exchange) is Turn.IDLE
    assert exchange.ask(FIRST, b"first")
    assert turn(exchange) is Turn.ASKED
    return exchange


def test_a_percept_is_answered_once() -> None:
    exchange = asked()
    assert exchange.observation_for(1) is FIRST
    assert exchange.observation_for(2) is None
    reply = Reply(ACTION, FIRST)
    assert exchange.answer(reply)
    assert turn(exchange) is Turn.ANSWERED
    assert not exchange.answer(reply)
    assert exchange.observation_for(1) is None
    assert exchange.take() is reply
    assert turn(exchange) is Turn.IDLE
    assert exchange.take() is None


def test_only_a_percept_without_an_answer_is_repeated() -> None:
    exchange = asked()
    assert exchange.unanswered_frame() == b"first"
    exchange.answer(Reply(ACTION, FIRST))
    assert exchange.unanswered_frame() is None


def test_an_answer_to_a_percept_that_was_replaced_does_not_count() -> None:
    exchange = asked()
    exchange.ask(SECOND, b"second")
    assert not exchange.answer(Reply(ACTION, FIRST))
    assert exchange.answer(Reply(ACTION, SECOND))


def test_a_late_action_is_skipped_for_a_newer_one() -> None:
    exchange = asked()
    exchange.answer(Reply(ACTION, FIRST))
    exchange.ask(SECOND, b"second")
    newer = Reply(ACTION, SECOND)
    exchange.answer(newer)
    assert len(exchange) == 2
    assert exchange.take() is newer
    assert (turn(exchange), exchange.ignored) == (Turn.IDLE, 1)


def test_a_late_action_counts_if_there_is_no_newer_one() -> None:
    exchange = asked()
    late = Reply(ACTION, FIRST)
    exchange.answer(late)
    exchange.ask(SECOND, b"second")
    assert exchange.take() is late
    assert turn(exchange) is Turn.ASKED


def test_while_a_reset_waits_no_percept_is_sent() -> None:
    exchange = asked()
    reset = Reply(ResetRequest(), FIRST)
    exchange.answer(reset)
    assert turn(exchange) is Turn.RESETTING
    assert not exchange.ask(SECOND, b"second")
    assert exchange.take() is reset
    assert exchange.ask(SECOND, b"second")


def test_a_refused_answer_may_be_given_again_unless_there_is_a_newer_percept() -> None:
    exchange = asked()
    exchange.answer(Reply(ACTION, FIRST))
    exchange.take()
    assert exchange.ask_again(FIRST)
    assert exchange.observation_for(1) is FIRST
    exchange.ask(SECOND, b"second")
    assert not exchange.ask_again(FIRST)


def test_after_the_end_nothing_is_expected() -> None:
    exchange = asked()
    exchange.cancel()
    exchange.cancel()
    assert turn(exchange) is Turn.IDLE
    assert not exchange.answer(Reply(ACTION, FIRST))
