"""The pages as Sphinx reads them: copies of the repository's, with links that fit the site."""

import os
import re
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from babel.numbers import format_decimal

from ai4u_edu.lessons.translation import translated_page
from ai4u_edu.locale import LESSONS, SOURCE, Catalogue, Text
from tests.translations import PAGES, SITE, page_translation, translation

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
OTHER_PAGES = {
    "CHANGELOG.md": "changelog.md",
    "lessons/GLOSSARY.md": "lessons/glossary.md",
    "lessons/README.md": "lessons/index.md",
}
"""Pages of the site that are elsewhere in the repository, and their names in the site."""
NO_PAGES = {"__pycache__", "locale"}
"""Folders of ``docs/`` that the site doesn't need."""
FILES = "files"
"""Folder for what pages link to and is no page, such as sources."""

LINK = re.compile(r"((?:^|!?\[)(?:[^\[\]]|!\[[^\]]*\]\([^)]*\))*\]\()([^)\s]+)(\))")
"""A link with its target; of one whose text goes over two lines, the rest in the second."""
FENCE = re.compile(r"^ *(```|~~~)")
HEADING = re.compile(r"## (.+)")
ANY_HEADING = re.compile(r"#{1,6} (.+)")
ENTRY = re.compile(r"- \[[^\]]*\]\(([^)#]+)\)")


def name_in_site(path: Path) -> str:
    """Return the place of a file of the repository in the site.

    Args:
        path: relative to the repository.

    >>> name_in_site(Path("docs/how-to/README.md"))
    'how-to/index.md'
    >>> name_in_site(Path("ai4u_edu/wire/native.py"))
    'files/ai4u_edu/wire/native.py'
    """
    known = OTHER_PAGES.get(path.as_posix())
    if known is not None:
        return known
    if path.parts[0] != "docs":
        return f"{FILES}/{path.as_posix()}"
    name = path.relative_to("docs")
    return (name.with_name("index.md") if name.name == "README.md" else name).as_posix()


