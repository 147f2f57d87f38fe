"""The messages that viser's page sends to viser: the kinds that our page uses, typed and bounded.

viser sets any attribute of a widget that a message names, casts any value, and keeps state for
forms and files that a message makes up. So no message gets to viser as it is: it is decoded
strictly, against the types below, and viser gets the encoding of the result. A frame that two
decoders read differently does no harm. See
``docs/adr/0002-check-what-pages-send-before-viser.md``.

The fields are those of viser's own classes of the same name; a test compares them.
"""

import sys
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from ai4u_edu.base.limits import MAX_EXACT_INT
from ai4u_edu.locale import gettext as _

MAX_VALUE_CHARS = 200_000
"""Characters of a widget's value; the viewer takes fewer, and tells the page when it does not."""
MAX_SCENE_LENGTH = 1e12
"""Largest coordinate (m) of cameras and pointers: many times the largest world's."""
MAX_PIXELS = 100_000
"""Largest width and height of a window."""

Id = Annotated[str, Meta(max_length=64)]
Name = Annotated[str, Meta(max_length=256)]
# a comparison with NaN is false, so bounds refuse it too
Length = Annotated[float, Meta(ge=-MAX_SCENE_LENGTH, le=MAX_SCENE_LENGTH)]
Pixels = Annotated[float, Meta(ge=0, le=MAX_PIXELS)]
Whole = Annotated[int, Meta(ge=-MAX_EXACT_INT, le=MAX_EXACT_INT)]
Finite = Annotated[float, Meta(ge=-sys.float_info.max, le=sys.float_info.max)]
Text = Annotated[str, Meta(max_length=MAX_VALUE_CHARS)]
Point = tuple[Length, Length, Length]
ScreenPoint = tuple[Length, Length]
Modifier = (
    Literal[
        "cmd/ctrl",
        "alt",
        "shift",
        "cmd/ctrl+alt",
        "cmd/ctrl+shift",
        "alt+shift",
        "cmd/ctrl+alt+shift",
    ]
    | None
)


class _Message(msgspec.Struct, tag_field="type", tag=True, forbid_unknown_fields=True):
    """A message; its class's name is its ``type``."""


class Updates(msgspec.Struct, forbid_unknown_fields=True):
    """The only attribute of a widget that a page may set."""

    value: bool | Whole | Finite | Text


class GuiUpdateMessage(_Message):
    """Change of a widget's value, or press of a button."""

    uuid: Id
    updates: Updates


class CommandTriggerMessage(_Message):
    """Press of a hotkey: Escape, while something is dragged."""

    uuid: Id


class ViewerCameraMessage(_Message):
    """Pose of the page's camera; viser counts a page as connected from its first one on."""

    wxyz: tuple[Length, Length, Length, Length]
    position: Point
    fov: Length
    near: Length
    far: Length
    image_height: Pixels
    image_width: Pixels
    look_at: Point
    up_direction: Point


class SceneNodeClickMessage(_Message):
    """Click on something in the scene."""

    name: Name
    instance_index: Whole | None
    ray_origin: Point
    ray_direction: Point
    screen_pos: ScreenPoint
    modifier: Modifier
    owner: Id = ""


class SceneNodeDragMessage(_Message):
    """Drag of something in the scene."""

    phase: Literal["start", "update", "end"]
    name: Name
    instance_index: Whole | None
    start_position: Point
    start_screen_pos: ScreenPoint
    end_position: Point
    end_screen_pos: ScreenPoint
    button: Literal["left", "middle", "right"]
    modifier: Modifier
    owner: Id = ""


KINDS: tuple[type[_Message], ...] = (
    GuiUpdateMessage,
    CommandTriggerMessage,
    ViewerCameraMessage,
    SceneNodeClickMessage,
    SceneNodeDragMessage,
)
_DECODER = msgspec.msgpack.Decoder(
    GuiUpdateMessage
    | CommandTriggerMessage
    | ViewerCameraMessage
    | SceneNodeClickMessage
    | SceneNodeDragMessage
)
_ENCODER = msgspec.msgpack.Encoder()


class MalformedError(ValueError):
    """The bytes are not msgpack: no page of viser's has sent them."""


def checked(frame: bytes) -> bytes:
    """Decode a message strictly, and return the encoding of the result.

    Raises:
        MalformedError: it is no msgpack.
        ValueError: it is no message that a page may send; the text says what was expected.

    >>> from msgspec.msgpack import decode, encode
    >>> update = {"type": "GuiUpdateMessage", "uuid": "1", "updates": {"value": 3}}
    >>> decode(checked(encode(update))) == update
    True
    >>> checked(encode(update | {"updates": {"value": 3, "update_cb": []}}))
    Traceback (most recent call last):
    ...
    ValueError: Object contains unknown field `update_cb` - at `$.updates`
    """
    try:
        return _ENCODER.encode(_DECODER.decode(frame))
    except msgspec.ValidationError as error:
        raise ValueError(f"{error!s:.200}") from None
    except (msgspec.DecodeError, ValueError, RecursionError) as error:
        raise MalformedError(
            _("expected a message as msgpack: {error!s:.200}", error=str(error))
        ) from None
