"""Languages: English texts in code, and their translations where they are shown.

Code makes texts with :func:`gettext` (imported as ``_``) and :func:`ngettext`. They stay English,
as strings, until they reach a reader: a page's socket, a terminal, a notebook's card. There a
:class:`Catalogue` translates them. English is the key; what has no translation is shown in English.
"""

from ai4u_edu.locale.catalogues import (
    LESSONS,
    PAGE,
    Catalogue,
    catalogue,
    in_chosen_language,
    page_catalogue,
    reader,
    set_language,
    translate,
)
from ai4u_edu.locale.languages import (
    LANGUAGES,
    PSEUDO,
    SOURCE,
    VARIABLE,
    known_language,
    language_of_environment,
    language_of_header,
    language_of_page,
)
from ai4u_edu.locale.text import (
    LIBRARY,
    PACKED,
    PYTHON,
    Text,
    gettext,
    join,
    library_text,
    listed,
    ngettext,
    packed,
    sentence,
    unpacked,
)

__all__ = [
    "LANGUAGES",
    "LESSONS",
    "LIBRARY",
    "PACKED",
    "PAGE",
    "PSEUDO",
    "PYTHON",
    "SOURCE",
    "VARIABLE",
    "Catalogue",
    "Text",
    "catalogue",
    "gettext",
    "in_chosen_language",
    "join",
    "known_language",
    "language_of_environment",
    "language_of_header",
    "language_of_page",
    "library_text",
    "listed",
    "ngettext",
    "packed",
    "page_catalogue",
    "reader",
    "sentence",
    "set_language",
    "translate",
    "unpacked",
]
