"""Build the docs site: ``python -m tests.docs_site``; it needs ``pip install -e ".[docs]"``.

The site is in English, and in a folder for each other language. Warnings are errors, among them
links and anchors that lead nowhere. Links to other hosts are listed in ``external_links.txt``
beside the pages, and not fetched.
"""

import argparse
import sys
from pathlib import Path

from sphinx.cmd.build import build_main

from ai4u_edu.locale import LANGUAGES, SOURCE
from tests.docs_site.api_pages import add_api
from tests.docs_site.block_pages import add_blocks
from tests.docs_site.cli_pages import add_commands
from tests.docs_site.lesson_pages import add_lesson_checks
from tests.docs_site.protocol_pages import add_protocol
from tests.docs_site.scene_pages import add_scenes
from tests.docs_site.staging import ROOT, Staging

DEFAULT_OUT = ROOT / "build" / "site"
GENERATED = (add_api, add_blocks, add_commands, add_lesson_checks, add_protocol, add_scenes)


def stage(folder: Path, language: str = SOURCE) -> None:
    """Write the sources that Sphinx reads into a folder.

    Args:
        folder: it is made.
        language: code of the pages' language.
    """
    site = Staging(folder, language)
    site.add_repository()
    for add in GENERATED:
        add(site)
    site.close()


def build(out: Path, language: str) -> int:
    """Build the site in a language; return the exit status.

    Args:
        out: folder for the sources (``source``), Sphinx's own files and the result (``html``), each
            with a folder for the language; the result in English is in ``html`` itself.
        language: the language's code.
    """
    source = out / "source" / language
    stage(source, language)
    result = out / "html" if language == SOURCE else out / "html" / language
    options = ["-b", "html", "-W", "-n", "--keep-going", "-d", str(out / "doctrees" / language)]
    return build_main([*options, "-D", f"language={language}", str(source), str(result)])


def main() -> int:
    """Build what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m tests.docs_site", description=__doc__)
    parser.add_argument("out", type=Path, nargs="?", default=DEFAULT_OUT, help="folder to write")
    parser.add_argument(
        "--language", choices=LANGUAGES, action="append", help="only this one (repeatable)"
    )
    options = parser.parse_args()
    status = max(build(options.out, language) for language in options.language or LANGUAGES)
    if not status:
        print(f"{(options.out / 'html' / 'index.html').resolve()}")
    return status


if __name__ == "__main__":
    sys.exit(main())
