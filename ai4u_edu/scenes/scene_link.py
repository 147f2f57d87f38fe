"""Links that hold a whole scene in their fragment, the part after ``#``.

A browser does not send a fragment to the server, so a shared scene is uploaded nowhere. The
fragment is ``scene=DATA&seed=NUMBER``; DATA is the scene's YAML text, compressed by zlib, in base64
for addresses. A scene in a link is data only: no Python code, and no files that the scene names. A
page may add a student's program (``&program=``, see ``web/scenes/program_link.js``), which pages
offer in their tab "Code" and which is ignored here.
"""

import re
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from typing import NamedTuple
from urllib.parse import parse_qsl

from ai4u_edu.base.errors import SceneError
from ai4u_edu.base.seeding import MAX_SEED, checked_seed
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS

MAX_LINK_CHARS = 100_000
"""Size of a link: browsers, and an argument of a command, can have no more than about that. A scene
with 500 bodies takes a tenth of it."""
MAX_TEXT_BYTES = 4 * MAX_SCENE_CHARS
"""Size of a scene's text in a link when it is decompressed; no character takes more bytes."""
LINK = _("the link")
"""Name of a link in error messages, in place of a file's."""
_LINK = re.compile(r"(https?://[^#]*)?#?scene=")
_DATA = re.compile(r"[A-Za-z0-9_-]+")


class SceneLink(NamedTuple):
    """Content of a link."""

    text: str
    """The scene as YAML text, which nobody has checked yet."""
    seed: int | None
    """The seed of the first episode, from 0; None if the link has none."""


def is_link(text: str) -> bool:
    """Return True if a text is meant as a link to a scene, whole or the fragment alone.

    >>> [is_link(each) for each in ("http://a/#scene=x", "#scene=x", "scene=x", "maze", "a.yaml")]
    [True, True, True, False, False]
    """
    return _LINK.match(text.strip()) is not None


def encode_link(text: str, seed: int | None = None) -> str:
    """Return the fragment of a link, without ``#``.

    Args:
        text: the scene as YAML text.
        seed: of the episode to begin with.

    Raises:
        SceneError: the scene is too large for a link.

    >>> decode_link(encode_link("name: x", 7))
    SceneLink(text='name: x', seed=7)
    """
    data = urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")
    link = f"scene={data}" + ("" if seed is None else f"&seed={seed}")
    if len(link) > MAX_LINK_CHARS or len(text) > MAX_SCENE_CHARS:
        raise SceneError(
            _(
                "expected a scene that fits into a link of {max_link_chars} characters, got one "
                "that takes {count}; download the scene and share its file",
                max_link_chars=MAX_LINK_CHARS,
                count=len(link),
            )
        )
    return link


def decode_link(link: str) -> SceneLink:
    """Read a link.

    Args:
        link: the whole link, or its fragment. Spaces and line breaks, as a mail puts into long
            lines, are ignored.

    Raises:
        SceneError: it is no link to a scene, it is damaged, or its content is too large.

    >>> decode_link("http://host:8080/#scene=eNrLS8xNtVKoAAAKagJ0&seed=7")
    SceneLink(text='name: x', seed=7)
    """
    if len(link) > 2 * MAX_LINK_CHARS:
        raise SceneError(
            _(
                "{link}: expected at most {max_link_chars} characters, got {count}; ask for the "
                "scene's file",
                link=LINK,
                max_link_chars=MAX_LINK_CHARS,
                count=len(link),
            )
        )
    link = "".join(link.split())
    if not is_link(link):
        raise SceneError(
            _(
                "{link}: expected #scene=..., got {link2}; copy the whole link again",
                link=LINK,
                link2=repr(link[:40]),
            )
        )
    values = dict(parse_qsl(link.rpartition("#")[2], keep_blank_values=True))
    return SceneLink(_text(values.get("scene", "")), _seed(values.get("seed")))


def _text(data: str) -> str:
    """Return the scene's text; the size is checked while it is decompressed."""
    if len(data) > MAX_LINK_CHARS:
        raise SceneError(
            _(
                "{link}: expected at most {max_link_chars} characters, got {count}; ask for the "
                "scene's file",
                link=LINK,
                max_link_chars=MAX_LINK_CHARS,
                count=len(data),
            )
        )
    if not _DATA.fullmatch(data):
        raise _damaged()
    unpacking = zlib.decompressobj()
    try:
        packed = urlsafe_b64decode(data + "=" * (-len(data) % 4))
        text = unpacking.decompress(packed, MAX_TEXT_BYTES + 1)
        if len(text) > MAX_TEXT_BYTES:
            raise SceneError(
                _(
                    "{link}: expected a scene of at most {max_text_bytes} bytes, got a larger "
                    "one; it was not made by AI4U Edu",
                    link=LINK,
                    max_text_bytes=MAX_TEXT_BYTES,
                )
            )
        if not unpacking.eof or unpacking.unused_data:
            raise _damaged()
        return text.decode()
    except (ValueError, zlib.error):  # no base64, no zlib or another checksum, no UTF-8
        raise _damaged() from None


def _seed(text: str | None) -> int | None:
    if text is None:
        return None
    if not re.fullmatch(r"[0-9]{1,19}", text):
        raise SceneError(
            _(
                "{link}: expected a seed from 0 to {max_seed}, got {text}; copy the whole link "
                "again",
                link=LINK,
                max_seed=MAX_SEED,
                text=repr(text[:40]),
            )
        )
    return checked_seed(int(text))


def _damaged() -> SceneError:
    return SceneError(
        _(
            "{link} is damaged: a part of it is missing or was changed; copy the whole link again",
            link=LINK,
        )
    )
