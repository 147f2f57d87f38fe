"""The course in other languages: what of a notebook or page is translated, and how it is put back.

A text is translated by paragraph, item of a list, or row of a table; code by comment, and by those
strings that are meant to be read: they hold a space, are printed, or name a plot or its axes.
"""

import ast
import io
import re
import tokenize
import unicodedata
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import groupby

from ai4u_edu.lessons.course import Lesson, course_folder, lesson
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.locale import LESSONS, SOURCE, Catalogue, catalogue

Translate = Callable[[str], str]
GLOSSARY = "GLOSSARY"
"""The page with the words of the course."""
SETUP = "setup"
"""Tag of the cell with a notebook's imports."""
LANGUAGE_CELL = "from ai4u_edu.locale import set_language\n\nset_language({code!r})"
_PREFIX = re.compile(r"(?P<prefix>\s*(?:[-*] |\d+\. |#+ |\| |> )?)(?P<words>.*)", re.DOTALL)
_BEGINS = re.compile(r"\s*(?:[-*] |\d+\. |#+ |\||> |<(?:!--|/?(?:div|p|img)\b))")
_RULE = re.compile(r"\s*\|[-|: ]+\|\s*")
_LABELS = ("title", "xlabel", "ylabel")
"""Names of arguments whose strings are read, also if they are one word."""
_FENCE = "```"
_INDENT = "    "
"""Beginning of the lines of a block of code without a fence."""
_HTML = re.compile(r"\s*<")
_ALT = re.compile(r'(?<= alt=")[^"]+')
_QUOTES = re.compile(r"""[a-zA-Z]*(?P<quote>\"{3}|'{3}|"|')""")


def texts_of(cell: Cell) -> Iterator[str]:
    """Yield what can be translated in a cell, in its order."""
    texts: list[str] = []

    def note(text: str) -> str:
        texts.append(text)
        return text

    translated_cell(cell, note)
    yield from texts


def translated_cell(cell: Cell, translate: Translate) -> Cell:
    """Return a cell with its texts translated.

    Args:
        cell: the cell.
        translate: returns the translation of a text, or the text.
    """
    change = _text_in if cell.is_text else _code_in
    return replace(cell, source=change(cell.source, translate))


def translated_lesson(name: str, cells: list[Cell], language: str) -> list[Cell]:
    """Return the cells of a lesson in a language, with a line that sets it for the checks.

    Args:
        name: the lesson's name, such as ``02_drive``.
        cells: its cells in English.
        language: the language's code.
    """
    if language == SOURCE:
        return cells
    translate = Catalogue(language, f"{LESSONS}/{name}").message
    translated = [translated_cell(cell, translate) for cell in cells]
    setup = next(number for number, cell in enumerate(cells) if SETUP in cell.tags)
    source = f"{translated[setup].source}\n\n{LANGUAGE_CELL.format(code=language)}"
    translated[setup] = replace(translated[setup], source=source)
    return translated


def translated_page(name: str, language: str) -> str:
    """Return a page of the course, such as its glossary, in a language.

    The words of the glossary stand in the order of that language.

    Args:
        name: the page's name, such as ``GLOSSARY``.
        language: the language's code.
    """
    page = (course_folder() / f"{name}.md").read_text(encoding="utf-8")
    if language == SOURCE:
        return page
    translate = Catalogue(language, f"{LESSONS}/{name}").message
    text = translated_cell(Cell(page, is_text=True), translate).source
    if name != GLOSSARY:
        return f"{text}\n"
    introduction, _, words = text.partition("\n- ")
    return "\n- ".join([introduction, *sorted(words.split("\n- "), key=_without_accents)]) + "\n"


def _without_accents(text: str) -> str:
    return unicodedata.normalize("NFD", text).encode("ascii", "ignore").decode().lower()


def translated_title(lesson: Lesson) -> str:
    """Return a lesson's title in the reader's language."""
    return Catalogue(catalogue().language, f"{LESSONS}/{lesson.name}").message(lesson.title)


def translated_code(exercise: str, code: str) -> str:
    """Return code that belongs to an exercise in the language of this notebook.

    Args:
        exercise: the exercise's id, such as ``02.3``.
        code: the code in English.
    """
    name = lesson(exercise.partition(".")[0]).name
    return _code_in(code, Catalogue(catalogue().language, f"{LESSONS}/{name}").message)


