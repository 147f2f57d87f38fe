"""Write the table of AI4U's names in docs/from-ai4u.md: ``python -m tests.ai4u_table``."""

import re
from pathlib import Path

PAGE = Path(__file__).parents[1] / "docs" / "from-ai4u.md"
MARKS = re.compile(r"(<!-- coming from AI4U -->\n)(.*?)(\n?<!-- end -->)", re.DOTALL)


def between_marks(text: str) -> str:
    """The table as it stands in the PAGE."""
    found = MARKS.search(text)
    return found[2] if found else ""


def main() -> None:
    """Replace the table by what the code says."""
    from ai4u_edu.blocks.docs import coming_from_ai4u

    text = PAGE.read_text(encoding="utf-8")
    fresh = MARKS.sub(lambda match: f"{match[1]}{coming_from_ai4u()}\n<!-- end -->", text)
    PAGE.write_text(fresh, encoding="utf-8")


if __name__ == "__main__":
    main()
