"""Edits of a YAML text that keep its layout and comments.

The text is edited line by line. Unchanged entries of block mappings and block lists keep their
lines and the comments above them. A changed entry is written again, and keeps the comments above
and behind it. A removed entry's comments are removed with it. Entries of lists are matched by their
name or id.

ruamel.yaml's round trip can't do this: it attaches a comment to the entry before it, so removing an
entry removes the next one's comment, and it changes the layout of half of the library's files.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import yaml

from ai4u_edu.scenes.yaml.file import write_yaml

_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_Node = Any  # PyYAML's types say little of what a node has

NAMES = ("name", "id", "perception_key", "action_name", "type")
"""Keys that identify an entry of a list; the first one that it has counts."""


@dataclass
class _Entry:
    """One entry of a block mapping or a block list; lines count from 0."""

    key: str
    """Key; empty in a list."""
    value: _Node
    column: int
    """Column of its key, or of its dash."""
    first: int
    last: int
    """Its last line."""
    comments: int
    """First line of the comments directly above it."""


def edited(text: str, before: Mapping[str, Any], after: Mapping[str, Any]) -> str:
    r"""Return a text with other data in it.

    Args:
        text: YAML: a block mapping.
        before: its data; default values may be left out.
        after: the new data, in the same form.

    Raises:
        ValueError: the text is no block mapping, or does not have the data.

    >>> edited("# my world\nname: a  # short\nx: 1\n", {"name": "a", "x": 1}, {"name": "b"})
    '# my world\nname: b  # short\n'
    """
    root = yaml.compose(text, Loader=_Loader)
    lines = text.split("\n")
    if not _is_block(root, yaml.MappingNode):
        raise ValueError("expected a block mapping")
    edit = _Edit(lines)
    changed = edit.mapping(root, before, after, 0)
    entries = edit.entries(root, 0)
    found = "\n".join([*lines[: entries[0].comments], *changed, *lines[entries[-1].last + 1 :]])
    return found if found.endswith("\n") else f"{found}\n"


class _Edit:
    def __init__(self, lines: list[str]) -> None:
        self.lines = lines

    def mapping(
        self, node: _Node, before: Mapping[str, Any], after: Mapping[str, Any], start: int
    ) -> list[str]:
        """Return the lines of a block mapping, which begins at line ``start``, with other data."""
        entries = self.entries(node, start)
        column = entries[0].column
        found: list[list[str]] = []
        for entry in entries:
            name = entry.key
            if name not in after:
                if name not in before:  # a default value that is written out
                    found.append(self._unchanged(entry))
            elif name in before and before[name] == after[name]:
                found.append(self._unchanged(entry))
            else:
                found.append(self._changed(entry, before.get(name), after[name]))
            if found and entry is not entries[-1]:
                found[-1] += self._after(entry)
        known = {entry.key for entry in entries}
        new = {k: v for k, v in after.items() if k not in known and before.get(k, ...) != v}
        if new:
            found.append(_dumped(new, column))
        return [line for part in found for line in part]

    def sequence(
        self, node: _Node, before: Sequence[Any], after: Sequence[Any], start: int
    ) -> list[str]:
        """Return the lines of a block list, which begins at line ``start``, with other data."""
        entries = self.entries(node, start)
        if len(entries) != len(before):
            raise ValueError("expected the data that stand in the text")
        left = list(range(len(entries)))
        found: list[str] = []
        for value in after:
            index = _matching(value, before, left)
            if index is None:
                found += _dumped([value], entries[0].column)
                continue
            left.remove(index)
            entry = entries[index]
            if before[index] == value:
                found += self._unchanged(entry)
            else:
                found += self._changed_item(entry, before[index], value)
            if entry is not entries[-1]:
                found += self._after(entry)
        return found

    def entries(self, node: _Node, start: int) -> list[_Entry]:
        """Return the entries of a block mapping or list."""
        found: list[_Entry] = []
        is_mapping = isinstance(node, yaml.MappingNode)
        end = start - 1
        for each in node.value:
            key, value = each if is_mapping else (each, each)
            mark = key.start_mark
            first, column = mark.line, mark.column
            if not is_mapping:
                column = node.start_mark.column
                # the dash may be alone on its line
                while not self.lines[first][column:].startswith("-"):
                    first -= 1
            last = max(_last_line(value), key.end_mark.line if is_mapping else first)
            found.append(
                _Entry(
                    str(key.value) if is_mapping else "",
                    value,
                    column,
                    first,
                    last,
                    self._comments(first, end, column),
                )
            )
            end = last
        return found

    def _comments(self, first: int, end: int, column: int) -> int:
        """Return the first line of the comments and empty lines that belong to an entry."""
        line = first
        while line - 1 > end:
            text = self.lines[line - 1]
            if not _is_comment(text):
                break  # such as the `---` before a document
            if text.strip() and len(text) - len(text.lstrip()) > column:
                break  # indented further: it belongs to the entry above
            line -= 1
        return line

    def _unchanged(self, entry: _Entry) -> list[str]:
        return self.lines[entry.comments : entry.last + 1]

    def _after(self, entry: _Entry) -> list[str]:
        """Return the comments below an entry that are indented further, and so belong to it.

        Such comments below the last entry belong to the parent.
        """
        found = []
        for text in self.lines[entry.last + 1 :]:
            indent = len(text) - len(text.lstrip())
            if not text.strip().startswith("#") or indent <= entry.column:
                break
            found.append(text)
        return found

    def _changed(self, entry: _Entry, before: Any, after: Any) -> list[str]:
        """Return the lines of a mapping's entry with another value."""
        above = self.lines[entry.comments : entry.first]
        inner = self._inside(entry.value, before, after, entry.first + 1)
        if inner:
            begins = self.entries(entry.value, entry.first + 1)[0].comments
            return [*above, *self.lines[entry.first : begins], *inner]
        new = _dumped({entry.key: after}, entry.column)
        prefix = self.lines[entry.first][: entry.column]
        new[0] = prefix + new[0][entry.column :]
        if len(new) == 1 or entry.first == entry.last:
            new[0] += self._behind(entry)
        return [*above, *new]

    def _changed_item(self, entry: _Entry, before: Any, after: Any) -> list[str]:
        """Return the lines of a list's entry with another value."""
        above = self.lines[entry.comments : entry.first]
        is_mapping = _is_block(entry.value, yaml.MappingNode)
        if is_mapping and isinstance(before, Mapping) and isinstance(after, Mapping) and after:
            is_below = entry.value.start_mark.line != entry.first  # the dash is alone on its line
            start = entry.first + is_below
            inner = self.mapping(entry.value, before, after, start)
            prefix = self.lines[entry.first][: entry.column] + "-"
            at = next(i for i, line in enumerate(inner) if not _is_comment(line))
            width = entry.value.start_mark.column
            comments, rest = inner[:at], inner[at:]
            if is_below:
                begins = self.entries(entry.value, start)[0].comments
                return [*above, *self.lines[entry.first : begins], *inner]
            rest[0] = prefix + " " * (width - len(prefix)) + rest[0][width:]
            return [*above, *comments, *rest]
        new = _dumped([after], entry.column)
        new[0] += self._behind(entry) if entry.first == entry.last else ""
        return [*above, *new]

    def _inside(self, node: _Node, before: Any, after: Any, start: int) -> list[str] | None:
        """Return the edited lines of a nested block; None if it has to be written again."""
        both = (before, after)
        if _is_block(node, yaml.MappingNode) and all(isinstance(each, Mapping) for each in both):
            return self.mapping(node, before, after, start) if after else None
        lists = all(isinstance(each, list | tuple) for each in both)
        if _is_block(node, yaml.SequenceNode) and lists:
            return self.sequence(node, before, after, start) if after else None
        return None

    def _behind(self, entry: _Entry) -> str:
        """Return the comment behind an entry, on its last line."""
        line, mark = self.lines[entry.last], entry.value.end_mark
        rest = line[mark.column :] if mark.line == entry.last else ""
        return rest if rest.strip().startswith("#") else ""