class Staging:
    """A folder of sources for Sphinx.

    Args:
        folder: it is made; what is in it and not written again is removed by :meth:`close`.
        language: code of the pages' language; what has no translation is English.
    """

    def __init__(self, folder: Path, language: str = SOURCE) -> None:
        self.folder, self.language = folder, language
        self._catalogue, self._words = Catalogue(language), translation(language, SITE)
        self._written: set[Path] = set()

    def words(self, text: str) -> str:
        """Return a text of the site itself in the pages' language; ``text`` is a literal."""
        return self._words(text)

    def number(self, value: float) -> str:
        """Return a number with one place after the point, as the pages' language writes it."""
        return format_decimal(value, "0.0", locale=self.language)

    def translated(self, text: str) -> str:
        """Return a text of the package in the pages' language.

        Args:
            text: a text that knows its catalogue, or the key of one that Python code says.
        """
        if isinstance(text, Text):
            return self._catalogue.translate(text)
        return self._catalogue.message(text)

    def write(self, name: str, content: str | bytes) -> Path:
        """Write a file, unless it has this content already: Sphinx reads again what is newer."""
        path = self.folder / name
        self._written.add(path)
        data = content.encode() if isinstance(content, str) else content
        if not path.exists() or path.read_bytes() != data:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        return path

    def keep(self, name: str) -> Path | None:
        """Keep a file of an earlier build; return None if there is none."""
        path = self.folder / name
        if not path.exists():
            return None
        self._written.add(path)
        return path

    def append(self, name: str, text: str) -> None:
        """Add text at the end of a page that was written."""
        self.write(name, (self.folder / name).read_text(encoding="utf-8") + "\n" + text)

    def add_repository(self) -> None:
        """Add all files of ``docs/``, the other pages, and what these link to."""
        files = [path for path in sorted(DOCS.rglob("*")) if path.is_file()]
        for path in [*files, *(ROOT / name for name in OTHER_PAGES)]:
            if NO_PAGES & {*path.parts}:
                continue
            name = name_in_site(path.relative_to(ROOT))
            if path.suffix == ".md":
                self.write(name, self._page(path, name))
            else:
                self.write(name, path.read_bytes())

    def close(self) -> None:
        """Remove files of an earlier build that this one has not written."""
        for path in self.folder.rglob("*"):
            if path.is_file() and path not in self._written:
                path.unlink()
        for path in sorted(self.folder.rglob("*"), reverse=True):
            if path.is_dir() and not any(path.iterdir()):
                shutil.rmtree(path)

    def _page(self, path: Path, name: str) -> str:
        text = self._text(path)
        page = "".join(self._line(line, path, name, code) for line, code in _lines(text))
        return page + (_toctrees(page, name == "index.md") if name.endswith("index.md") else "")

    def _text(self, path: Path) -> str:
        text = path.read_text(encoding="utf-8")
        domain = next((name for name, page in PAGES.items() if page == path), "")
        if self.language == SOURCE or not domain:
            return text
        if domain.startswith(f"{LESSONS}/"):
            return translated_page(path.stem, self.language)
        return page_translation(self.language, domain, text)

    def _line(self, line: str, path: Path, name: str, is_code: bool) -> str:
        if is_code:
            return line
        return LINK.sub(lambda link: link[1] + self._target(link[2], path, name) + link[3], line)

    def _target(self, target: str, path: Path, name: str) -> str:
        """Return a link's target as it is from the page's place in the site."""
        there, hash_, anchor = target.partition("#")
        if "://" in there or there.startswith("mailto:"):
            return target
        file = (path.parent / there).resolve() if there else path
        if file.is_dir():
            file /= "README.md"
        if not file.is_file():
            return target  # Sphinx warns of it
        if self.language != SOURCE and file.suffix == ".md":
            english = anchors(file.read_text(encoding="utf-8"))
            anchor = dict(zip(english, anchors(self._text(file)), strict=True)).get(anchor, anchor)
        if not there:
            return hash_ + anchor
        place = name_in_site(file.relative_to(ROOT))
        if place.startswith(f"{FILES}/"):
            self.write(place, file.read_bytes())
        return os.path.relpath(place, Path(name).parent).replace(os.sep, "/") + hash_ + anchor


def anchors(page: str) -> list[str]:
    """Return the anchors of a page's headings, as MyST and GitHub make them.

    >>> anchors("# The page\\n\\n## `R`, and N\\n\\n## The page\\n")
    ['the-page', 'r-and-n', 'the-page-1']
    """
    found = list[str]()
    times = Counter[str]()
    for line, is_code in _lines(page):
        if not is_code and (heading := ANY_HEADING.match(line)):
            words = re.sub(r"[^\w\- ]", "", heading[1].strip().lower()).replace(" ", "-")
            found.append(f"{words}-{times[words]}" if times[words] else words)
            times[words] += 1
    return found


def _lines(text: str) -> Iterator[tuple[str, bool]]:
    """Yield the lines of a page, and True for those of a block of code."""
    is_code = False
    for line in text.splitlines(keepends=True):
        is_fence = FENCE.match(line) is not None
        yield line, is_code or is_fence
        is_code ^= is_fence


def _toctrees(page: str, has_captions: bool) -> str:
    """Return hidden tables of contents of the pages that a page lists.

    Args:
        page: its lists are read.
        has_captions: True makes a table of each section, under the section's heading.
    """
    tables: dict[str, list[str]] = {}
    heading = ""
    for line in page.splitlines():
        if found := HEADING.fullmatch(line):
            heading = found[1]
        elif found := ENTRY.match(line):
            entry = found[1].removesuffix(".md")
            if has_captions or not entry.startswith(".."):
                tables.setdefault(heading if has_captions else "", []).append(entry)
    return "".join(toctree(entries, caption) for caption, entries in tables.items())


def toctree(entries: list[str], caption: str = "") -> str:
    """Return a hidden table of contents, as MyST reads it."""
    options = [":hidden:"] + ([f":caption: {caption}"] if caption else [])
    return "\n" + "\n".join(["```{toctree}", *options, "", *entries, "```"]) + "\n"
