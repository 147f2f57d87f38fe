"""What a page may say: its keys and its stick, its wish to drive or not to, a command."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ai4u_edu.base.parameters import explain, listed

CODE = r"^[A-Za-z0-9]{1,24}$"
Code = Annotated[str, Field(pattern=CODE)]
"""A place on the keyboard, as ``KeyboardEvent.code`` has it."""


class _Said(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


Push = Annotated[float, Field(ge=-1, le=1, allow_inf_nan=False)]
"""How far a stick is pushed in one direction."""


class Pushed(_Said):
    """A stick, on the screen or of a gamepad; ahead and to the right are positive."""

    forward: Push = 0.0
    turn: Push = 0.0


class Keys(_Said):
    """All keys that are held now, and how far a stick is pushed.

    Said at each change, and ten times a second while any is.
    """

    type: Literal["keys"]
    held: Annotated[list[Code], Field(max_length=16)]
    stick: Pushed = Pushed()


class Take(_Said):
    """The page wants to drive."""

    type: Literal["take"]


class LetGo(_Said):
    """The page doesn't want to drive any more."""

    type: Literal["let_go"]


class Order(_Said):
    """Something for the runner."""

    type: Literal["command"]
    name: Literal["reset", "pause", "resume"]
    seed: Annotated[int, Field(ge=0, lt=2**53)] | None = None


Message = Keys | Take | LetGo | Order
_KINDS: dict[str, type[_Said]] = {"keys": Keys, "take": Take, "let_go": LetGo, "command": Order}
_READER: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Field(discriminator="type")])


def read(text: str | bytes) -> Message:
    """A message out of its JSON.

    Raises:
        ValueError: it is none; the text says what was expected.

    >>> read('{"type": "keys", "held": ["KeyW"]}')
    Keys(type='keys', held=['KeyW'], stick=Pushed(forward=0.0, turn=0.0))
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
        raise ValueError(listed(explain(found, kind.model_fields))) from None
