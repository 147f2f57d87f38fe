"""Permissions of pages on the machine that runs the world: hosts and files that they may name."""

from collections.abc import Iterator, Mapping
from pathlib import PurePath
from typing import Any

from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.blocks.brains.network import ZOO_PREFIX
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import BlockPath

LOCAL_HOSTS = frozenset({"127.0.0.1", "localhost", "::1"})

References = Iterator[tuple[BlockPath, str, str]]


class Permissions:
    """Hosts and files that edited scenes may name.

    The scene that the server was started with may name any. An edit from a page may add no other
    host than this machine, and no file outside the scene's folder.

    Args:
        named: the agents of the scene that the server was started with.
    """

    def __init__(self, named: Any) -> None:
        self._known = {(name, value) for _, name, value in external_references(named)}

    def check(self, agents: Any, path: BlockPath = ("agents",)) -> None:
        """Raise a ChangeError if agents name a host or a file that they may not."""
        problems = [
            ParameterProblem(at, text)
            for at, name, value in external_references(agents, path)
            if (name, value) not in self._known and (text := _fault(name, value))
        ]
        if problems:
            raise ChangeError(problems)


def _fault(name: str, value: str) -> str:
    if name == "host" and value not in LOCAL_HOSTS:
        return _(
            "a page can't have this machine connect to {host!r}; expected 127.0.0.1, or start "
            "the world with --brain ai4u://...",
            host=value,
        )
    path = PurePath(value)
    outside = path.is_absolute() or ".." in path.parts or "\\" in value or ":" in value
    if name == "model_path" and outside and not value.startswith(ZOO_PREFIX):
        return _(
            "expected zoo:SCENE, or a file that lies beside the scene, got {value!r}", value=value
        )
    return ""


def external_references(data: Any, path: BlockPath = ()) -> References:
    """Yield the hosts and files that blocks name: path, name of the parameter, value."""
    if isinstance(data, Mapping):
        for name, value in data.items():
            if name in {"host", "model_path"} and isinstance(value, str):
                yield (*path, str(name)), str(name), value
            else:
                yield from external_references(value, (*path, str(name)))
    elif isinstance(data, list | tuple):
        for index, value in enumerate(data):
            yield from external_references(value, (*path, index))