def _last_line(node: _Node) -> int:
    """Return the last line of a value."""
    if node.value and _is_block(node, yaml.MappingNode):
        return max(_last_line(value) for _, value in node.value)
    if node.value and _is_block(node, yaml.SequenceNode):
        return max(_last_line(value) for value in node.value)
    mark = node.end_mark
    # a block scalar (| or >) ends at the begin of the next line
    return int(mark.line if mark.column or mark.line == node.start_mark.line else mark.line - 1)


def _is_block(node: Any, kind: type) -> bool:
    found: _Node = node
    return isinstance(node, kind) and not found.flow_style and bool(found.value)


def _is_comment(line: str) -> bool:
    return not line.strip() or line.lstrip().startswith("#")


def _matching(value: Any, before: Sequence[Any], left: Sequence[int]) -> int | None:
    """Return the index of the remaining entry that matches a value; None if none does."""
    for index in left:
        if before[index] == value:
            return index
    if not isinstance(value, Mapping):
        return None
    for index in left:
        other = before[index]
        if not isinstance(other, Mapping):
            continue
        names = [name for name in NAMES if name in value or name in other]
        # entries without any of the keys are matched in order
        if not names or value.get(names[0]) == other.get(names[0]):
            return index
    return None


def _dumped(data: Any, column: int) -> list[str]:
    indent = " " * column
    return [f"{indent}{line}" if line else line for line in write_yaml(data).splitlines()]
