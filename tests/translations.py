"""Catalogues of the translations: ``python -m tests.translations COMMAND``.

``update`` collects all English texts, and merges them into each language's catalogues (``.po``);
``compile`` writes what the program reads (``.mo``, ``.json``); ``report`` counts what is missing.
docs/translating.md tells a translator how to use them.
"""

import argparse
import io
import json
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from gettext import c2py
from pathlib import Path

import typer
from babel import Locale
from babel.messages import Catalog, Message
from babel.messages.extract import extract_from_dir
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from ai4u_edu.cli.main import help_texts
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.lessons.course import is_ticket, lessons
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.translation import texts_of, translated_cell
from ai4u_edu.locale import LANGUAGES, LESSONS, LIBRARY, PAGE, PYTHON, SOURCE
from ai4u_edu.locale.catalogues import catalogue_file
from ai4u_edu.missions.mission import library_missions
from ai4u_edu.page.editing.scene_pictures import load_by_name, template_names
from ai4u_edu.scenes import Scene
from tests.form_texts import form_texts

ROOT = Path(__file__).parents[1]
DOCS = "docs"
"""The folder of the domains of the docs, whose catalogues are in ``docs/locale``."""
SITE = f"{DOCS}/site"
"""The domain of what the docs site says by itself, around scenes and blocks."""
README = ROOT / "README.md"
PAGES = {
    f"{LESSONS}/GLOSSARY": ROOT / "lessons/GLOSSARY.md",
    f"{LESSONS}/README": ROOT / "lessons/README.md",
    f"{DOCS}/repository": README,
    **{
        f"{DOCS}/{name}": ROOT / f"docs/{name}.md"
        for name in (
            "README",
            "first-drive",
            "install",
            "page",
            "class",
            "teach",
            "glossary",
            "scenes",
            "build-a-scene",
            "build-an-agent",
            "blocks",
            "code-in-the-page",
            "traces",
            "python",
            "explain",
            "training",
            "remote",
            "sweeps-and-tournaments",
            "jupyterhub",
            "security",
            "from-ai4u",
            "cli",
            "lesson-checks",
            "api",
        )
    },
}
"""Pages that are translated, by their domains. Those for anyone who works on the code are not."""
TRANSLATED = tuple(code for code in LANGUAGES if code != SOURCE)
PLURAL_FORMS = {"pt_BR": "nplurals=2; plural=(n > 1);"}
"""Rules for the plurals of a new catalogue, by language; else Babel's."""
NO_DATE = datetime(2026, 1, 1, tzinfo=UTC)
MAX_COUNT_TRIED = 1000
"""Numbers from 0 to this one are tried to learn which plural form belongs to which category."""
English = str | tuple[str, str]
"""A text, or the two of a text that counts something."""
Keywords = Mapping[str, tuple[int, ...] | None]
PYTHON_KEYWORDS: Keywords = {"_": None, "deferred": None, "gettext": None, "ngettext": (1, 2)}
PAGE_KEYWORDS: Keywords = {"t": None, "tn": (1, 2)}
SITE_KEYWORDS: Keywords = {"words": None}
_PACKAGES = Path(typer.__file__).parents[1]
_VALUES = re.compile(r"\{[^{}]*\}|%\d")  # the second are Blockly's
_MARKUP = re.compile(r"<code>.*?</code>|`[^`]*`|\]\([^()]*\)|<[^<>]+>|\*\*|&\w+;")


@dataclass
class Domain:
    """The English texts of a catalogue, in their order.

    Args:
        name: its file's name without suffix, from the language's folder.
        texts: a text, or a text and its plural, with the file that has it.
    """

    name: str
    texts: list[tuple[English, str]] = field(default_factory=list)

    def template(self) -> Catalog:
        """Return a catalogue without translations."""
        catalog = Catalog(project="AI4U Edu", charset="utf-8", fuzzy=False)
        for text, file in self.texts:
            catalog.add(text, locations=[(file, 0)])
        return catalog


def domains() -> list[Domain]:
    """Return all domains, with all English texts."""
    python = Domain(PYTHON, list(_in_code("ai4u_edu", "**.py", "python", PYTHON_KEYWORDS)))
    python.texts += _in_code("ai4u_edu", "**.html", "jinja2", PYTHON_KEYWORDS)
    python.texts += _in_code("web", "pages/**.html", "jinja2", PYTHON_KEYWORDS)
    python.texts += [(text, "ai4u_edu/cli") for text in help_texts()]
    # words of Typer around the help, which it looks up in the same domain
    python.texts += _in_code("typer", "**.py", "python", PYTHON_KEYWORDS, _PACKAGES)
    python.texts += [(text, "ai4u_edu/page/panel") for text in form_texts()]
    page = Domain(PAGE, list(_in_code("web", "**.js", "javascript", PAGE_KEYWORDS)))
    # a program runs in the page, too
    page.texts += _in_code("ai4u_edu/program", "**.py", "python", PYTHON_KEYWORDS)
    library = Domain(LIBRARY, [*_scene_texts(), *_mission_texts()])
    site = Domain(SITE, list(_in_code("tests/docs_site", "*_pages.py", "python", SITE_KEYWORDS)))
    return [python, page, library, *_lesson_domains(), *_page_domains(), site]


