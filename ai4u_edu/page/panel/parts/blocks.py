"""The part "blocks": the blocks of an agent, its settings, and a form for one block."""

from collections.abc import Mapping
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Block
from ai4u_edu.page.editing import EditState, SceneEditor
from ai4u_edu.page.editing.blocks import KINDS, block_at, is_enabled
from ai4u_edu.page.editing.forms import block_form
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.page.editing.scene_names import SceneNames, name_of
from ai4u_edu.page.editing.settings import agent_form
from ai4u_edu.page.editing.suggestion import NAMED
from ai4u_edu.page.panel.gallery import first_fields, first_sentence, hint_of, words_of
from ai4u_edu.page.panel.labels import change_label
from ai4u_edu.page.panel.parts.fields import field_json

AGENT_KINDS = ("sensors", "actuators", "rewards", "brains")
PARTS: Mapping[str, Mapping[str, str]] = {
    "children": {"title": "Reward", "kind": "rewards"},
    "sensors": {"title": "Sensor", "kind": "sensors"},
    "variables": {"title": "Need", "class": "HomeostaticVariable"},
}
"""Parts of which a block may have several, by the parameter that holds them."""
MAX_READS_CHARS = 80


def blocks_part(
    editor: SceneEditor, agent_id: str, driver: str, path: BlockPath | None
) -> dict[str, Any]:
    """Return an agent's blocks.

    Args:
        editor: has the scene.
        agent_id: the agent.
        driver: name of its present driver.
        path: of the block whose form is shown; None for no form.

    Raises:
        AI4UError: the editor's scene has no such agent.
    """
    state = editor.state
    agent = state.agent(agent_id)
    names = SceneNames(state, agent_id)
    return {
        "type": "part",
        "name": "blocks",
        "agent": agent_id,
        "driver": driver,
        "kinds": {
            kind: [
                _block(block, (kind, index), len(agent[kind]), names)
                for index, block in enumerate(agent.get(kind, ()))
            ]
            for kind in AGENT_KINDS
        },
        "settings": [field_json(each, block="LocalBrain") for each in agent_form(agent)],
        "form": _form(state, agent_id, path),
        **changes_json(editor),
    }


def changes_json(editor: SceneEditor) -> dict[str, Any]:
    """Return what undo and redo would do, and whether a change waits for a reset."""
    return {
        "undo": {"label": change_label(editor.undo_label)},
        "redo": {"label": change_label(editor.redo_label)},
        "waits_for_reset": editor.waits_for_reset,
    }


def _block(block: Plain, path: BlockPath, count: int, names: SceneNames) -> dict[str, Any]:
    words = words_of(str(block["type"]))
    index = path[-1]
    is_in_list = isinstance(index, int)
    return {
        "path": list(path),
        "name": _name(block),
        "title": words.title,
        "class": block["type"],
        "icon": words.picture,
        "reads": _reads(block, names),
        "is_on": is_enabled(path, block) if is_in_list else True,
        "can_switch": is_in_list and len(path) == 2,
        "can_up": isinstance(index, int) and index > 0,
        "can_down": isinstance(index, int) and index < count - 1,
        "can_remove": is_in_list,
        "children": _children(block, path, names),
        "adds": _adds(Block.types[str(block["type"])], path),
    }


def _adds(cls: type[Block], path: BlockPath) -> list[dict[str, Any]]:
    """Return what can be added to a block: a kind of the gallery, or a class, and where to."""
    return [
        {**what, "parent": [*path, name]}
        for name, what in PARTS.items()
        if name in cls.parameters()
    ]


def _children(block: Plain, path: BlockPath, names: SceneNames) -> list[dict[str, Any]]:
    found = []
    for name, value in block.items():
        if name not in KINDS:
            continue
        if isinstance(value, Mapping):
            found.append(_block(value, (*path, name), 1, names))
        elif isinstance(value, list | tuple):
            found += [
                _block(each, (*path, name, index), len(value), names)
                for index, each in enumerate(value)
                if isinstance(each, Mapping)
            ]
    return found


def _name(block: Plain) -> str:
    """Return a block's name in the percept, the action or the rewards; empty if it has none."""
    cls = Block.types[str(block["type"])]
    for base, (_, parameter) in NAMED.items():
        if issubclass(cls, base):
            return name_of(block, parameter)
    return str(block.get("name", ""))


def _reads(block: Plain, names: SceneNames) -> str:
    """Return a block's most important parameters in a few words."""
    fields = block_form(block, names)
    first = first_fields(str(block["type"]), fields)
    texts = [
        f"{f.label}: {f.shown}" for f in fields if f.name in first and f.shown not in {"", "{}"}
    ]
    text = ", ".join(texts)
    return text if len(text) <= MAX_READS_CHARS else text[: MAX_READS_CHARS - 1] + "…"


def _form(state: EditState, agent_id: str, path: BlockPath | None) -> dict[str, Any] | None:
    """Return the form of the chosen block; None if there is no such block any more."""
    if path is None:
        return None
    try:
        block = block_at(state.agent(agent_id), path)
    except AI4UError:
        return None
    type_name = str(block["type"])
    fields = block_form(block, SceneNames(state, agent_id))
    first = first_fields(type_name, fields)
    return {
        "path": list(path),
        "title": words_of(type_name).title,
        "class": type_name,
        "icon": words_of(type_name).picture,
        "question": words_of(type_name).question,
        "summary": hint_of(type_name),
        "detail": first_sentence(Block.types[type_name]),
        "fields": [field_json(each, first, type_name) for each in fields],
    }
