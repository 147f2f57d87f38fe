"""What a page may not ask of the machine that runs the world."""

from collections.abc import Iterator, Mapping
from pathlib import PurePath
from typing import Any

from ai4u_edu.base.parameters import Problem
from ai4u_edu.blocks.brains.network import IN_THE_ZOO
from ai4u_edu.editing.errors import ChangeError

HERE = frozenset({"127.0.0.1", "localhost", "::1"})

Found = Iterator[tuple[tuple[str | int, ...], str, str]]


class Trust:
    """Which machines and files the scenes of this room may name.

    Whoever starts the world names a scene, and with it whatever that says. Who comes by a page
    can name no other machine, and no file that does not lie beside the scene.

    Args:
        named: the agents of the scene that the world was started with.
    """

    def __init__(self, named: Any) -> None:
        self._known = {(name, value) for _, name, value in outward(named)}

    def check(self, agents: Any, where: tuple[str | int, ...] = ("agents",)) -> None:
        """Raises ChangeError if they name what they may not."""
        problems = [
            Problem(path, text)
            for path, name, value in outward(agents, where)
            if (name, value) not in self._known and (text := _fault(name, value))
        ]
        if problems:
            raise ChangeError(problems)


def _fault(name: str, value: str) -> str:
    if name == "host" and value not in HERE:
        return (
            f"a page can't have this machine connect to {value!r}; expected 127.0.0.1, or start "
            "the world with --brain ai4u://..."
        )
    path = PurePath(value)
    outside = path.is_absolute() or ".." in path.parts or "\\" in value or ":" in value
    if name == "model_path" and outside and not value.startswith(IN_THE_ZOO):
        return f"expected zoo:SCENE, or a file that lies beside the scene, got {value!r}"
    return ""


def outward(data: Any, path: tuple[str | int, ...] = ()) -> Found:
    """All hosts and files that blocks name: path, name of the parameter, value."""
    if isinstance(data, Mapping):
        for name, value in data.items():
            if name in {"host", "model_path"} and isinstance(value, str):
                yield (*path, str(name)), str(name), value
            else:
                yield from outward(value, (*path, str(name)))
    elif isinstance(data, list | tuple):
        for index, value in enumerate(data):
            yield from outward(value, (*path, index))
