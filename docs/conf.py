"""Settings of Sphinx for the docs site; ``python -m tests.docs_site`` builds it.

The sources are not this folder, but what ``tests/docs_site/staging.py`` makes of it.
"""

from ai4u_edu.base.version import __version__

project = "AI4U Edu"
author = "The AI4U Edu authors"
release = __version__
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "tests.docs_site.extension",
]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["files"]
nitpicky = True
smartquotes_action = "qe"  # -- is an option's beginning, and no dash

myst_heading_anchors = 6  # links to #headings, as on GitHub
myst_enable_extensions = ["html_image"]  # <img> with a width, for pages on GitHub
myst_links_external_new_tab = False

autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True  # attributes with a text of their own are listed once
toc_object_entries_show_parents = "hide"

html_theme = "furo"
templates_path = ["_templates"]
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/languages.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_title = f"AI4U Edu {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = [("site.js", {"defer": "defer"})]
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {
        "color-brand-primary": "#0a5c8f",
        "color-brand-content": "#0a5c8f",
        "color-brand-visited": "#6a3d8f",
    },
    "dark_css_variables": {
        "color-brand-primary": "#7cc4f5",
        "color-brand-content": "#7cc4f5",
        "color-brand-visited": "#c9a6ea",
    },
    "footer_icons": [],
}
