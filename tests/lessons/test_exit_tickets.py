"""Exit tickets: only the right letters pass, and each wrong choice has its sentence."""

import itertools
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons import check, hint, solution
from ai4u_edu.lessons.checking import judge
from ai4u_edu.lessons.collecting import ClassProgress
from ai4u_edu.lessons.course import exercise_ids, is_ticket, lesson, lessons
from ai4u_edu.lessons.exercise import EXERCISES, find
from ai4u_edu.lessons.exit_ticket import TICKETS, Question, exit_ticket
from ai4u_edu.lessons.progress_file import ExerciseProgress, ProgressFile

IDS = [each for each in exercise_ids() if is_ticket(each)]
SAMPLE = "00.exit-sample.exit"
QUESTION = re.compile(r"^\W*(?:Question )?([1-9])[.):*]", re.MULTILINE)
CHOICE = re.compile(r"^ *(?:[-*] +)?[*`(]*([a-h])[*`]*[.):*`]", re.MULTILINE)
MAX_SHARE = 0.5
"""Largest share of one letter in the right answers of the course."""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def ticket() -> Iterator[str]:
    """A ticket with the right answers b, a, c."""
    exit_ticket(
        SAMPLE,
        Question("b", {"a": "One a.", "c": "One c."}),
        Question("a", {"b": "Two b."}),
        Question("c", {"a": "Three a.", "b": "Three b.", "d": "Three d."}),
    )
    yield SAMPLE
    del EXERCISES[SAMPLE], TICKETS[SAMPLE]


def asked(number: str) -> list[list[str]]:
    """Return the letters of each question's choices in the text before a ticket's cell."""
    cells = lesson(number).cells
    index = next(index for index, each in enumerate(cells) if is_ticket(each.exercise))
    text = cells[index - 1].source
    assert cells[index - 1].is_text
    heads = [*QUESTION.finditer(text)]
    assert [each[1] for each in heads] == ["1", "2", "3"]
    ends = [*(each.start() for each in heads[1:]), len(text)]
    return [CHOICE.findall(text[head.end() : end]) for head, end in zip(heads, ends, strict=True)]


@pytest.mark.parametrize("given", [["b", "a", "c"], ("B", " a ", "C"), "bac", " B, a, c."])
def test_right_letters_pass_however_they_are_written(ticket: str, given: Any) -> None:
    verdict = judge(EXERCISES[ticket], given)
    assert verdict.passed
    assert verdict.text == "All three answers are right."


def test_it_says_which_are_right_and_what_the_first_wrong_one_gets_wrong(ticket: str) -> None:
    verdict = judge(EXERCISES[ticket], ["B", "b", "d"])
    assert (verdict.text, verdict.hint) == ("Question 1 is right. Question 2, b: Two b.", "2b")
    verdict = judge(EXERCISES[ticket], ["b", "a", "d"])
    assert verdict.text == "Questions 1 and 2 are right. Question 3, d: Three d."
    assert judge(EXERCISES[ticket], "cbd").text.startswith("No answer is right yet. Question 1, c:")


@pytest.mark.parametrize(
    ("given", "text"),
    [
        (["", "", ""], "Nothing is answered yet. Write one letter"),
        ([], "Nothing is answered yet."),
        (["b", "", "c"], "Question 2: expected one of the letters a, b, got nothing."),
        (["b", "a", "e"], "Question 3: expected one of the letters a, b, c, d, got `'e'`."),
        (["b", "a", 3], "Question 3: expected one of the letters a, b, c, d, got `3`."),
        (["b", "a"], "Expected one letter for each of the three questions, got 2:"),
        ("bacb", "Expected one letter for each of the three questions, got 4:"),
        (7, "Expected a list of three letters, got `7`."),
        ({"b": 1, "a": 2, "c": 3}, "Expected a list of three letters, got"),
    ],
)
def test_what_are_no_three_letters_is_said(ticket: str, given: Any, text: str) -> None:
    verdict = judge(EXERCISES[ticket], given)
    assert not verdict.passed
    assert verdict.text.startswith(text)
    assert verdict.hint == "begin"


def test_a_hint_tells_no_more_than_the_check_did(
    ticket: str, capsys: pytest.CaptureFixture[str]
) -> None:
    progress = ProgressFile()
    progress.note(ticket, passed=False, text="", diagnosis=f"{ticket}/1a", picture=b"")
    told = []
    for _ in range(4):
        hint(ticket)
        told.append(capsys.readouterr().out)
    assert told[0] == 'Hint. One a.\n1 more: run `hint("' + ticket + '")` again.\n'
    assert told[1] == told[3]
    assert told[1].startswith("Hint. The lesson's text answers")
    assert told[2] == "Hint. One a.\n"
    solution(ticket)
    assert "no solution to print" in capsys.readouterr().out


def test_the_table_of_a_class_names_the_question_of_a_mistake() -> None:
    entry = ExerciseProgress(tries=2, diagnoses={"01.exit/1a": 1, "01.exit/begin": 1})
    page = ClassProgress({"ann": {"01.exit": entry}}, []).page()
    assert f"1: Question 1, a: {find('01.exit').hints['1a'][:20]}" in page
    assert "1: Write one letter" in page


@pytest.mark.parametrize(
    ("exercise", "questions"),
    [
        ("04.4", [Question("a", {"b": "."})] * 3),
        ("04.exit", [Question("a", {"b": "."})] * 2),
        ("04.exit", [Question("a", {})] * 3),
        ("04.exit", [Question("a", {"a": "."})] * 3),
        ("04.exit", [Question("a", {"c": "."})] * 3),
    ],
)
def test_a_ticket_without_proper_choices_is_refused(exercise: str, questions: Any) -> None:
    with pytest.raises(SetupError, match="expected"):
        exit_ticket(exercise, *questions)


@pytest.mark.parametrize("exercise", IDS)
def test_of_all_combinations_only_one_passes_and_each_wrong_choice_is_explained(
    exercise: str,
) -> None:
    known, questions = find(exercise), TICKETS[exercise]
    right = [each.right for each in questions]
    for letters in itertools.product(*[each.letters for each in questions]):
        verdict = judge(known, list(letters))
        assert verdict.passed is (list(letters) == right)
        if not verdict.passed:
            assert verdict.text.endswith(known.hints[verdict.hint])
    for name, text in known.hints.items():
        assert text.endswith((".", "?")), name
    sentences = [text for each in questions for text in each.wrong.values()]
    assert len(set(sentences)) == len(sentences)


@pytest.mark.parametrize("exercise", IDS)
def test_the_notebook_asks_these_questions_with_these_choices(exercise: str) -> None:
    find(exercise)
    assert asked(exercise[:2]) == [each.letters for each in TICKETS[exercise]]


def test_each_lesson_ends_with_a_ticket() -> None:
    assert [each[:2] for each in IDS] == [each.number for each in lessons()]
    for each in lessons():  # a stretch may have an exercise, too
        assert set(each.exercises[-2:]) & set(IDS), each.number


def test_the_right_letters_of_the_course_differ() -> None:
    for each in IDS:
        find(each)
    counts = Counter(each.right for name in IDS for each in TICKETS[name])
    assert all(count <= max(3, MAX_SHARE * 3 * len(IDS)) for count in counts.values()), counts


def test_a_ticket_that_passed_is_saved_as_an_exercise_is(
    capsys: pytest.CaptureFixture[str],
) -> None:
    for each in IDS:
        find(each)
        check(each, [question.right for question in TICKETS[each]])
        assert ProgressFile().entries()[each].passed
        assert "Right. All three" in capsys.readouterr().out
