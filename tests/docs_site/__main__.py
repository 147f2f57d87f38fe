"""Build the docs site: ``python -m tests.docs_site``; it needs ``pip install -e ".[docs]"``.

Warnings are errors, among them links and anchors that lead nowhere. Links to other hosts are listed
in ``external_links.txt`` beside the pages, and not fetched.
"""

import argparse
import sys
from pathlib import Path

from sphinx.cmd.build import build_main

from tests.docs_site.api_pages import add_api
from tests.docs_site.block_pages import add_blocks
from tests.docs_site.cli_pages import add_commands
from tests.docs_site.lesson_pages import add_lesson_checks
from tests.docs_site.protocol_pages import add_protocol
from tests.docs_site.scene_pages import add_scenes
from tests.docs_site.staging import ROOT, Staging

DEFAULT_OUT = ROOT / "build" / "site"
GENERATED = (add_api, add_blocks, add_commands, add_lesson_checks, add_protocol, add_scenes)


def stage(folder: Path) -> None:
    """Write the sources that Sphinx reads into a folder."""
    site = Staging(folder)
    site.add_repository()
    for add in GENERATED:
        add(site)
    site.close()


def build(out: Path, builder: str = "html", language: str = "") -> int:
    """Build the site; return the exit status.

    Args:
        out: folder for the sources (``source``), Sphinx's own files and the result, in a folder of
            the builder's name.
        builder: Sphinx's, such as ``html`` or ``gettext``.
        language: of the catalogues in ``docs/locale``; empty for English.
    """
    stage(out / "source")
    result = out / builder / language if language else out / builder
    doctrees = out / "doctrees" / builder / language
    options = ["-b", builder, "-W", "-n", "--keep-going", "-d", str(doctrees)]
    options += ["-D", f"language={language}"] if language else []
    return build_main([*options, str(out / "source"), str(result)])


def main() -> int:
    """Build what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m tests.docs_site", description=__doc__)
    parser.add_argument("out", type=Path, nargs="?", default=DEFAULT_OUT, help="folder to write")
    parser.add_argument("--builder", default="html", help="html or gettext")
    parser.add_argument("--language", default="", help="one that docs/locale has")
    options = parser.parse_args()
    status = build(options.out, options.builder, options.language)
    if not status and options.builder == "html":
        print(f"{(options.out / 'html' / options.language / 'index.html').resolve()}")
    return status


if __name__ == "__main__":
    sys.exit(main())
