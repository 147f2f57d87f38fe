"""Commands that change agents, things and the scene."""

from typing import Annotated

import msgspec
from msgspec import Meta

from ai4u_edu.page.panel.messages.base import (
    Command,
    Degrees,
    Kind,
    Metres,
    Name,
    Number,
    Path,
    Values,
)


class ListDrivers(Command, tag="drivers"):
    """List the drivers that the agent can have."""


class SetDriver(Command, tag="driver"):
    """Choose the agent's driver."""

    name: Name
    agent: Name | None = None


class ListBlocks(Command, tag="gallery"):
    """List the blocks that can be added."""

    kind: Kind


class AddBlock(Command, tag="add_block"):
    """Add a block to the agent, or to one of its blocks."""

    type_name: Name = msgspec.field(name="class")
    parent: Path
    index: Annotated[int, Meta(ge=0, le=1000)] | None = None


class RemoveBlock(Command, tag="remove_block"):
    """Remove a block of the agent."""

    path: Path


class MoveBlock(Command, tag="move_block"):
    """Move a block of the agent up (-1) or down (1)."""

    path: Path
    by: Annotated[int, Meta(ge=-1000, le=1000)]


class SwitchBlock(Command, tag="switch_block"):
    """Switch a block of the agent on or off."""

    path: Path
    on: bool


class DuplicateBlock(Command, tag="duplicate_block"):
    """Add a copy of a block of the agent."""

    path: Path


class ChangeBlock(Command, tag="change_block"):
    """Change parameters of a block of the agent."""

    path: Path
    values: Values


class ChangeAgent(Command, tag="change_agent"):
    """Change parameters of the agent itself."""

    values: Values


class Undo(Command, tag="undo"):
    """Take back the last change."""


class Redo(Command, tag="redo"):
    """Make the change again that was undone last."""


class MoveMode(Command, tag="move_mode"):
    """Let the user move things with the mouse, or not."""

    on: bool


class Snap(Command, tag="snap"):
    """Set the grid (m) to which moved things snap; 0 for none."""

    distance: Annotated[float, Meta(ge=0, le=100)]


class SelectBody(Command, tag="select"):
    """Select a thing."""

    body: Name | None


class AddBody(Command, tag="add_body"):
    """Add a thing, by default where there is room in the picture (m)."""

    template: Name
    x: Metres | None = None
    y: Metres | None = None


class DuplicateBody(Command, tag="duplicate_body"):
    """Add a copy of a thing."""

    name: Name


class ChangeBody(Command, tag="change_body"):
    """Change properties of a thing."""

    name: Name
    values: Values


class MoveBody(Command, tag="move_body"):
    """Put a thing somewhere (m, degrees)."""

    name: Name
    x: Metres
    y: Metres
    heading_deg: Degrees | None = None


class Nudge(Command, tag="nudge"):
    """Move a thing a bit (m, degrees)."""

    name: Name
    dx: Metres = 0.0
    dy: Metres = 0.0
    turn_deg: Degrees = 0.0


class RemoveBody(Command, tag="remove_body"):
    """Delete a thing; the body of an agent goes with its agent."""

    name: Name


class ChangeSettings(Command, tag="change_settings"):
    """Change texts or settings of the scene."""

    values: Values


class ListScenes(Command, tag="scenes"):
    """List the scenes that can be opened."""


class OpenScene(Command, tag="open_scene"):
    """Open a scene of the library, or a saved one."""

    name: Name
    is_saved: bool = False


class SaveScene(Command, tag="save_scene"):
    """Save the scene under a name."""

    name: Name
    over: bool = False


class Download(Command, tag="download"):
    """Return the scene's file."""


class LoadText(Command, tag="load_text"):
    """Open the scene file that was sent in binary messages before."""

    name: Name
    size: Number


class Restore(Command, tag="restore"):
    """Open the unsaved scene."""


class Discard(Command, tag="discard"):
    """Delete the unsaved scene."""
