"""YAML text to plain data, with the line of everything."""

import io
import re
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.scalarstring import DoubleQuotedScalarString
from ruamel.yaml.tokens import (
    AliasToken,
    AnchorToken,
    BlockEndToken,
    BlockMappingStartToken,
    BlockSequenceStartToken,
    FlowMappingEndToken,
    FlowMappingStartToken,
    FlowSequenceEndToken,
    FlowSequenceStartToken,
    TagToken,
)

from ai4u_edu.errors import SceneError

MAX_SIZE = 1_000_000
"""Characters that a scene file may have."""
MAX_DEPTH = 24
UNFOLDED = 1_000_000
"""Characters of a line that never ends."""

OPENING = (
    BlockMappingStartToken,
    BlockSequenceStartToken,
    FlowMappingStartToken,
    FlowSequenceStartToken,
)
CLOSING = (BlockEndToken, FlowMappingEndToken, FlowSequenceEndToken)

Path = tuple[str | int, ...]


class YamlFile:
    r"""A parsed file.

    Args:
        text: YAML.
        name: of the file, for messages.

    Raises:
        SceneError: it can't be read; the message names the line.

    >>> file = YamlFile("name: x\nbodies:\n  - name: box", "a.yaml")
    >>> file.data
    {'name': 'x', 'bodies': [{'name': 'box'}]}
    >>> file.line(("bodies", 0, "name"))
    3
    """

    def __init__(self, text: str, name: str) -> None:
        self.name = name
        if len(text) > MAX_SIZE:
            raise SceneError(f"{name}: expected at most {MAX_SIZE} characters, got {len(text)}")
        try:
            self._refuse_tricks(text)
            self._document: Any = YAML(typ="rt", pure=True).load(text)
        except MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            line = f", line {mark.line + 1}" if mark else ""
            raise SceneError(f"{name}{line}: not YAML: {error.problem or error.context}") from None
        except (YAMLError, RecursionError, ValueError) as error:
            raise SceneError(f"{name}: not YAML: {error}") from None
        except TypeError:  # as of a mapping that is to be a key
            raise SceneError(f"{name}: expected words as keys, got lists or mappings") from None
        if not isinstance(self._document, CommentedMap):
            raise SceneError(
                f"{name}: expected a mapping (name: ..., bodies: ..., agents: ...), "
                f"got {type(self._document).__name__}"
            )
        self.data: dict[str, Any] = self._plain(self._document, 0)

    def line(self, path: Path) -> int:
        """The line (from 1 on) of what stands at a path, or of the nearest thing above it."""
        node, line = self._document, 0
        for part in path:
            if isinstance(node, CommentedMap) and part in node:
                line = node.lc.key(part)[0]
            elif isinstance(node, CommentedSeq) and isinstance(part, int) and part < len(node):
                line = node.lc.item(part)[0]
            else:
                break
            node = node[part]
        return int(line) + 1

    def _refuse_tricks(self, text: str) -> None:
        # aliases blow a small file up to a huge one, tags ask for objects; a scene needs neither
        depth = 0
        for token in YAML(typ="rt", pure=True).scan(io.StringIO(text)):
            depth += isinstance(token, OPENING) - isinstance(token, CLOSING)
            if depth > MAX_DEPTH + 1:  # told before the parser gets lost in it
                raise SceneError(self._too_deep())
            if isinstance(token, AliasToken | AnchorToken | TagToken):
                raise SceneError(
                    f"{self.name}, line {token.start_mark.line + 1}: expected plain values; "
                    "anchors (&), aliases (*) and tags (!) are not used in scene files"
                )

    def _too_deep(self) -> str:
        return f"{self.name}: nested more than {MAX_DEPTH} deep"

    def _plain(self, node: Any, depth: int) -> Any:
        if depth > MAX_DEPTH:
            raise SceneError(self._too_deep())
        if isinstance(node, CommentedMap):
            return {str(key): self._plain(value, depth + 1) for key, value in node.items()}
        if isinstance(node, CommentedSeq):
            return [self._plain(value, depth + 1) for value in node]
        for kind in (bool, int, float, str):
            if isinstance(node, kind):
                return kind(node)
        return node


def write_yaml(data: dict[str, Any]) -> str:
    """Plain data as YAML: short lists and mappings on one line."""
    yaml = YAML(typ="rt", pure=True)
    yaml.default_flow_style = None
    # where a line ends, ruamel loses some of what is odd in a text
    yaml.width = UNFOLDED if _is_odd(data) else 100
    yaml.indent(mapping=2, sequence=4, offset=2)
    out = io.StringIO()
    yaml.dump(_quoted(data), out)
    return out.getvalue()


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