# -- text ----------------------------------------------------------------------------------------


def _text_in(source: str, translate: Translate) -> str:
    lines: list[str] = []
    is_code = False
    for is_blank, group in groupby(source.splitlines(), lambda line: not line.strip()):
        block = list(group)
        if is_blank or all(line.startswith(_INDENT) and _FENCE not in line for line in block):
            lines += block
            continue
        for item in _items(block):
            was_code = is_code
            is_code ^= item[0].lstrip().startswith(_FENCE)
            if was_code or is_code or _RULE.fullmatch(item[0]):
                lines += item
            elif _HTML.match(item[0]):
                lines += [_ALT.sub(lambda words: translate(words[0]), line) for line in item]
            else:
                lines.append(_translated_item(item, translate))
    return "\n".join(lines)


def _items(block: list[str]) -> Iterator[list[str]]:
    """Yield the lines of each item of a list, row of a table, fenced line, or paragraph."""
    item: list[str] = []
    for line in block:
        if item and (_BEGINS.match(line) or _FENCE in line or _ends_in_its_line(item[0])):
            yield item
            item = []
        item.append(line)
    if item:
        yield item


def _ends_in_its_line(line: str) -> bool:
    return _FENCE in line or _HTML.match(line) is not None


def _translated_item(item: list[str], translate: Translate) -> str:
    # lines are joined, so that another wrap of the English text is the same text
    head, *more = item
    parts = _PREFIX.fullmatch(head)
    prefix, words = (parts["prefix"], parts["words"]) if parts else ("", head)
    text = " ".join([words.strip(), *(line.strip() for line in more)])
    return prefix + translate(text) if re.search(r"[A-Za-z]{2}", text) else "\n".join(item)


# -- code ----------------------------------------------------------------------------------------


def _code_in(source: str, translate: Translate) -> str:
    changes = sorted([*_comments(source), *_strings(source)])
    lines = source.splitlines()
    for (row, begin), end, text in reversed(changes):
        line = lines[row]
        lines[row] = line[:begin] + translate(text) + line[end:]
    return "\n".join(lines)


def _comments(source: str) -> Iterator[tuple[tuple[int, int], int, str]]:
    """Yield place, end and words of each comment."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        words = token.string.lstrip("# ")
        if token.type == tokenize.COMMENT and re.search(r"[A-Za-z]{2}", words):
            row, column = token.start
            yield (row - 1, column + len(token.string) - len(words)), token.end[1], words


def _strings(source: str) -> Iterator[tuple[tuple[int, int], int, str]]:
    """Yield place, end and content of each string on one line that is meant to be read."""
    tree = ast.parse(source)
    labels, keys = set[int](), set[int]()
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            printed = node.args if node.func.id == "print" else []
            named = [each.value for each in node.keywords if each.arg in _LABELS]
            labels |= {id(value) for value in (*printed, *named)}
        elif isinstance(node, ast.Subscript):
            keys.add(id(node.slice))
    inside = {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.JoinedStr)
        for part in node.values
    }
    lines = source.splitlines()
    for node in ast.walk(tree):
        if id(node) in inside | keys or not isinstance(node, ast.JoinedStr | ast.Constant):
            continue
        if node.end_lineno != node.lineno or node.end_col_offset is None:
            continue
        line = lines[node.lineno - 1].encode()  # its offsets count bytes
        code = line[node.col_offset : node.end_col_offset].decode()
        words, quotes = _words(node), _QUOTES.match(code)
        if quotes is None or not re.search(r"[A-Za-z]{2}", words):
            continue
        if " " in words.strip() or id(node) in labels:
            begin = len(line[: node.col_offset].decode())
            first, last = begin + quotes.end(), begin + len(code) - len(quotes["quote"])
            yield (node.lineno - 1, first), last, code[quotes.end() : -len(quotes["quote"])]


def _words(node: ast.JoinedStr | ast.Constant) -> str:
    parts = node.values if isinstance(node, ast.JoinedStr) else [node]
    words = [part.value for part in parts if isinstance(part, ast.Constant)]
    return "".join(word for word in words if isinstance(word, str))
