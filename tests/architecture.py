"""Draw docs/architecture.svg from the code: ``python -m tests.architecture``.

Each row is a layer of pyproject.toml's import contract. A box has the first line of its package's
docstring, and an arrow leads to what the package imports; arrows that follow from others are left
out.
"""

import ast
import textwrap
import tomllib
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "ai4u_edu"
PICTURE = ROOT / "docs" / "architecture.svg"
LEFT_OUT = {"__main__", "bootstrap", "registration"}
"""Modules beside the packages: entry points."""
WIDTH, ROW, BOX_HEIGHT, GAP, LINE = 1000, 92, 62, 20, 15
MAX_LINE_CHARS = {1: 100, 2: 62, 3: 42, 4: 30}
"""Length of a line in a box, by the number of boxes in its row."""

Box = tuple[float, float, float]
"""Left, top and width."""


def layers() -> list[list[str]]:
    """Return the packages of each layer, the topmost layer first."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contract = next(
        c for c in project["tool"]["importlinter"]["contracts"] if c["type"] == "layers"
    )
    rows = [[name.strip() for name in row.split("|")] for row in contract["layers"]]
    kept = [[name for name in row if name not in LEFT_OUT] for row in rows]
    return [row for row in kept if row]


def imports() -> dict[str, set[str]]:
    """Return the packages that each package imports, those under ``TYPE_CHECKING`` included."""
    names = {name for row in layers() for name in row}
    found: dict[str, set[str]] = {name: set() for name in names}
    for name in names:
        for file in sorted((PACKAGE / name).rglob("*.py")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ImportFrom) and node.module:
                    parts = [*node.module.split("."), *(each.name for each in node.names[:1])]
                    if parts[0] == "ai4u_edu" and parts[1] in names - {name}:
                        found[name].add(parts[1])
    return found


def reduced(graph: dict[str, set[str]]) -> dict[str, set[str]]:
    """Return the graph without the edges that follow from others."""

    def reach(name: str) -> set[str]:
        return {name}.union(*(reach(each) for each in graph[name]))

    return {
        name: {
            each
            for each in direct
            if not any(each in reach(other) for other in direct if other != each)
        }
        for name, direct in graph.items()
    }


def summary(name: str) -> str:
    """Return the first line of a package's docstring."""
    tree = ast.parse((PACKAGE / name / "__init__.py").read_text(encoding="utf-8"))
    return (ast.get_docstring(tree) or "").partition("\n")[0]


def draw() -> str:
    """Return the picture as SVG."""
    rows, boxes, parts = layers(), dict[str, Box](), list[str]()
    for number, row in enumerate(rows):
        width = (WIDTH - GAP * (len(row) + 1)) / len(row)
        for place, name in enumerate(row):
            boxes[name] = (GAP + place * (width + GAP), GAP + number * ROW, width)
    for name, targets in sorted(reduced(imports()).items()):
        left, top, width = boxes[name]
        for target in sorted(targets):
            there_left, there_top, there_width = boxes[target]
            x1, x2 = left + width / 2, there_left + there_width / 2
            y1, y2 = top + BOX_HEIGHT, there_top - 4
            parts.append(
                f'<path d="M{x1:.0f} {y1:.0f} C{x1:.0f} {(y1 + y2) / 2:.0f} {x2:.0f} '
                f'{(y1 + y2) / 2:.0f} {x2:.0f} {y2:.0f}" class="arrow"/>'
            )
    for row in rows:
        for name in row:
            left, top, width = boxes[name]
            parts.append(
                f'<rect x="{left:.0f}" y="{top}" width="{width:.0f}" height="{BOX_HEIGHT}" rx="6"/>'
                f'<text x="{left + 10:.0f}" y="{top + 18}" class="name">{name}</text>'
            )
            lines = textwrap.wrap(summary(name), MAX_LINE_CHARS[len(row)])[:2]
            for place, line in enumerate(lines):
                y = top + 36 + place * LINE
                parts.append(f'<text x="{left + 10:.0f}" y="{y}">{escape(line)}</text>')
    height = GAP + len(rows) * ROW
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="sans-serif" font-size="12">\n<style>rect{fill:#eef3f8;stroke:#56789a}'
        ".name{font-weight:bold;font-size:14px}.arrow{fill:none;stroke:#c2703d;stroke-width:1.3;"
        "marker-end:url(#head)}</style>\n"
        '<defs><marker id="head" markerWidth="8" markerHeight="8" refX="6" refY="3" orient="auto">'
        '<path d="M0 0 L6 3 L0 6 z" fill="#c2703d"/></marker></defs>\n'
        f'<rect width="{WIDTH}" height="{height}" style="fill:#fff;stroke:none"/>\n'
        + "\n".join(parts)
        + "\n</svg>\n"
    )


if __name__ == "__main__":
    PICTURE.write_text(draw(), encoding="utf-8")
