"""YAML text to plain data with line numbers, and plain data to YAML text."""

import io
import re
import textwrap
import zlib
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from ai4u_edu.base.errors import SceneError, text_of
from ai4u_edu.base.parameters import DataPath
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.scenes.yaml.messages import shown
from ai4u_edu.scenes.yaml.tree import HAS_LIBYAML, NotYamlError, read_tree
from ai4u_edu.world.pictures import MAX_PICTURE_BYTES, MAX_PICTURE_CHARS, picture_data

MAX_SCENE_CHARS = 300_000 if HAS_LIBYAML else 50_000
"""Size of a scene file: any text of that size is read within a second. One with 500 bodies has
60,000. The data of pictures don't count, which are read as fast as copied."""
MAX_SCENE_BYTES = 4 * MAX_SCENE_CHARS + MAX_PICTURE_CHARS
"""Size of a scene file with pictures; no character takes more bytes."""
EXPECTED = _("lines such as name: ..., bodies: ..., agents: ...")
"""The first keys of a scene file, for messages."""
MAX_LINE_CHARS = 10_000_000
"""Line width at which ruamel never folds a text."""


class YamlFile:
    r"""A parsed file.

    Args:
        text: YAML.
        name: of the file, for messages.
        expected: the expected content, for messages.

    Raises:
        SceneError: it can't be read; the message names the line.

    >>> file = YamlFile("name: x\nbodies:\n  - name: box", "a.yaml")
    >>> file.data
    {'name': 'x', 'bodies': [{'name': 'box'}]}
    >>> file.line(("bodies", 0, "name"))
    3
    """

    def __init__(self, text: str, name: str, expected: str = EXPECTED) -> None:
        self.name = name
        if (count := count_chars(text)) > MAX_SCENE_CHARS:
            raise SceneError(
                _(
                    "{name}: expected at most {max_scene_chars} characters, got {count}",
                    name=name,
                    max_scene_chars=MAX_SCENE_CHARS,
                    count=count,
                )
            )
        try:
            self._tree = read_tree(text)
        except NotYamlError as problem:
            there = shown(text, problem.line, problem.column)
            told = join([_place(name, problem), text_of(problem)], ": ")
            raise SceneError(join([told, there], "")) from None
        if not isinstance(self._tree.data, dict):
            raise SceneError(
                _(
                    "{name}: expected {expected}, got {kind}",
                    name=name,
                    expected=expected,
                    kind=_kind(self._tree.data, text),
                )
            )
        self.data: dict[str, Any] = self._tree.data

    def line(self, path: DataPath) -> int:
        """Return the line (from 1) of the value at a path, or of its nearest parent."""
        node, line = self._tree, 1
        for part in path:
            if part not in node.parts:
                break
            node = node.parts[part]
            line = node.line
        return line


_PICTURE_DATA = re.compile(r"data:image/(?:png|jpeg);base64,[A-Za-z0-9+/=]{1000,}")


def count_chars(text: str) -> int:
    """Return the length of a scene's text without the data of its pictures."""
    if len(text) <= MAX_SCENE_CHARS:
        return len(text)
    pictures = sum(match.end() - match.start() for match in _PICTURE_DATA.finditer(text))
    return len(text) - min(pictures, MAX_PICTURE_CHARS)


_PICTURE_FILE = re.compile(r"[\w][\w .-]*\.(png|jpg|jpeg)", re.IGNORECASE)
"""Name of a picture's file beside the scene's; so it leads to no other folder."""


