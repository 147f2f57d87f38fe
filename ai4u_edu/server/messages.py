"""What a page may say: its keys, its wish to drive, a command."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ai4u_edu.parameters import explain

CODE = r"^[A-Za-z0-9]{1,24}$"
Code = Annotated[str, Field(pattern=CODE)]
"""A place on the keyboard, as ``KeyboardEvent.code`` has it."""


class _Said(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


class Keys(_Said):
    """All keys that are held now; said at each change, and ten times a second while any is."""

    type: Literal["keys"]
    held: Annotated[list[Code], Field(max_length=16)]


class Take(_Said):
    """The page wants to drive."""

    type: Literal["take"]


class Order(_Said):
    """Something for the runner."""

    type: Literal["command"]
    name: Literal["reset", "pause", "resume"]
    seed: Annotated[int, Field(ge=0, lt=2**53)] | None = None


Message = Keys | Take | Order
_KINDS: dict[str, type[_Said]] = {"keys": Keys, "take": Take, "command": Order}
_READER: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Field(discriminator="type")])


def read(text: str | bytes) -> Message:
    """A message out of its JSON.

    Raises:
        ValueError: it is none; the text says what was expected.

    >>> read('{"type": "keys", "held": ["KeyW"]}')
    Keys(type='keys', held=['KeyW'])
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
        raise ValueError("; ".join(map(str, explain(found, kind.model_fields)))) from None
