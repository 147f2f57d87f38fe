"""YAML text to plain data with line numbers, and plain data to YAML text."""

import io
import re
import textwrap
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from ai4u_edu.base.errors import SceneError
from ai4u_edu.base.parameters import DataPath
from ai4u_edu.scenes.yaml.messages import shown
from ai4u_edu.scenes.yaml.tree import HAS_LIBYAML, NotYamlError, read_tree

MAX_SCENE_CHARS = 300_000 if HAS_LIBYAML else 50_000
"""Size of a scene file: any text of that size is read within a second. One with 500 bodies has
60,000."""
EXPECTED = "lines such as name: ..., bodies: ..., agents: ..."
"""The first keys of a scene file, for messages."""
MAX_LINE_CHARS = 1_000_000
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
        if len(text) > MAX_SCENE_CHARS:
            raise SceneError(
                f"{name}: expected at most {MAX_SCENE_CHARS} characters, got {len(text)}"
            )
        try:
            self._tree = read_tree(text)
        except NotYamlError as problem:
            line = f", line {problem.line}" if problem.line else ""
            column = f", column {problem.column}" if problem.column else ""
            there = shown(text, problem.line, problem.column)
            raise SceneError(f"{name}{line}{column}: {problem}{there}") from None
        if not isinstance(self._tree.data, dict):
            raise SceneError(f"{name}: expected {expected}, got {_kind(self._tree.data, text)}")
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


def _kind(data: Any, text: str) -> str:
    """Describe the content of a file that holds no mapping."""
    if data is None:
        return "an empty file" if not text.strip() else "a file without any"
    if isinstance(data, list):
        return "a list (a line that begins with -)"
    if isinstance(data, str):
        beginning = data if len(data) <= 40 else data[:37] + "..."
        return f"the text {beginning!r}; a space has to follow each colon"
    return f"the value {data!r}"


def write_yaml(data: dict[str, Any] | list[Any]) -> str:
    """Return plain data as YAML; short lists and mappings are on one line."""
    yaml = YAML(typ="rt", pure=True)
    yaml.default_flow_style = None
    # where it folds lines, ruamel loses some special characters
    yaml.width = MAX_LINE_CHARS if _has_special_text(data) else 100
    yaml.indent(mapping=2, sequence=4, offset=2)
    out = io.StringIO()
    quoted = _quoted(data)
    whole = CommentedMap(quoted) if isinstance(quoted, dict) else CommentedSeq(quoted)
    whole.fa.set_block_style()
    yaml.dump(whole, out)
    return textwrap.dedent(out.getvalue())


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


def _quoted(data: Any) -> Any:
    if isinstance(data, dict):
        return {_quoted(key): _quoted(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_quoted(value) for value in data]
    is_special = isinstance(data, str) and _has_special_text(data)
    return DoubleQuotedScalarString(data) if is_special else data
