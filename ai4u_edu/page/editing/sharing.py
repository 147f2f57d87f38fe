"""Links to share a running world's scene, and scenes read from such links."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from ai4u_edu.base.errors import SceneError
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.blocks.brains.network import ZOO_PREFIX
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.permissions import LOCAL_HOSTS, Permissions, external_references
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene_link import LINK, decode_link, encode_link
from ai4u_edu.scenes.yaml.file import YamlFile


class SharedScene(NamedTuple):
    """A scene from a link, and the seed of the episode to begin with, from 0, or None."""

    scene: Scene
    seed: int | None


class SharedLink(NamedTuple):
    """A link's fragment, without ``#``, and things that it can't carry."""

    fragment: str
    needs: tuple[str, ...]
    """Files, own blocks and hosts that the scene names."""


def read_shared(link: str) -> SharedScene:
    """Read a scene from a link that a person gives to a command.

    Whoever made the link may name no other hosts and files than a page may.

    Raises:
        AI4UError: the link or its scene can't be used.
    """
    content = decode_link(link)
    Permissions(()).check(YamlFile(content.text, LINK).data.get("agents", ()))
    return SharedScene(Scene.loads(content.text, name=LINK), content.seed)


def shared_link(scene: Scene, seed: int | None) -> SharedLink:
    """Make a link to a scene.

    Args:
        scene: the scene.
        seed: of the episode to begin with.

    Raises:
        SceneError: the scene is too large for a link, or has pictures on the ground.
    """
    if scene.description.pictures:
        raise SceneError(
            _(
                "a link can't carry the picture on the ground; download the scene and send its "
                "file, which has the picture"
            )
        )
    agents = scene.description.agents
    needs = [*_own_blocks(agents), *_references(agents)]
    return SharedLink(encode_link(scene.dumps(), seed), tuple(dict.fromkeys(needs)))


def _own_blocks(data: Any) -> Iterator[str]:
    """Yield the types of blocks that are not built in."""
    if isinstance(data, Mapping):
        cls = Block.types.get(str(data.get("type", "")))
        if cls is not None and not is_built_in(cls):
            yield cls.__name__
        for value in data.values():
            yield from _own_blocks(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from _own_blocks(value)


def _references(agents: Any) -> Iterator[str]:
    for _path, name, value in external_references(agents):
        if value not in LOCAL_HOSTS and not (name == "model_path" and value.startswith(ZOO_PREFIX)):
            yield value
