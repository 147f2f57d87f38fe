"""A script's dialogue with a world, step by step and without a connection."""

from typing import Any

import pytest

from ai4u_edu.remote import ActionError, RemoteError
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.steps import Flow, Open, Receive, Send, Step
from ai4u_edu.wire import native
from tests.waiting import LIMIT_S

WELCOME = native.Welcome(
    version=native.VERSION,
    session="1234",
    grace=LIMIT_S,
    agent="a",
    mode="lockstep",
    title="A room",
    ticks_per_second=60.0,
    skip_frame=0,
    repeat_action=True,
    max_steps=0,
    rewards=(),
    success="",
    readings=(),
    outputs=(native.Output("log", "box", (0.0,), (9.0,), True),),
)


def percept(number: int) -> native.Percept:
    return native.Percept(1, number, number, number, 0.0, {}, False, False, False, False, b"", ())


def answered(flow: Flow[Any], *messages: native.Message | None) -> tuple[Any, list[Step]]:
    """Carry out a dialogue's steps; return its result and the steps.

    Args:
        flow: of the dialogue.
        messages: what is received, one after another; None for a timeout.
    """
    heard, received = iter(messages), None
    steps: list[Step] = []
    while True:
        try:
            step = flow.send(received)
        except StopIteration as end:
            return end.value, steps
        steps.append(step)
        received = None
        if isinstance(step, Receive):
            message = next(heard)
            received = message and native.encode(message)


def connected() -> Dialogue:
    """Return a dialogue that has got its first percept."""
    dialogue = Dialogue("a", mode="lockstep", patience=LIMIT_S)
    _, steps = answered(dialogue.begin(), WELCOME)
    assert [type(step) for step in steps] == [Open, Send, Receive]
    answered(dialogue.sense(), percept(1))
    return dialogue


def test_the_example_of_an_answer_leaves_out_what_no_policy_drives() -> None:
    dialogue = connected()
    dialogue.outputs["respawn"] = native.Output("respawn", "box", (), (), False)
    assert dialogue.percept is not None
    with pytest.raises(RemoteError, match=r"such as robot\.act\(log=\[0\]\); "):
        dialogue.expect_answer_to(dialogue.percept)


REFUSAL = native.Problem("bad_action", "action 'log': expected 1 numbers, got 0", 1)


def test_each_copy_of_a_refused_answer_is_refused_but_raises_one_error() -> None:
    dialogue = connected()
    answered(dialogue.act({"log": [1]}))
    with pytest.raises(ActionError, match="expected 1 numbers"):
        answered(dialogue.sense(), None, None, REFUSAL)  # sent three times in all
    answered(dialogue.act({"log": [2]}))
    result, steps = answered(dialogue.sense(), REFUSAL, REFUSAL, percept(2))
    assert result.step == 2
    assert not [step for step in steps if isinstance(step, Send)]


def test_an_answer_that_is_wrong_again_is_refused_again() -> None:
    dialogue = connected()
    for _ in range(2):
        answered(dialogue.act({"log": [1]}))
        with pytest.raises(ActionError, match="expected 1 numbers"):
            answered(dialogue.sense(), REFUSAL)


def test_another_refusal_is_raised_while_copies_of_the_first_are_under_way() -> None:
    dialogue = connected()
    answered(dialogue.act({"log": [1]}))
    with pytest.raises(ActionError):
        answered(dialogue.sense(), None, REFUSAL)
    answered(dialogue.act({"log": [2]}))
    other = native.Problem("bad_action", "action 'log': expected finite numbers", 1)
    with pytest.raises(ActionError, match="finite"):
        answered(dialogue.sense(), other)
