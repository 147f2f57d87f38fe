"""The course as text, and as notebooks."""

from typing import Any

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import Lesson, is_ticket, lessons
from ai4u_edu.lessons.notebook import cells_of, dumps

pytestmark = pytest.mark.needs("dev")

EACH = pytest.mark.parametrize("lesson", lessons(), ids=[each.number for each in lessons()])


@EACH
def test_jupytext_reads_the_same_cells(lesson: Lesson) -> None:
    # takes two seconds, which every process that collects tests would spend
    import jupytext

    text = lesson.path.read_text(encoding="utf-8")
    read: Any = jupytext.reads(text, fmt="py:percent")
    theirs = [(c.cell_type, c.source.strip(), c.metadata.get("tags", [])) for c in read.cells]
    ours = [("markdown" if c.is_text else "code", c.source, list(c.tags)) for c in lesson.cells]
    assert ours == theirs


@EACH
def test_a_notebook_is_valid_has_no_outputs_and_is_the_same_each_time(lesson: Lesson) -> None:
    import nbformat

    read: Any = nbformat.reads
    book = read(dumps(lesson.cells), as_version=4)
    nbformat.validate(book)
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in book.cells)
    assert dumps(lesson.cells) == dumps(Lesson(lesson.path).cells)
    for cell in book.cells:
        assert cell.metadata["deletable"] is False
        assert cell.metadata.get("editable", True) is (cell.cell_type == "code")


@EACH
def test_the_form_of_a_lesson(lesson: Lesson) -> None:
    text = "\n".join(cell.source for cell in lesson.cells if cell.is_text)
    head = lesson.cells[0].source
    assert head.startswith(f"# {lesson.number} ")
    assert "**When you have finished, you can**" in head
    assert lesson.number == "00" or "**Recap.**" in head
    assert "## Stretch" in text
    for exercise in lesson.exercises:
        assert is_ticket(exercise) or f"Exercise {exercise}:" in text
    links = [line for line in text.splitlines() if "src=" in line or "<script" in line]
    assert links == []


def test_a_line_that_looks_like_a_cell_and_is_none_is_told() -> None:
    with pytest.raises(SetupError) as raised:
        cells_of("# %% [markdown]\n# Hi\n# %% [code]\n", "x.py")
    assert str(raised.value) == (
        "x.py, line 3: expected '# %%' or '# %% [markdown]', perhaps with tags=[\"...\"], got "
        "'# %% [code]'"
    )
