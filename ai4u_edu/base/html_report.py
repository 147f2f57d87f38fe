"""Reports as one HTML page that needs nothing else: no script but our own, all texts escaped."""

import base64
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
STYLE = """
:root{color-scheme:light dark;--text:#1b2530;--soft:#5a6672;--line:#d5dae0;--back:#fff;
--card:#f5f7f9;--mark:#0072b2}
@media(prefers-color-scheme:dark){:root{--text:#e6eaee;--soft:#a2adb8;--line:#3a444e;
--back:#14191e;--card:#1d242b;--mark:#56b4e9}}
*{box-sizing:border-box}
body{font:15px/1.5 system-ui,sans-serif;color:var(--text);background:var(--back);margin:0 auto;
max-width:1100px;padding:1rem}
h1{font-size:1.5rem;margin:.3em 0}h2{font-size:1.1rem;margin:1.6em 0 .4em}
p{margin:.4em 0}.soft{color:var(--soft)}
.scroll{overflow-x:auto}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
td,th{padding:.25em .6em;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
th{color:var(--soft);font-weight:600}td.text,th.text{text-align:left}
tr.mark td{background:var(--card);font-weight:600}
td.error{color:var(--soft);text-align:left;white-space:normal}
img{max-width:100%;height:auto;background:#fff;border:1px solid var(--line);border-radius:6px}
code{background:var(--card);padding:.1em .35em;border-radius:4px;overflow-wrap:anywhere}
"""


def html_page(title: str, parts: Iterable[str], *, policy: str = POLICY, style: str = "") -> str:
    """Return a page.

    Args:
        title: plain text.
        parts: HTML.
        policy: Content-Security-Policy of the page.
        style: CSS after the common one.
    """
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        f"<title>{escape(title)}</title><style>{STYLE}{style}</style></head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n" + "\n".join(parts) + "\n</body></html>\n"
    )


def html_table(
    headings: Sequence[str],
    rows: Iterable[Sequence[object]],
    *,
    text_columns: Iterable[int] = (0,),
    marked: Iterable[int] = (),
) -> str:
    """Return a table; it scrolls sideways where it is wider than the page.

    Args:
        headings: plain texts.
        rows: values, shown as plain texts.
        text_columns: indices of the columns that are aligned to the left.
        marked: indices of rows to stress.
    """
    texts, stressed = set(text_columns), set(marked)

    def cell(tag: str, place: int, value: object) -> str:
        kind = ' class="text"' if place in texts else ""
        return f"<{tag}{kind}>{escape(str(value))}</{tag}>"

    head = "".join(cell("th", place, each) for place, each in enumerate(headings))
    body = "\n".join(
        ('<tr class="mark">' if number in stressed else "<tr>")
        + "".join(cell("td", place, each) for place, each in enumerate(row))
        + "</tr>"
        for number, row in enumerate(rows)
    )
    return f'<div class="scroll"><table><tr>{head}</tr>\n{body}</table></div>'


def html_picture(path: Path, title: str) -> str:
    """Return a PNG picture, embedded.

    Args:
        path: of the picture.
        title: what it shows, for those who can't see it.
    """
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<img alt="{escape(title)}" src="data:image/png;base64,{data}">'
