"""The texts of forms that stand in no module as such: those of parameters and their classes."""

from collections.abc import Iterator

from ai4u_edu.blocks.docs import built_in_blocks
from ai4u_edu.locale import Text
from ai4u_edu.page.editing.forms import ParameterField, block_form
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.page.editing.settings import FIELDS, agent_form, field_form, scene_form
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.panel.field_hints import detail, plain_hint, plain_label
from ai4u_edu.page.panel.gallery import first_sentence, hint_of
from ai4u_edu.scenes import Scene

SCENE = "box_chase"
"""A scene of which the forms of the scene and of an agent are taken."""


def form_texts() -> Iterator[str]:
    """Yield the labels, hints and descriptions of all forms, and the summaries of all blocks.

    They are made of the names and docstrings of parameters and classes, so that no call in the code
    has them for ``python -m tests.translations``.
    """
    state = EditState(Scene.load(SCENE).description)
    agent = state.description.agents[0]
    names = SceneNames(state, str(agent.get("id", "0")))
    for block in [block for blocks in built_in_blocks().values() for block in blocks]:
        yield from _leaves(first_sentence(block))
        yield from _leaves(hint_of(block.__name__))
        for field in block_form({"type": block.__name__}, names):
            yield from _texts_of(field, block.__name__)
    for field in (*agent_form(agent), *scene_form(state.description)):
        yield from _texts_of(field)
    for kind in FIELDS.values():
        scene = state.description.model_copy(update={"generate": kind()})
        for field in field_form(scene):
            yield from _texts_of(field)


def _texts_of(field: ParameterField, block: str = "") -> Iterator[str]:
    for text in (plain_label(field), plain_hint(field, block), detail(field)):
        yield from _leaves(text)


def _leaves(text: object) -> Iterator[str]:
    """Yield the texts without values in a text; those with values are patterns of the code."""
    if not isinstance(text, Text):
        return
    if not text.values and text.msgid:
        yield text.msgid
    for value in text.values.values():
        yield from _leaves(value)
