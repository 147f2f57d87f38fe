"""The part "blocks": the blocks of an agent, its settings, and a form for one block."""

from collections.abc import Mapping
from typing import Literal

from msgspec import UNSET, Struct, UnsetType, field

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.page.editing import EditState, SceneEditor
from ai4u_edu.page.editing.blocks import KINDS, block_at, is_enabled
from ai4u_edu.page.editing.forms import ParameterField, block_form
from ai4u_edu.page.editing.plain import BlockPath, Plain
from ai4u_edu.page.editing.scene_names import SceneNames, name_of
from ai4u_edu.page.editing.settings import agent_form
from ai4u_edu.page.editing.suggestion import NAMED
from ai4u_edu.page.messages import Kind
from ai4u_edu.page.panel.field_hints import plain_label
from ai4u_edu.page.panel.gallery import first_fields, first_sentence, hint_of, words_of
from ai4u_edu.page.panel.labels import change_label
from ai4u_edu.page.panel.parts.fields import FormField, form_field
from ai4u_edu.page.panel.parts.part import PanelPart

AGENT_KINDS = ("sensors", "actuators", "rewards", "brains")
PARTS: Mapping[str, tuple[str, Kind | UnsetType, str | UnsetType]] = {
    "children": (_("Reward"), "rewards", UNSET),
    "sensors": (_("Sensor"), "sensors", UNSET),
    "variables": (_("Need"), UNSET, "HomeostaticVariable"),
}
"""Parts of which a block may have several, by the parameter that holds them: title, and the kind of
the gallery or the one class."""
MAX_READS_CHARS = 80
"""Length of a block's parameters in its row; others are left out."""
MAX_VALUE_CHARS = 40

YES_NO = {"True": _("yes"), "False": _("no")}
"""Words for the value of a switch."""


class UndoLabel(Struct, frozen=True):
    """A change that can be undone, or made again."""

    label: str
    """The change in words; empty if there is none."""


class BlockAddition(Struct, frozen=True, kw_only=True):
    """Something that can be added to a block: one of a kind of the gallery, or of one class."""

    title: str
    kind: Kind | UnsetType = UNSET
    """Kind of the gallery from which one is chosen."""
    type_name: str | UnsetType = field(name="class", default=UNSET)
    """Class of what is added, if there is but one."""
    parent: BlockPath
    """Path of the list that it is added to."""


class BlockRow(Struct, frozen=True):
    """A block of an agent."""

    path: BlockPath
    """Names and indices that lead to it from the agent."""
    name: str
    """Name in the percept, the action or the rewards; empty if it has none."""
    title: str
    type_name: str = field(name="class")
    """Name of its class."""
    icon: str
    """Name of its icon, as in ``web/shared/icons.js``."""
    reads: str
    """Its most important parameters in a few words."""
    is_on: bool
    """False if it is switched off."""
    can_switch: bool
    can_up: bool
    can_down: bool
    can_remove: bool
    children: list["BlockRow"]
    """Blocks that it holds."""
    adds: list[BlockAddition]
    """Things that can be added to it."""


class BlockForm(Struct, frozen=True):
    """The form of one block."""

    path: BlockPath
    title: str
    type_name: str = field(name="class")
    icon: str
    """Name of its icon, as in ``web/shared/icons.js``."""
    question: str
    """The question that it answers."""
    summary: str
    """A short sentence about it."""
    detail: str
    """The first sentence of its class's docstring."""
    fields: list[FormField]


class BlocksPart(PanelPart, frozen=True, kw_only=True):
    """An agent's blocks."""

    name: Literal["blocks"] = "blocks"
    agent: str
    """Id of the agent."""
    driver: str
    """Name of its present driver."""
    kinds: dict[str, list[BlockRow]]
    """Blocks by kind: ``sensors``, ``actuators``, ``rewards`` and ``brains``."""
    settings: list[FormField]
    """Form of the agent itself."""
    form: BlockForm | None
    """Form of the chosen block; null if there is none."""
    undo: UndoLabel
    """The change that undo takes back."""
    redo: UndoLabel
    """The change that redo makes again."""
    waits_for_reset: bool
    """True if a change takes effect in the next episode."""


