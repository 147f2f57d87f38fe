"""The messages from a page to the input socket."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ai4u_edu.base.parameters import explain, format_problems

CODE = r"^[A-Za-z0-9]{1,24}$"
Code = Annotated[str, Field(pattern=CODE)]
"""Physical key, as in the browser's ``KeyboardEvent.code``."""


class _Message(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


Deflection = Annotated[float, Field(ge=-1, le=1, allow_inf_nan=False)]
"""Deflection of a stick along one axis, from -1 to 1."""


class StickPosition(_Message):
    """Position of a stick on the screen or a gamepad; ahead and to the right are positive."""

    forward: Deflection = 0.0
    turn: Deflection = 0.0


class Keys(_Message):
    """All keys that are held now, and the position of the stick.

    A page sends it at each change, and ten times a second while any key is held.
    """

    type: Literal["keys"]
    held: Annotated[list[Code], Field(max_length=16)]
    stick: StickPosition = StickPosition()


class Take(_Message):
    """Request for control."""

    type: Literal["take"]


class Release(_Message):
    """Release of control."""

    type: Literal["let_go"]


class Start(_Message):
    """Start of a world that waits for a key, by a key that the agent does not know."""

    type: Literal["start"]


class Command(_Message):
    """Command for the runner.

    ``reset`` begins an episode with the given seed; without one, with a new seed or the locked one.
    ``try_again`` repeats the present seed, ``new_start`` draws a new one. While the seed is locked
    (``lock_seed``, ``unlock_seed``), every other reset repeats it too.
    """

    type: Literal["command"]
    name: Literal["reset", "try_again", "new_start", "lock_seed", "unlock_seed", "pause", "resume"]
    seed: Annotated[int, Field(ge=0, lt=2**53)] | None = None


Message = Keys | Take | Release | Start | Command
_KINDS: dict[str, type[_Message]] = {
    "keys": Keys,
    "take": Take,
    "let_go": Release,
    "start": Start,
    "command": Command,
}
_READER: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Field(discriminator="type")])


def read(text: str | bytes) -> Message:
    """Return the message in a JSON text.

    Raises:
        ValueError: it is no such message; the text says what was expected.

    >>> read('{"type": "keys", "held": ["KeyW"]}')
    Keys(type='keys', held=['KeyW'], stick=StickPosition(forward=0.0, turn=0.0))
    >>> read('{"type": "kyes"}')
    Traceback (most recent call last):
    ...
    ValueError: unknown type 'kyes'; did you mean 'keys'?
    """
    try:
        return _READER.validate_json(text)
    except ValidationError as error:
        found = error.errors()
        if found[0]["type"] == "json_invalid":
            raise ValueError(f"expected JSON, got {text[:40]!r}: {found[0]['msg']}") from None
        kind = _KINDS.get(str(next(iter(found[0]["loc"]), "")), Keys)
        raise ValueError(format_problems(explain(found, kind.model_fields))) from None
