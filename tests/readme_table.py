"""Writes the README's table of AI4U's names anew: ``python -m tests.readme_table``."""

import re
from pathlib import Path

README = Path(__file__).parents[1] / "README.md"
MARKS = re.compile(r"(<!-- coming from AI4U -->\n)(.*?)(\n?<!-- end -->)", re.DOTALL)


def between_marks(text: str) -> str:
    """The table as it stands in the README."""
    found = MARKS.search(text)
    return found[2] if found else ""


def main() -> None:
    """Replaces the table by what the code says."""
    from ai4u_edu.blocks.docs import coming_from_ai4u

    text = README.read_text(encoding="utf-8")
    fresh = MARKS.sub(lambda match: f"{match[1]}{coming_from_ai4u()}\n<!-- end -->", text)
    README.write_text(fresh, encoding="utf-8")


if __name__ == "__main__":
    main()
