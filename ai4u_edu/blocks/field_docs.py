"""The texts under the fields of a class, which describe its parameters."""

import ast
from functools import cache
from itertools import pairwise

from ai4u_edu.base.syntax import parsed_class


@cache
def field_docs(cls: type) -> dict[str, str]:
    """Return the text under each annotated field of a class and its bases; {} without source.

    It parses the source on demand, not when the class is made: most runs need no descriptions.
    """
    docs: dict[str, str] = {}
    for each in reversed(cls.__mro__[:-1]):
        try:
            tree = parsed_class(each)
        except (OSError, TypeError, SyntaxError):
            continue  # defined in a console, or built into Python
        body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) else []
        for field, text in pairwise(body):
            if (
                isinstance(field, ast.AnnAssign)
                and isinstance(field.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
                and isinstance(text.value.value, str)
            ):
                docs[field.target.id] = " ".join(text.value.value.split())
    return docs
