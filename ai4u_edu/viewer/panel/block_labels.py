"""Labels in the "Blocks" tab."""

from html import escape

from ai4u_edu.blocks.docs import summary
from ai4u_edu.editing import SceneEditor
from ai4u_edu.editing.blocks import block_at, block_paths, is_enabled, types_of
from ai4u_edu.editing.plain import BlockPath, Plain
from ai4u_edu.snapshot import AgentState
from ai4u_edu.snapshot.agent_words import title
from ai4u_edu.viewer.panel.html_parts import section

KINDS = {
    "Sensors": "sensors",
    "Actuators": "actuators",
    "Rewards": "rewards",
    "Brains": "brains",
}
BARE = '<div class="ai4u mark bare"></div>'
"""Marker before a button group that hides its label, so that the buttons use the full width."""
NO_BLOCK = "choose a block"
ADD = "choose what to add"
WAITS = "Something waits for the next reset."
MAX_LINE_CHARS = 72
"""Longest line in a dropdown."""


def block_lines(agent: Plain, kind: str) -> dict[str, BlockPath]:
    """Return the paths of a kind's blocks and of their parts, by their lines in the dropdown."""
    paths = {}
    for path in block_paths(agent, kind):
        block = block_at(agent, path)
        number = ".".join(str(part + 1) for part in path if isinstance(part, int))
        name = next(
            (block[key] for key in ("perception_key", "action_name", "name") if key in block), ""
        )
        off = "" if not isinstance(path[-1], int) or is_enabled(path, block) else " (off)"
        part = "" if isinstance(path[-1], int) else f".{path[-1]}"
        line = " ".join(filter(None, (f"{number}{part}", str(name), str(block["type"]))))
        paths[_short(line) + off] = path
    return paths


def type_labels(kind: str) -> dict[str, str]:
    """Return the type names of a kind's blocks, by their lines in the dropdown."""
    lines = {cls.__name__: summary(cls).split(" Source:")[0] for cls in types_of(kind)}
    return {_short(f"{name}: {line}"): name for name, line in lines.items()}


def selected_button_mark(position: int) -> str:
    """Return HTML before a button group that highlights one of its buttons, counted from 1.

    viser's buttons have no selected state; the style sheet uses the marker's ``data-on``.
    """
    return f'<div class="ai4u mark bare" data-on="{position}"></div>'


def undo_line(editor: SceneEditor) -> str:
    """Return the changes that undo and redo would apply, as HTML; empty if there are none."""
    labels = (("undo", editor.undo_label), ("redo", editor.redo_label))
    steps = " · ".join(f"{word}: {escape(label)}" for word, label in labels if label)
    return f"<small>{steps}</small>" if steps else ""


def edit_status(editor: SceneEditor, agent: AgentState, message: str) -> str:
    """Return the agent's name, the last message, and the undoable changes, as HTML."""
    lines = [f"<b>{escape(title(agent.id, agent.body))}</b>"]
    if message:
        lines.append(f'<span role="status" style="white-space: normal">{escape(message)}</span>')
    if editor.waits_for_reset:
        lines.append(f"<small>{WAITS}</small>")
    return section("<br>".join(filter(None, (*lines, undo_line(editor)))))


def _short(text: str) -> str:
    return text if len(text) <= MAX_LINE_CHARS else text[: MAX_LINE_CHARS - 1] + "…"
