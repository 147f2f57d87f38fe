"""YAML text to plain data, with the line of everything, and plain data to YAML text."""

import io
import re
import textwrap
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from ai4u_edu.base.errors import SceneError
from ai4u_edu.scenes.yaml.messages import shown
from ai4u_edu.scenes.yaml.tree import IS_QUICK, NotYamlError, read_tree

MAX_SCENE_CHARS = 300_000 if IS_QUICK else 50_000
"""Characters that a scene file may have: what is read in a second, whatever it is. With 500 bodies
it has 60,000."""
EXPECTED = "lines such as name: ..., bodies: ..., agents: ..."
"""The first keys of a scene file, for messages."""
UNFOLDED = 1_000_000
"""Characters of a line that never ends."""

Path = tuple[str | int, ...]


class YamlFile:
    r"""A parsed file.

    Args:
        text: YAML.
        name: of the file, for messages.
        expected: what stands in such a file, for messages.

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

    def line(self, path: Path) -> int:
        """The line (from 1 on) of what stands at a path, or of the nearest thing above it."""
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
    """Plain data as YAML: short lists and mappings on one line, but for the whole."""
    yaml = YAML(typ="rt", pure=True)
    yaml.default_flow_style = None
    # where a line ends, ruamel loses some of what is odd in a text
    yaml.width = UNFOLDED if _is_odd(data) else 100
    yaml.indent(mapping=2, sequence=4, offset=2)
    out = io.StringIO()
    quoted = _quoted(data)
    whole = CommentedMap(quoted) if isinstance(quoted, dict) else CommentedSeq(quoted)
    whole.fa.set_block_style()
    yaml.dump(whole, out)
    return textwrap.dedent(out.getvalue())


_USUAL = re.compile(r"[\w(+.,!?<-]?\w([\w(),.;!?+*/<>=%&-]| (?! ))*")


def _is_odd(data: Any) -> bool:
    """Whether a text in it is more than words."""
    if isinstance(data, dict):
        return any(_is_odd(key) or _is_odd(value) for key, value in data.items())
    if isinstance(data, list):
        return any(map(_is_odd, data))
    return isinstance(data, str) and not _USUAL.fullmatch(data)


def _quoted(data: Any) -> Any:
    if isinstance(data, dict):
        return {_quoted(key): _quoted(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_quoted(value) for value in data]
    odd = isinstance(data, str) and _is_odd(data)
    return DoubleQuotedScalarString(data) if odd else data