def _in_code(
    folder: str, pattern: str, method: str, keywords: Keywords, root: Path = ROOT
) -> Iterator[tuple[English, str]]:
    extracted = extract_from_dir(
        root / folder,
        method_map=[("node_modules/**", "ignore"), ("vendor/**", "ignore"), (pattern, method)],
        options_map={pattern: {"trimmed": "true", "silent": "false"}}
        if method == "jinja2"
        else None,
        keywords=keywords,
    )
    for file, _, text, *_ in sorted(extracted, key=lambda each: each[:2]):
        english = text if isinstance(text, str) else (text[0], text[1])
        yield english, f"{folder}/{file}"


def _scene_texts() -> Iterator[tuple[English, str]]:
    templates = template_names()
    for name in (*Scene.names(), *templates):
        loaded = load_by_name(name)
        assert loaded is not None
        scene, folder = loaded.description, "templates" if name in templates else "library"
        for text in (scene.title, scene.goal, scene.controls, scene.rewards):
            if text:
                yield text, f"ai4u_edu/scenes/{folder}/{name}.yaml"


def _mission_texts() -> Iterator[tuple[English, str]]:
    for name, mission in library_missions().by_name.items():
        for text in mission.texts():
            yield text, f"ai4u_edu/missions/library/{name}.yaml"


def _lesson_domains() -> Iterator[Domain]:
    for lesson in lessons():
        domain = Domain(f"{LESSONS}/{lesson.name}")
        domain.texts += _in_cells(lesson.cells, f"lessons/{lesson.path.name}")
        for exercise in lesson.exercises:
            if not is_ticket(exercise):
                cell = Cell(answers_to(exercise).solution)
                domain.texts += _in_cells([cell], f"lessons/answers/{exercise}.py")
        yield domain


def _page_domains() -> Iterator[Domain]:
    for name, path in PAGES.items():
        cell = Cell(path.read_text(encoding="utf-8"), is_text=True)
        yield Domain(name, _in_cells([cell], path.relative_to(ROOT).as_posix()))


def page_translation(language: str, domain: str, text: str) -> str:
    """Return a page of the docs in a language; what has no translation stays English.

    Args:
        language: the language's code.
        domain: the page's domain, a key of :data:`PAGES`.
        text: the page in English, as Markdown.
    """
    translate = translation(language, domain)
    return translated_cell(Cell(text, is_text=True), translate).source + "\n"


def translation(language: str, domain: str) -> Callable[[str], str]:
    """Return a function that translates texts without values, by the ``.po`` file of a domain."""
    texts = {message.id: str(message.string) for message in translated(read(language, domain))}
    return lambda text: texts.get(text, text)


def readme_file(language: str) -> Path:
    """Return the place of the repository's README in a language."""
    return README.with_name(f"README.{language.replace('_', '-')}.md")


def readme(language: str) -> str:
    """Return the repository's README in a language, with a link to the English one."""
    text = page_translation(language, f"{DOCS}/repository", README.read_text(encoding="utf-8"))
    own, english = LANGUAGES[language], LANGUAGES[SOURCE]
    return text.replace(
        f'{english} · <a href="{readme_file(language).name}">{own}</a>',
        f'<a href="{README.name}">{english}</a> · {own}',
        1,
    )


def _in_cells(cells: Iterable[Cell], file: str) -> list[tuple[English, str]]:
    return [(text, file) for cell in cells for text in texts_of(cell)]


def po_file(language: str, domain: str) -> Path:
    """Return the catalogue that a translator edits."""
    if domain.startswith(f"{DOCS}/"):
        name = domain.removeprefix(f"{DOCS}/")
        return ROOT / "docs" / "locale" / language / "LC_MESSAGES" / f"{name}.po"
    return catalogue_file(language, f"{domain}.po")


def read(language: str, domain: str) -> Catalog:
    """Return a catalogue; an empty one if it has no file."""
    file = po_file(language, domain)
    if file.is_file():
        content = file.read_bytes()
    else:
        rule = PLURAL_FORMS.get(language) or Catalog(locale=language).plural_forms
        content = f'msgid ""\nmsgstr ""\n"Plural-Forms: {rule}\\n"\n'.encode()
    catalog = read_po(io.BytesIO(content), locale=language)
    catalog.creation_date = catalog.revision_date = NO_DATE  # the same texts, the same bytes
    return catalog


