"""The form of one block, on one page."""

from collections.abc import Callable, Coroutine
from html import escape
from typing import Any

from viser import ClientHandle

from ai4u_edu.editing.blocks import BlockPath, Plain
from ai4u_edu.editing.forms import block_form, block_summary
from ai4u_edu.editing.names import SceneNames
from ai4u_edu.viewer.panel.field_form import FieldForm


class BlockForm(FieldForm):
    """The parameters of one block.

    Args:
        client: the page; the form comes to stand where its ``gui`` is.
        block: as data.
        path: of the block in its agent.
        names: what there is in the scene.
        on_apply: called when the form is handed in.
    """

    def __init__(
        self,
        client: ClientHandle,
        block: Plain,
        path: BlockPath,
        names: SceneNames,
        on_apply: Callable[[Any], Coroutine[Any, Any, None]],
    ) -> None:
        self._block, self._path, self._names = block, path, names
        heading = (
            f"<b>{escape(str(block['type']))}</b><br><small>{escape(block_summary(block))}</small>"
        )
        super().__init__(client, heading, block_form(block, names), on_apply)

    def takes(self, block: Plain | None, path: BlockPath | None) -> bool:
        """Shows a block as it is now, if it is still the one whose form this is."""
        if block is None or path != self._path or block["type"] != self._block["type"]:
            return False
        if block == self._block:
            return True
        if not self.shows(block_form(block, self._names)):
            return False
        self._block = block
        return True
