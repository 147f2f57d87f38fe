"""The WebSocket messages that a page sends, in their order."""

import re

from playwright.sync_api import Page, WebSocket

DRIVES = re.compile(r'"held":\["|"type":"(start|command)"')
"""Part of a message that holds keys, starts an episode, or asks for something else by a key."""


class SentFrames:
    """Records the texts that a page sends; make it before the page is opened."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._texts: list[str] = []
        page.on("websocket", self._listen)

    def take(self) -> list[str]:
        """Return those messages since the last call that would drive or start anything.

        A page sends a key's message before the key's event is over. So after a key was pressed,
        its message is among them, if there is one.
        """
        self._page.evaluate("0")  # the browser has told us of everything before its answer
        texts, self._texts = self._texts, []
        return [text for text in texts if DRIVES.search(text)]

    def _listen(self, socket: WebSocket) -> None:
        socket.on("framesent", self._note)

    def _note(self, frame: str | bytes) -> None:
        if isinstance(frame, str):
            self._texts.append(frame)
