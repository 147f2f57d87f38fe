"""HTML from templates, which stand beside the modules that fill them. All values are escaped.

Reports extend ``base/report_layout.html``: one page that loads nothing else. Texts in templates,
such as ``{{ _("Mistakes") }}``, are shown in the reader's language.
"""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ai4u_edu.locale import catalogue, ngettext, translate


def with_texts(templates: Environment) -> Environment:
    """Let templates translate their texts; each time one is rendered, it has a reader."""
    templates.add_extension("jinja2.ext.i18n")
    templates.policies["ext.i18n.trimmed"] = True
    templates.filters["translate"] = translate
    templates.globals["language"] = lambda: catalogue().language.replace("_", "-")
    templates.install_gettext_callables(  # type: ignore[attr-defined]  # of the extension
        lambda text: catalogue().message(text),
        lambda one, many, number: catalogue().translate(ngettext(one, many, number)),
    )
    return templates


_TEMPLATES = with_texts(
    Environment(
        loader=FileSystemLoader(Path(__file__).resolve().parents[1]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
)


def render_html(template: str, **values: object) -> str:
    """Return the HTML that a template makes of values.

    Args:
        template: path of its file in the package.
        values: by their names in the template.
    """
    return _TEMPLATES.get_template(template).render(values)
