"""Bounded types of fields, and the messages that all others build on."""

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

from ai4u_edu.base.limits import MAX_EXACT_INT

MAX_NAME_CHARS = 200
MAX_PATH_PARTS = 12
MAX_FIELDS = 200
"""Most values of a form."""

Name = Annotated[str, Meta(max_length=MAX_NAME_CHARS)]
Number = Annotated[int, Meta(ge=0, le=MAX_EXACT_INT)]
Path = Annotated[list[str | int], Meta(min_length=1, max_length=MAX_PATH_PARTS)]
Values = Annotated[dict[str, Any], Meta(max_length=MAX_FIELDS)]
Metres = Annotated[float, Meta(ge=-1e4, le=1e4)]
Degrees = Annotated[float, Meta(ge=-3600, le=3600)]
Seed = Annotated[str, Meta(pattern=r"^[0-9]{1,40}$")]
"""A whole number as text: JavaScript rounds those above 2**53."""
Kind = Literal["sensors", "actuators", "rewards", "brains"]
Tab = Literal["agent", "blocks", "world", "past"]


class Show(Struct, forbid_unknown_fields=True):
    """The whole of what a page looks at; only the parts of open tabs are sent."""

    type: Literal["show"]
    agent: Name
    tabs: Annotated[list[Tab], Meta(max_length=4)] = []
    block: Path | None = None
    body: Name | None = None
    episode: Number | None = None


class Command(Struct, forbid_unknown_fields=True, tag_field="command"):
    """A command; the answer has the same ``id``."""

    type: Literal["do"]
    id: Number
