"""Reports as one HTML page that needs nothing else: no script but our own, all texts escaped."""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_TEMPLATES = Environment(
    loader=FileSystemLoader(Path(__file__).resolve().parents[1]),
    autoescape=True,
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


def html_report(template: str, **values: object) -> str:
    """Return a report.

    Args:
        template: path of its file in the package. It extends ``base/report_layout.html``.
        values: for the template, which escapes them.
    """
    return _TEMPLATES.get_template(template).render(values)