def blocks_part(
    editor: SceneEditor, agent_id: str, driver: str, path: BlockPath | None
) -> BlocksPart:
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
    undo, redo = undo_labels(editor)
    return BlocksPart(
        agent=agent_id,
        driver=driver,
        kinds={
            kind: [
                _block(block, (kind, index), len(agent[kind]), names)
                for index, block in enumerate(agent.get(kind, ()))
            ]
            for kind in AGENT_KINDS
        },
        settings=[form_field(setting, block="LocalBrain") for setting in agent_form(agent)],
        form=_form(state, agent_id, path),
        undo=undo,
        redo=redo,
        waits_for_reset=editor.waits_for_reset,
    )


def undo_labels(editor: SceneEditor) -> tuple[UndoLabel, UndoLabel]:
    """Return what undo and redo would do."""
    return UndoLabel(change_label(editor.undo_label)), UndoLabel(change_label(editor.redo_label))


def _block(block: Plain, path: BlockPath, count: int, names: SceneNames) -> BlockRow:
    words = words_of(str(block["type"]))
    index = path[-1]
    is_in_list = isinstance(index, int)
    return BlockRow(
        path=path,
        name=_name(block),
        title=words.title,
        type_name=str(block["type"]),
        icon=words.picture,
        reads=_reads(block, names),
        is_on=is_enabled(path, block) if is_in_list else True,
        can_switch=is_in_list and len(path) == 2,
        can_up=isinstance(index, int) and index > 0,
        can_down=isinstance(index, int) and index < count - 1,
        can_remove=is_in_list,
        children=_children(block, path, names),
        adds=_additions(Block.types[str(block["type"])], path),
    )


def _additions(cls: type[Block], path: BlockPath) -> list[BlockAddition]:
    return [
        BlockAddition(title=title, kind=kind, type_name=type_name, parent=(*path, name))
        for name, (title, kind, type_name) in PARTS.items()
        if name in cls.parameters()
    ]


def _children(block: Plain, path: BlockPath, names: SceneNames) -> list[BlockRow]:
    rows = []
    for name, value in block.items():
        if name not in KINDS:
            continue
        if isinstance(value, Mapping):
            rows.append(_block(value, (*path, name), 1, names))
        elif isinstance(value, list | tuple):
            rows += [
                _block(child, (*path, name, index), len(value), names)
                for index, child in enumerate(value)
                if isinstance(child, Mapping)
            ]
    return rows


def _name(block: Plain) -> str:
    """Return a block's name in the percept, the action or the rewards; empty if it has none."""
    cls = Block.types[str(block["type"])]
    for base, (_suffixes, parameter) in NAMED.items():
        if issubclass(cls, base):
            return name_of(block, parameter)
    return str(block.get("name", ""))


def _reads(block: Plain, names: SceneNames) -> str:
    """Return a block's most important parameters in a few words."""
    fields = block_form(block, names)
    first = first_fields(str(block["type"]), fields)
    texts: list[str] = [
        _("{label}: {value}", label=plain_label(f), value=_value(f))
        for f in fields
        if f.name in first and f.shown not in {"", "{}"}
    ]
    chars = 0
    shown: list[str] = []
    for text in texts:
        chars += len(text)
        if chars > MAX_READS_CHARS:
            return join([*shown, "…"], ", ")
        shown.append(text)
    return join(shown, ", ") if shown else ""


def _value(field: ParameterField) -> str:
    if field.kind == "data" and len(field.shown) > MAX_VALUE_CHARS:
        return f"{field.shown[: MAX_VALUE_CHARS - 1]}…"
    return YES_NO.get(field.shown, field.shown)


def _form(state: EditState, agent_id: str, path: BlockPath | None) -> BlockForm | None:
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
    return BlockForm(
        path=path,
        title=words_of(type_name).title,
        type_name=type_name,
        icon=words_of(type_name).picture,
        question=words_of(type_name).question,
        summary=hint_of(type_name),
        detail=first_sentence(Block.types[type_name]),
        fields=[form_field(parameter, first, type_name) for parameter in fields],
    )
