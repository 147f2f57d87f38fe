"""The form for one block's parameters, on one page."""

from collections.abc import Callable, Coroutine
from html import escape
from typing import Any

from viser import ClientHandle

from ai4u_edu.editing.forms import block_form, block_summary
from ai4u_edu.editing.plain import BlockPath, Plain
from ai4u_edu.editing.scene_names import SceneNames
from ai4u_edu.viewer.panel.field_form import FieldForm


class BlockForm(FieldForm):
    """The form for one block's parameters.

    Args:
        client: the page; the form is added to the current container of its ``gui``.
        block: the block, as plain data.
        path: the block's path in its agent.
        names: names in the scene, for choices.
        on_apply: called when the form is submitted.
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

    def show_block(self, block: Plain | None, path: BlockPath | None) -> bool:
        """Show a block's current values; return False if the block needs another form."""
        if block is None or path != self._path or block["type"] != self._block["type"]:
            return False
        if block == self._block:
            return True
        if not self.show_fields(block_form(block, self._names)):
            return False
        self._block = block
        return True
