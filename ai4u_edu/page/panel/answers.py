"""Answers to commands, and the sentences in them."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import shorten
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, sentence
from ai4u_edu.page.editing import ChangeError, ChangeResult
from ai4u_edu.page.editing.change_result import When
from ai4u_edu.page.editing.scene_store import SceneExistsError

MAX_ERROR_CHARS = 2000
"""Length of an error that is sent to a page; it may repeat the page's own message."""
_LATER: dict[When, str] = {
    "now": "",
    "next decision": _("It works right away."),
    "next reset": _("It works after the next start."),
}


class Answer(NamedTuple):
    """The result of a command that was carried out."""

    text: str = ""
    """A sentence for the page; empty if there is nothing to say."""
    more: Mapping[str, Any] = {}
    """Other fields of the message."""


def change_answer(text: str, result: ChangeResult, **more: Any) -> Answer:
    """Return the answer to a change.

    Args:
        text: what was done, as a sentence.
        result: when it takes effect, and warnings.
        more: other fields of the message.

    >>> change_answer("Ray sensor added.", ChangeResult("next decision")).text
    'Ray sensor added. It works right away.'
    """
    if not result.label and result.note:
        return Answer(sentence(result.note), more)  # nothing has changed
    note = sentence(result.note)
    return Answer(join([part for part in (text, _LATER[result.when], note) if part]), more)


def failure(error: BaseException) -> dict[str, Any]:
    """Return the fields of the message about a command that failed."""
    problems = error.problems if isinstance(error, ChangeError) else ()
    text = message_of(error)
    code = "exists" if isinstance(error, SceneExistsError) else ""
    return {
        "code": code,
        "text": shorten(text, MAX_ERROR_CHARS),
        "problems": [
            {"path": list(problem.path), "text": shorten(problem.text, MAX_ERROR_CHARS)}
            for problem in problems
        ],
    }
