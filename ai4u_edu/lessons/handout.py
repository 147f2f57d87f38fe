"""Copying of the course into a student's folder; a student's work is never overwritten."""

import hashlib
import json
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.course import course_folder, lessons
from ai4u_edu.lessons.notebook import dumps
from ai4u_edu.lessons.progress_file import FOLDER
from ai4u_edu.lessons.translation import GLOSSARY, translated_lesson, translated_page
from ai4u_edu.locale import SOURCE
from ai4u_edu.locale import gettext as _

LAB = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}
"""Settings of JupyterLab that keep it from asking to fetch news from the internet."""
LAB_PLUGINS: dict[str, dict[str, Any]] = {
    "@jupyterlab/docmanager-extension:plugin": {"autosaveInterval": 10}
}
"""Settings of JupyterLab's plugins: notebooks are saved every 10 s, in place of 120 s."""
BOOK = "handed-out.json"
"""File in the hidden folder with the version of each notebook that was handed out."""


@dataclass
class HandedOut:
    """Outcome for each notebook."""

    folder: Path
    new: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)
    """Notebooks that existed and were left as they are."""
    beside: list[str] = field(default_factory=list)
    """Newer versions, written beside existing notebooks."""


def hand_out(folder: Path, language: str = SOURCE) -> HandedOut:
    """Write the notebooks, their pictures and the glossary.

    An existing notebook stays. If the course has a newer version, that is written beside it, as
    ``NAME.new.ipynb``.

    Args:
        folder: the student's folder.
        language: code of their language, such as ``pt_BR``; what has no translation is
            English.

    Raises:
        SetupError: the folder can't be written to.
    """
    done = HandedOut(folder)
    try:
        (folder / FOLDER).mkdir(parents=True, exist_ok=True)
        shutil.copytree(course_folder() / "pictures", folder / "pictures", dirs_exist_ok=True)
        write_atomically(folder / f"{GLOSSARY}.md", translated_page(GLOSSARY, language))
        config = lab_config(folder) / "labconfig"
        config.mkdir(parents=True, exist_ok=True)
        write_atomically(config / "page_config.json", json.dumps(LAB, indent=1))
        overrides = config / "default_setting_overrides.json"
        write_atomically(overrides, json.dumps(_lab_plugins(language), indent=1))
        book = _read(folder / FOLDER / BOOK)
        for lesson in lessons():
            text = dumps(translated_lesson(lesson.name, lesson.cells, language))
            print_ = hashlib.sha256(text.encode()).hexdigest()
            path = folder / f"{lesson.name}.ipynb"
            if not path.exists():
                write_atomically(path, text)
                done.new.append(path.name)
            elif book.get(lesson.name, print_) == print_:
                done.kept.append(path.name)
            else:
                path = folder / f"{lesson.name}.new.ipynb"
                write_atomically(path, text)
                done.beside.append(path.name)
            book[lesson.name] = print_
        write_atomically(folder / FOLDER / BOOK, json.dumps(book, indent=1))
    except OSError as error:
        raise SetupError(
            _(
                "expected to write into {folder}, and couldn't: {problem}",
                folder=str(folder),
                problem=str(error),
            )
        ) from None
    return done


def _lab_plugins(language: str) -> dict[str, dict[str, Any]]:
    """Return settings of JupyterLab's plugins, with the course's language."""
    if language == SOURCE:
        return LAB_PLUGINS
    return {**LAB_PLUGINS, "@jupyterlab/translation-extension:plugin": {"locale": language}}


def lab_config(folder: Path) -> Path:
    """Return the folder of JupyterLab's settings."""
    return folder.absolute() / FOLDER / "jupyter"


def _read(path: Path) -> dict[str, str]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {str(k): str(v) for k, v in found.items()} if isinstance(found, dict) else {}
