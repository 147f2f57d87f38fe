"""HTML from templates, which stand beside the modules that fill them. All values are escaped.

Reports extend ``base/report_layout.html``: one page that loads nothing else.
"""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_TEMPLATES = Environment(
    loader=FileSystemLoader(Path(__file__).resolve().parents[1]),
    autoescape=True,
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)


def render_html(template: str, **values: object) -> str:
    """Return the HTML that a template makes of values.

    Args:
        template: path of its file in the package.
        values: by their names in the template.
    """
    return _TEMPLATES.get_template(template).render(values)
