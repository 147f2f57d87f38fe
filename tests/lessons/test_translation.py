"""The course in other languages."""

import ast

import pytest

from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import Lesson, is_ticket, lessons
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.translation import texts_of, translated_cell, translated_lesson
from ai4u_edu.locale import LANGUAGES, PSEUDO, SOURCE

EACH = pytest.mark.parametrize("lesson", lessons(), ids=[each.number for each in lessons()])


def test_a_text_is_cut_into_paragraphs_items_and_rows() -> None:
    source = (
        "## The body\n\nOne sentence\nover two lines.\n\n- first\n  of two\n- second\n\n"
        "| name | what |\n|---|---|\n| x | to the right |\n\n```\nnot this\n```"
    )
    assert list(texts_of(Cell(source, is_text=True))) == [
        "The body",
        "One sentence over two lines.",
        "first of two",
        "second",
        "name | what |",
        "x | to the right |",
    ]


def test_html_is_kept_but_for_the_words_of_pictures() -> None:
    source = '<p>\n  <img src="a.png" alt="a robot" />\n</p>\nwords\n<!-- no word -->\n| a word |'
    page = Cell(source, is_text=True)
    assert list(texts_of(page)) == ["a robot", "words", "a word |"]
    assert translated_cell(page, str.upper).source == (
        '<p>\n  <img src="a.png" alt="A ROBOT" />\n</p>\nWORDS\n<!-- no word -->\n| A WORD |'
    )


def test_a_block_of_code_needs_no_fence() -> None:
    page = Cell("So:\n\n    def decide(percept):\n        return percept\n\nThen.", is_text=True)
    assert list(texts_of(page)) == ["So:", "Then."]
    assert translated_cell(page, str.upper).source == page.source.replace("So", "SO").replace(
        "Then", "THEN"
    )


def test_code_is_cut_into_comments_and_strings_that_are_read() -> None:
    source = (
        "# turn left\n"
        'action = {"move": [0, -1, 0, 0]}  # at once\n'
        'print("x:", f"at {x:.1f} m")\n'
        'plot(curve, "distance (m)", kind="line", ylabel="distance")\n'
        'percept["to food"]'
    )
    texts = list(texts_of(Cell(source)))
    assert sorted(texts) == ["at once", "at {x:.1f} m", "distance", "distance (m)", "turn left"]


def test_a_translation_is_put_back_where_its_text_was() -> None:
    cell = Cell('## A\n\n- one\n  two\n\n```\nprint("a b")\n```', is_text=True)
    assert translated_cell(cell, str.upper).source == (
        '## A\n\n- ONE TWO\n\n```\nprint("a b")\n```'
    )
    code = Cell('print("é: it is", x)  # so it is\ny = "it is"')
    assert translated_cell(code, str.upper).source == (
        'print("é: IT IS", x)  # SO IT IS\ny = "IT IS"'.replace("é", "É")
    )


@pytest.mark.parametrize("language", [*LANGUAGES, PSEUDO])
@EACH
def test_code_does_the_same_in_each_language(lesson: Lesson, language: str) -> None:
    cells = translated_lesson(lesson.name, lesson.cells, language)
    assert [cell.tags for cell in cells] == [cell.tags for cell in lesson.cells]
    line = f"set_language({language!r})"
    assert sum(line in cell.source for cell in cells) == (language != SOURCE)
    for cell, english in zip(cells, lesson.cells, strict=True):
        if not cell.is_text:
            code = cell.source.partition("\n\nfrom ai4u_edu.locale import set_language")[0]
            assert _without_words(code) == _without_words(english.source)


@EACH
def test_all_words_of_a_lesson_can_be_translated(lesson: Lesson) -> None:
    cells = translated_lesson(lesson.name, lesson.cells, PSEUDO)
    for cell, english in zip(cells, lesson.cells, strict=True):
        for text in texts_of(english):
            assert not text.isascii() or text not in cell.source.split("\n"), text


@EACH
def test_solutions_do_the_same_in_each_language(lesson: Lesson) -> None:
    for exercise in lesson.exercises:
        if not is_ticket(exercise):
            code = answers_to(exercise).solution
            translated = translated_cell(Cell(code), lambda text: text + "~")
            assert _without_words(translated.source) == _without_words(code)


def _without_words(code: str) -> str:
    """Return the structure of code, with texts left out that may be translated."""
    tree = ast.parse(code)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
        elif isinstance(node, ast.JoinedStr):
            node.values = [part for part in node.values if isinstance(part, ast.FormattedValue)]
    return ast.dump(tree)
