"""What stands in the lists of the tab for blocks."""

from html import escape

from ai4u_edu.blocks.docs import summary
from ai4u_edu.editing import SceneEditor
from ai4u_edu.editing.blocks import BlockPath, Plain, block_at, block_paths, is_enabled, types_of
from ai4u_edu.snapshot import AgentState
from ai4u_edu.viewer.panel.agent_html import title
from ai4u_edu.viewer.panel.readings import block as paragraph

KINDS = {
    "Sensors": "sensors",
    "Actuators": "actuators",
    "Rewards": "rewards",
    "Brains": "brains",
}
BARE = '<div class="ai4u mark bare"></div>'
"""Before a group of buttons that needs no label: they get all of the width."""
NO_BLOCK = "choose a block"
ADD = "choose what to add"
WAITS = "Something waits for the next reset."
LONGEST = 72
"""Characters of a line in a list."""


def titles(agent: Plain, kind: str) -> dict[str, BlockPath]:
    """The blocks of a kind as lines of a list, each with its path; parts of a block below it."""
    found = {}
    for path in block_paths(agent, kind):
        block = block_at(agent, path)
        number = ".".join(str(part + 1) for part in path if isinstance(part, int))
        name = next(
            (block[key] for key in ("perception_key", "action_name", "name") if key in block), ""
        )
        off = "" if not isinstance(path[-1], int) or is_enabled(path, block) else " (off)"
        part = "" if isinstance(path[-1], int) else f".{path[-1]}"
        line = " ".join(filter(None, (f"{number}{part}", str(name), str(block["type"]))))
        found[_short(line) + off] = path
    return found


def menu(kind: str) -> dict[str, str]:
    """All types of a kind, each with a line that says what it is."""
    lines = {cls.__name__: summary(cls).split(" Source:")[0] for cls in types_of(kind)}
    return {_short(f"{name}: {line}"): name for name, line in lines.items()}


def marked(kind: str) -> str:
    """Marks the button of the kind that is chosen; viser's buttons can't be marked."""
    place = 1 + list(KINDS.values()).index(kind)
    return f'<div class="ai4u mark bare" data-on="{place}"></div>'


def said(editor: SceneEditor, agent: AgentState, message: str) -> str:
    """What happened last, and what could be taken back, as HTML."""
    lines = [f"<b>{escape(title(agent.id, agent.body))}</b>"]
    if message:
        lines.append(f'<span role="status" style="white-space: normal">{escape(message)}</span>')
    if editor.waits_for_reset:
        lines.append(f"<small>{WAITS}</small>")
    back, forth = editor.undo_label, editor.redo_label
    if back or forth:
        told = " · ".join(
            f"{word}: {escape(label)}" for word, label in (("undo", back), ("redo", forth)) if label
        )
        lines.append(f"<small>{told}</small>")
    return paragraph("<br>".join(lines))


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
