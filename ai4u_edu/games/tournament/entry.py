"""Entries of a tournament as data."""

import base64
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, field_validator

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import Block, Controller
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.brains.network import MAX_LOADED_NETWORK_BYTES, ZOO_PREFIX, find_network
from ai4u_edu.games.tournament.sides import Sides
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.episode import MAX_RECORDING_BYTES
from ai4u_edu.scenes.serialization import is_serializable

MAX_NAME_CHARS = 40
MAX_KEPT_NAME_CHARS = 200
"""Limit in a tournament's file; in a class, names come from elsewhere."""
MAX_SOURCE_BYTES = 200_000
FORMS = _(
    "a network (FILE.onnx, zoo:SCENE), a controller's name, scene (the scene's "
    "own scripted controllers), random, a recorded episode (FILE.episode), or a "
    "program (FILE.py, FILE.py:NAME)"
)

Driver = dict[str, str]
"""Description of a driver: its ``kind``, and the content of its file."""

PARTS = {
    "network": {"file", "data"},
    "episode": {"file", "data"},
    "python": {"file", "data", "name"},
    "controller": {"type"},
    "scene": set[str](),
    "random": set[str](),
}
"""Kinds of drivers, with what describes one besides its kind."""


class Entry(BaseModel):
    """An entry: a name, and what drives each part of a side."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: Annotated[str, Field(min_length=1, max_length=MAX_KEPT_NAME_CHARS)]
    drivers: dict[str, Driver]
    """Drivers by the id, role or side of agents; "" for all others."""

    @field_validator("drivers")
    @classmethod
    def _check_drivers(cls, drivers: dict[str, Driver]) -> dict[str, Driver]:
        for each in drivers.values():
            kind = each.get("kind", "")
            if kind not in PARTS or each.keys() != {"kind", *PARTS[kind]}:
                raise ValueError(
                    _(
                        "expected a driver of {parts}, got {kind!r}",
                        parts=", ".join(PARTS),
                        kind=kind,
                    )
                )
        return drivers

    @property
    def can_repeat(self) -> bool:
        """True if it plays the same game again: it runs no program of its owner."""
        return all(each["kind"] != "python" for each in self.drivers.values())


def parse_entry(text: str, sides: Sides, *, scene: str = "", trust_python: bool = False) -> Entry:
    """Return the entry that a text of the command line describes, with the content of its files.

    Args:
        text: ``SPEC`` or ``NAME=SPEC``, where SPEC may be ``PART:SPEC,PART:SPEC``.
        sides: of the scene.
        scene: the scene's name, for ``zoo``.
        trust_python: True accepts Python files.

    Raises:
        SetupError: there is no such driver, or a file can't be read.
    """
    name, equals, spec = text.partition("=")
    if not equals or Path(text).exists():
        name, spec = "", text
    pieces = [each.partition(":") for each in spec.split(",")]
    if all(colon and part in sides.parts for part, colon, _ in pieces):
        specs = {part: rest for part, _, rest in pieces}
    else:
        specs = {"": spec}
    drivers = {part: _driver(each, scene, trust_python) for part, each in specs.items()}
    name = name.strip() or Path(next(iter(specs.values())).rpartition(".py:")[2] or "entry").stem
    if not re.fullmatch(r"[^\x00-\x1f\x7f]+", name) or len(name) > MAX_NAME_CHARS:
        raise SetupError(
            _(
                "expected an entry's name of at most {most} printable characters, as in "
                "NAME=SPEC, got {name!r}",
                most=MAX_NAME_CHARS,
                name=name[:60],
            )
        )
    return Entry(name=name, drivers=drivers)


def with_names(entries: Iterable[Entry]) -> tuple[Entry, ...]:
    """Return entries with different names; a number is added where a name comes again."""
    taken: set[str] = set()
    found = []
    for each in entries:
        name, number = each.name, 1
        while name in taken:
            number += 1
            name = f"{each.name[: MAX_NAME_CHARS - 4]}-{number}"
        taken.add(name)
        found.append(each.model_copy(update={"name": name}))
    return tuple(found)


def _driver(spec: str, scene: str, trust_python: bool) -> Driver:
    spec = spec.strip()
    if spec in ("scene", "random"):
        return {"kind": spec}
    spec = f"{ZOO_PREFIX}{scene}" if spec == "zoo" else spec
    path = Path(spec)
    if spec.startswith(ZOO_PREFIX) or path.suffix == ".onnx":
        return file_driver("network", find_network(spec), MAX_LOADED_NETWORK_BYTES)
    if path.suffix == ".episode":
        return file_driver("episode", path, MAX_RECORDING_BYTES)
    file, colon, name = spec.rpartition(":")
    file, name = (file, name) if colon and file.endswith(".py") else (spec, "")
    if file.endswith(".py"):
        if not trust_python:
            raise SetupError(
                _(
                    "{file}: a Python file may do on this machine what you may; read it, then "
                    "say --trust-python to let it play (in a process of its own, with limits)",
                    file=file,
                )
            )
        return file_driver("python", Path(file), MAX_SOURCE_BYTES) | {"name": name}
    known = {name: cls for name, cls in Block.types.items() if _is_driver(cls)}
    if spec in known:
        return {"kind": "controller", "type": spec}
    raise SetupError(
        _(
            "nobody is called {spec!r}: expected {forms}; {hint}",
            spec=spec,
            forms=FORMS,
            hint=suggest(spec, known),
        )
    )


def _is_driver(cls: type[Block]) -> bool:
    return (
        issubclass(cls, Controller)
        and is_serializable(cls)
        and not any(field.is_required() for field in cls.parameters().values())
        and not listens_to_keys(cls)
    )


def file_driver(kind: str, path: Path, limit: int) -> Driver:
    """Return a driver with the content of a file.

    Args:
        kind: of the driver.
        path: of the file.
        limit: largest size (bytes).

    Raises:
        SetupError: the file can't be read, or is larger.
    """
    try:
        with path.open("rb") as file:
            data = file.read(limit + 1)
    except OSError as error:
        raise SetupError(
            _("{path}: can't be read: {reason}", path=str(path), reason=error.strerror or "")
        ) from None
    if len(data) > limit:
        raise SetupError(_("{path}: expected at most {limit:,} bytes", path=str(path), limit=limit))
    return {"kind": kind, "file": path.name, "data": base64.b64encode(data).decode()}
