"""A scene as plain data, for a job that may run on another machine."""

import json
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import SceneError, shorten
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.scene import Scene

SceneData = dict[str, Any]
"""The ``name`` of a library's scene; of a file its name, ``text`` and ``folder``; and the Python
files of the ``blocks`` that it needs, which have to lie at the same paths on each machine."""


def scene_data(source: str, own_blocks: Iterable[Path] = ()) -> SceneData:
    """Return a scene as data.

    Args:
        source: a name in the library, or the path of a YAML file.
        own_blocks: Python files with blocks that the scene needs; they are loaded already.

    Raises:
        SceneError: it does not exist, or something in it is wrong.

    >>> scene_data("sumo")
    {'name': 'sumo'}
    """
    scene = Scene.load(source)
    path = Path(source)
    data: SceneData = {"name": source}
    if path.suffix in {".yaml", ".yml"}:
        data = {"name": path.name, "text": scene.source, "folder": str(scene.folder)}
    blocks = [str(file.absolute()) for file in own_blocks]
    return data | ({"blocks": blocks} if blocks else {})


def scene_from(data: Mapping[str, Any]) -> Scene:
    """Return the scene of some data; the same object for equal data.

    Raises:
        AI4UError: there is no such scene or file here, or something in it is wrong.
    """
    return _scene(json.dumps(data, sort_keys=True))


@lru_cache(maxsize=4)  # a process has many jobs of one scene
def _scene(text: str) -> Scene:
    data = json.loads(text)
    wanted = {"name"} | ({"text", "folder"} if "text" in data else set())
    blocks = data.get("blocks", [])
    texts = [data.get(name) for name in wanted] + (blocks if isinstance(blocks, list) else [None])
    if data.keys() - {"blocks"} != wanted or not all(isinstance(each, str) for each in texts):
        raise SceneError(
            _(
                "expected a scene as data, with {names}, got {data}",
                names=", ".join(sorted(wanted)),
                data=shorten(text, 200),
            )
        )
    for file in data.get("blocks", ()):
        _load_blocks(Path(file))
    if "text" not in data:
        return Scene.load(data["name"])
    return Scene.loads(data["text"], name=data["name"], folder=Path(data["folder"]))


_load_blocks = lru_cache(maxsize=None)(load_blocks)
