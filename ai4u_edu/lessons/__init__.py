"""Functions for the lessons' notebooks.

::

    from ai4u_edu.lessons import check, hint, progress, report, show, solution

Imports are lazy, so that the command line starts quickly.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ai4u_edu.lessons.checking import check, hint, progress, solution
    from ai4u_edu.lessons.class_membership import join_class, leave_class, submit
    from ai4u_edu.lessons.controls import cards, sliders
    from ai4u_edu.lessons.filming import film
    from ai4u_edu.lessons.plots import bars, plot
    from ai4u_edu.lessons.predictions import compare, predict
    from ai4u_edu.lessons.readiness import ready
    from ai4u_edu.lessons.report_page import report
    from ai4u_edu.lessons.showing import show, stop

__all__ = [
    "bars",
    "cards",
    "check",
    "compare",
    "film",
    "hint",
    "join_class",
    "leave_class",
    "plot",
    "predict",
    "progress",
    "ready",
    "report",
    "show",
    "sliders",
    "solution",
    "stop",
    "submit",
]

_HOMES = {
    "checking": ("check", "hint", "progress", "solution"),
    "class_membership": ("join_class", "leave_class", "submit"),
    "controls": ("cards", "sliders"),
    "filming": ("film",),
    "predictions": ("compare", "predict"),
    "report_page": ("report",),
    "showing": ("show", "stop"),
    "plots": ("bars", "plot"),
    "readiness": ("ready",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}


def __getattr__(name: str) -> object:
    from importlib import import_module

    if name not in _HOME_OF:
        raise AttributeError(f"module 'ai4u_edu.lessons' has no attribute {name!r}")
    value = getattr(import_module(f"ai4u_edu.lessons.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value
