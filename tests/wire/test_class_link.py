"""Sentences on the link between a class and its rooms."""

from ai4u_edu.locale import PSEUDO, Catalogue, gettext
from ai4u_edu.wire.class_link import (
    Applied,
    LinkProblem,
    RoomTrainings,
    State,
    Training,
    decode_from_class,
    decode_from_room,
    encode_from_class,
    encode_from_room,
)
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

TEXT = gettext("no body is called {name!r}", name="bxo")


def test_a_sentence_is_translated_for_its_receivers_reader() -> None:
    problem = decode_from_class(encode_from_class(LinkProblem("message", TEXT)))
    applied = decode_from_room(encode_from_room(Applied("a", TEXT)))
    assert isinstance(problem, LinkProblem)
    assert isinstance(applied, Applied)
    wanted = Catalogue(PSEUDO).translate(TEXT)
    assert [problem.text, applied.problem] == [TEXT, TEXT]
    assert [*map(Catalogue(PSEUDO).translate, (problem.text, applied.problem))] == [wanted, wanted]


def test_sentences_in_any_field_are_translated() -> None:
    state = State("driving", "Box chase", TEXT, 1.0, 1, 0, is_solved=False)
    training = Training("abcdefgh", "box_chase", "0", 1, remarks=(TEXT,))
    sent = decode_from_room(encode_from_room(state))
    told = decode_from_class(encode_from_class(RoomTrainings((training,))))
    assert isinstance(sent, State)
    assert isinstance(told, RoomTrainings)
    accented = Catalogue(PSEUDO).translate
    assert accented(sent.driver) == accented(told.trainings[0].remarks[0]) == accented(TEXT)


def test_a_sentence_that_is_too_long_is_cut_in_english() -> None:
    long = gettext("no body is called {name!r}", name="b" * MAX_TEXT_CHARS)
    problem = decode_from_class(encode_from_class(LinkProblem("message", long)))
    assert isinstance(problem, LinkProblem)
    assert len(problem.text) == MAX_TEXT_CHARS
    assert problem.text.startswith("no body is called 'bbb")