def update() -> None:
    """Merge all English texts into all catalogues, and compile them."""
    for domain in domains():
        for language in TRANSLATED:
            catalog = read(language, domain.name)
            catalog.update(domain.template(), update_header_comment=False)
            file = po_file(language, domain.name)
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(po_text(catalog))
    compile_all()


def po_text(catalog: Catalog) -> bytes:
    """Return the text of a ``.po`` file; the same texts give the same file."""
    catalog.header_comment, catalog.fuzzy = "", False
    written = io.BytesIO()
    write_po(written, catalog, width=100, include_lineno=False, ignore_obsolete=True)
    dates = rb'"(POT-Creation-Date|PO-Revision-Date|Generated-By|Last-Translator|Language-Team|'
    dates += rb"Report-Msgid-Bugs-To):[^\n]*\n"
    return re.sub(dates, b"", written.getvalue()).lstrip(b"#\n")


def compile_all() -> None:
    """Write what the program reads."""
    for language in TRANSLATED:
        folder = catalogue_file(language, "")
        for file in sorted(folder.rglob("*.po")):
            domain = file.relative_to(folder).with_suffix("").as_posix()
            compiled(language, domain).write_bytes(compiled_content(language, domain))
        readme_file(language).write_text(readme(language), encoding="utf-8")


def compiled(language: str, domain: str) -> Path:
    """Return the file that the program reads; domains of the docs have none."""
    suffix = ".json" if domain == PAGE else ".mo"
    return catalogue_file(language, f"{domain}{suffix}")


def compiled_content(language: str, domain: str) -> bytes:
    """Return its content; what is fuzzy or missing is left out."""
    catalog = read(language, domain)
    if domain == PAGE:
        return (json.dumps(_by_category(catalog), indent=0, ensure_ascii=False) + "\n").encode()
    written = io.BytesIO()
    write_mo(written, catalog)
    return written.getvalue()


def _by_category(catalog: Catalog) -> dict[str, str | dict[str, str]]:
    """Return the texts of a catalogue, with plurals by the categories of CLDR."""
    form_of = _form_of_category(catalog)
    texts: dict[str, str | dict[str, str]] = {}
    for message in translated(catalog):
        if isinstance(message.id, str):
            texts[message.id] = str(message.string)
        else:
            forms = _strings(message)
            texts[message.id[0]] = {name: forms[number] for name, number in form_of.items()}
    return texts


def _form_of_category(catalog: Catalog) -> dict[str, int]:
    plural_form = Locale.parse(catalog.locale_identifier).plural_form
    number_of_form: Callable[[int], int] = c2py(catalog.plural_expr)
    return {
        plural_form(number): number_of_form(number) for number in reversed(range(MAX_COUNT_TRIED))
    }


def translated(catalog: Catalog) -> Iterator[Message]:
    """Yield the messages that have a translation to show."""
    for message in catalog:
        if message.id and message.string and not message.fuzzy and all(_strings(message)):
            yield message


def _strings(message: Message) -> tuple[str, ...]:
    string = message.string
    return (string,) if isinstance(string, str) else tuple(string or ())


def problems_of(message: Message) -> Iterator[str]:
    """Yield what a translation lost or added: values, markup, code."""
    ids = (message.id,) if isinstance(message.id, str) else message.id
    for string in _strings(message):
        for what, pattern in (("values", _VALUES), ("markup", _MARKUP)):
            wanted = [Counter(pattern.findall(each)) for each in ids]
            got = Counter(pattern.findall(string))
            if got not in wanted:
                yield f"{what}: expected {dict(wanted[-1])}, got {dict(got)} in {string!r}"


def report() -> None:
    """Print how many texts and words each catalogue has, and how many are translated."""
    print("| language | domain | texts | words | translated |\n|---|---|---|---|---|")
    for domain in domains():
        texts = {text for text, _ in domain.texts}
        words = sum(len(_first(text).split()) for text in texts)
        for language in TRANSLATED:
            known = {message.id for message in translated(read(language, domain.name))}
            done = f"{100 * len(texts & known) // len(texts)}%" if texts else "-"
            print(f"| {language} | {domain.name} | {len(texts)} | {words} | {done} |")


def _first(text: str | tuple[str, str]) -> str:
    return text if isinstance(text, str) else text[0]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    commands = {"update": update, "compile": compile_all, "report": report}
    parser.add_argument("command", choices=commands)
    commands[parser.parse_args().command]()
