"""Texts: English in code, translated where they are shown."""

import pickle

import msgspec
import pytest

from ai4u_edu.locale import (
    PSEUDO,
    Catalogue,
    Text,
    gettext,
    join,
    ngettext,
    packed,
    unpacked,
)

ACCENTED = Catalogue(PSEUDO)
PORTUGUESE = Catalogue("pt_BR")


def test_a_text_is_its_english_sentence() -> None:
    text = gettext("no body is called {name!r}", name="bxo")
    assert text == "no body is called 'bxo'"
    assert isinstance(text, str)
    assert Catalogue("en").translate(text) == text


def test_a_plain_string_is_never_translated() -> None:
    assert ACCENTED.translate("my own scene") == "my own scene"


def test_values_stay_and_texts_among_them_are_translated() -> None:
    inner = gettext("a box")
    text = gettext("{what} at {x:.1f} m", what=inner, x=1.25)
    translated = ACCENTED.translate(text)
    assert "1.2" in translated
    assert ACCENTED.translate(inner) in translated
    assert "a box" not in translated


def test_thousands_stand_apart_as_the_language_has_it() -> None:
    text = gettext(
        "Learned from {decisions:,} of {total:,} decisions so far.", decisions=512, total=8192
    )
    assert text == "Learned from 512 of 8,192 decisions so far."
    assert PORTUGUESE.translate(text) == "Até agora aprendeu com 512 de 8.192 decisões."


def test_braces_without_values_are_characters() -> None:
    text = gettext('write {"move": [1, 0]}')
    assert text == 'write {"move": [1, 0]}'
    assert '{"move": [1, 0]}' in ACCENTED.translate(text)


@pytest.mark.parametrize(("number", "wanted"), [(0, "0 aluno:"), (1, "1 aluno:"), (2, "2 alunos:")])
def test_plurals_follow_the_language(number: int, wanted: str) -> None:
    text = ngettext("{n} student:", "{n} students:", number)
    assert text == ("1 student:" if number == 1 else f"{number} students:")
    assert PORTUGUESE.translate(text) == wanted


def test_a_text_without_translation_is_english() -> None:
    text = gettext("no catalogue has this sentence: {n}", n=3)
    assert PORTUGUESE.translate(text) == text


def test_sentences_are_joined_and_translated_each() -> None:
    first, second = gettext("Saved."), gettext("It works after the next start.")
    joined = join([first, "as written", second])
    assert joined == "Saved. as written It works after the next start."
    parts = [ACCENTED.translate(first), "as written", ACCENTED.translate(second)]
    assert ACCENTED.translate(joined).rstrip("~") == " ".join(parts).rstrip("~")


def test_a_text_reaches_another_process_whole() -> None:
    text = ngettext("{n} body in {scene}", "{n} bodies in {scene}", 3, scene=gettext("the maze"))
    copy = pickle.loads(pickle.dumps(text))  # noqa: S301 - our own
    assert copy == text
    assert ACCENTED.translate(copy) == ACCENTED.translate(text)


def test_a_message_is_translated_while_it_is_encoded() -> None:
    def translated(value: object) -> str:
        assert isinstance(value, Text)
        return ACCENTED.translate(value)

    encoder = msgspec.json.Encoder(enc_hook=translated)
    message = {"text": gettext("Saved."), "name": "my scene"}
    decoded = msgspec.json.decode(encoder.encode(message))
    assert decoded == {"text": ACCENTED.translate(gettext("Saved.")), "name": "my scene"}


def test_a_packed_text_is_translated_where_it_is_unpacked() -> None:
    inner = gettext("the maze")
    text = ngettext("{n} body in {scene!r}", "{n} bodies in {scene!r}", 3, scene=inner)
    copy = unpacked(packed(text))
    assert copy == text
    assert ACCENTED.translate(copy) == ACCENTED.translate(text)
    assert unpacked(packed("as it is")) == "as it is"
    assert unpacked(msgspec.json.decode(msgspec.json.encode(text, enc_hook=packed))) == text
    assert packed(text, 20) == text, "in English if there is no place"


@pytest.mark.parametrize(
    "data",
    [
        '["{a.__class__}", {"a": 1}, "", 1, false, "ai4u_edu"]',
        '["{a:>999999999}", {"a": 1}, "", 1, false, "ai4u_edu"]',
        '["{a[0]}", {"a": "b"}, "", 1, false, "ai4u_edu"]',
        '["{a}", {"a": "b"}, "{b}", 2, false, "ai4u_edu"]',
        '["{a}", {"a": "b"}, "", 1, false, "../other"]',
        '["{a}", {"a": [1]}, "", 1, false, "ai4u_edu"]',
        '["{a}"',
        "[]",
        '["{a", {"a": 1}, "", 1, false, "ai4u_edu"]',
        '[["{a}"], {"a": 1}, "", 1, false, "ai4u_edu"]',
        "[" * 100_000,
    ],
)
def test_what_somebody_else_packed_is_read_with_care(data: str) -> None:
    assert unpacked("\x1e" + data) == ""
