"""Where frames begin and end in a stream of bytes, without reading them."""

LONGEST_HEAD = 14


class Boundary:
    r"""Whether a WebSocket's stream stands between two frames.

    >>> boundary = Boundary()
    >>> boundary.feed(b"\x82\x85mask")  # of five bytes, none is there yet
    >>> boundary.is_reached
    False
    >>> boundary.feed(b"hello")
    >>> boundary.is_reached
    True
    """

    def __init__(self) -> None:
        self._head = b""
        self._owed = 0

    @property
    def is_reached(self) -> bool:
        """Whether the next byte is the first one of a frame."""
        return not self._owed and not self._head

    def feed(self, data: bytes) -> None:
        """More of the stream."""
        data, self._head = self._head + data, b""
        place = self._owed
        while place < len(data):
            size = _size(data[place : place + LONGEST_HEAD])
            if not size:
                self._head = data[place:]
                self._owed = 0
                return
            place += size
        self._owed = place - len(data)


def _size(head: bytes) -> int:
    """Bytes of the frame that begins so; 0 if that can't be told yet."""
    if len(head) < 2:
        return 0
    length, more = head[1] & 0x7F, 0
    if length > 125:
        more = 2 if length == 126 else 8
        if len(head) < 2 + more:
            return 0
        length = int.from_bytes(head[2 : 2 + more], "big")
    return 2 + more + (4 if head[1] & 0x80 else 0) + length
