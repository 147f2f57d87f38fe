"""Sentences about programs in the reader's language, in a page's worker and outside it."""

import json
from collections.abc import Iterator

import pytest

from ai4u_edu.locale import PAGE, PSEUDO, PYTHON, Catalogue, Text
from ai4u_edu.locale.catalogues import pseudo
from ai4u_edu.program import Program, ProgramError, host
from ai4u_edu.program.texts import make_texts_with, translate_with
from tests.translations import domains

pytestmark = pytest.mark.needs("dev")


@pytest.fixture(autouse=True)
def english_again() -> Iterator[None]:
    yield
    translate_with({})


def test_a_pages_worker_translates_by_its_catalogue() -> None:
    (page,) = (domain for domain in domains() if domain.name == PAGE)
    sentences = [text for text, _ in page.texts if isinstance(text, str)]
    host.translate(json.dumps({text: pseudo(text) for text in sentences}))
    answer = json.loads(host.load(json.dumps({"source": "def decide(percept)\n    return {}"})))
    assert answer["text"] == pseudo(
        "A colon (:) is missing at the end of this line, or before what stands after it."
    )
    host.load(json.dumps({"source": "def decide(percept):\n    return percept['a']"}))
    answer = json.loads(host.decide(json.dumps({"percept": {"b": 1}, "decision": 1})))
    assert answer["text"] == pseudo("there is no sensor called {key}; {hint}").format(
        key="'a'", hint=pseudo("known are {names}").format(names="'b'")
    )
    (python,) = (domain for domain in domains() if domain.name == PYTHON)
    assert "known are {names}" in {text for text, _ in python.texts}


def test_outside_a_page_it_is_translated_where_it_is_shown() -> None:
    make_texts_with(Text)
    with pytest.raises(ProgramError) as raised:
        Program.load("def decide(percept):\n    return move").decide({})
    text = raised.value.text
    assert text.startswith("nothing is called 'move'; ")
    assert Catalogue(PSEUDO).translate(text).startswith(pseudo("nothing").rstrip("~"))