def with_pictures(text: str, name: str, folder: Path | None) -> str:
    """Return a scene's text with the data of pictures in place of their files' names.

    A scene has its pictures from here on: whatever copies, saves or sends its text has them.

    Args:
        text: YAML.
        name: of its file, for messages.
        folder: folder of the files; None if there is none.

    Raises:
        SceneError: the text is no YAML, or a picture can't be read.
    """
    if folder is None or "picture:" not in text:
        return text
    file, lines = YamlFile(text, name), text.split("\n")
    areas = file.data.get("areas")
    for index, area in enumerate(areas if isinstance(areas, list) else ()):
        wanted = area.get("picture") if isinstance(area, dict) else None
        if not isinstance(wanted, str) or not _PICTURE_FILE.fullmatch(wanted):
            continue
        line = file.line(("areas", index, "picture"))
        try:
            with (folder / wanted).open("rb") as opened:
                data = picture_data(opened.read(MAX_PICTURE_BYTES + 1))
        except OSError as error:
            raise SceneError(
                _(
                    "{name}, line {line}: the picture {picture!r} can't be read: {why}; put it "
                    "beside the file",
                    name=name,
                    line=line,
                    picture=wanted,
                    why=str(error.strerror),
                )
            ) from None
        except ValueError as error:
            raise SceneError(
                _(
                    "{name}, line {line}: {wanted}: {error}",
                    name=name,
                    line=line,
                    wanted=wanted,
                    error=text_of(error),
                )
            ) from None
        before, key, value = lines[line - 1].partition("picture:")
        if wanted not in value:
            raise SceneError(
                _(
                    "{name}, line {line}: expected the file's name on this line",
                    name=name,
                    line=line,
                )
            )
        lines[line - 1] = before + key + value.replace(wanted, data, 1)
    return "\n".join(lines)


def _place(name: str, problem: NotYamlError) -> str:
    """Return the file's name, with line and column where they are known."""
    if problem.line and problem.column:
        return _(
            "{name}, line {line}, column {column}",
            name=name,
            line=problem.line,
            column=problem.column,
        )
    return _("{name}, line {line}", name=name, line=problem.line) if problem.line else name


def _kind(data: Any, text: str) -> str:
    """Describe the content of a file that holds no mapping."""
    if data is None:
        return _("an empty file") if not text.strip() else _("a file without any")
    if isinstance(data, list):
        return _("a list (a line that begins with -)")
    if isinstance(data, str):
        beginning = data if len(data) <= 40 else data[:37] + "..."
        return _("the text {text!r}; a space has to follow each colon", text=beginning)
    return _("the value {value}", value=repr(data))


def write_yaml(data: dict[str, Any] | list[Any]) -> str:
    """Return plain data as YAML; short lists and mappings are on one line."""
    yaml = YAML(typ="rt", pure=True)
    yaml.default_flow_style = None
    # where it folds lines, ruamel loses some special characters
    yaml.width = MAX_LINE_CHARS if _has_special_text(data) else 100
    yaml.indent(mapping=2, sequence=4, offset=2)
    out = io.StringIO()
    pictures: dict[str, str] = {}
    quoted = _quoted(data, pictures)
    whole = CommentedMap(quoted) if isinstance(quoted, dict) else CommentedSeq(quoted)
    whole.fa.set_block_style()
    yaml.dump(whole, out)
    text = textwrap.dedent(out.getvalue())
    for token, picture in pictures.items():
        text = text.replace(token, picture, 1)
    return text


_PLAIN_TEXT = re.compile(r"[\w(+.,!?<-]?\w([\w(),.;!?+*/<>=%&-]| (?! ))*")


def _has_special_text(data: Any) -> bool:
    """Return True if some text in the data has special characters."""
    if isinstance(data, dict):
        return any(
            _has_special_text(key) or _has_special_text(value) for key, value in data.items()
        )
    if isinstance(data, list):
        return any(map(_has_special_text, data))
    return isinstance(data, str) and not _PLAIN_TEXT.fullmatch(data)


def _quoted(data: Any, pictures: dict[str, str]) -> Any:
    """Return data with special texts quoted, and tokens in place of pictures, which are returned.

    ruamel would take seconds for a picture.
    """
    if isinstance(data, dict):
        return {_quoted(key, pictures): _quoted(value, pictures) for key, value in data.items()}
    if isinstance(data, list):
        return [_quoted(value, pictures) for value in data]
    if isinstance(data, str) and _PICTURE_DATA.fullmatch(data):
        token = f"data:image/{len(pictures)}@{zlib.crc32(data.encode()):08x}"
        pictures[token] = data
        return DoubleQuotedScalarString(token)
    is_special = isinstance(data, str) and _has_special_text(data)
    return DoubleQuotedScalarString(data) if is_special else data
