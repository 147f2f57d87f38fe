"""Plots of evaluations and trainings as picture files. Loads matplotlib."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.training.evaluating import Evaluation
from ai4u_edu.learn.training.run import Check
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

COLOURS = ("blue", "orange", "green", "vermillion", "purple", "sky blue", "black")
MARKERS = "osD^v<>"
"""Markers that tell lines apart besides their colours."""


def plot_evaluations(evaluations: Sequence[Evaluation], path: Path) -> None:
    """Plot success with its interval, and the returns and lengths of all episodes.

    Raises:
        SetupError: there are no evaluations, or the file's name ends in no picture's format.
    """
    if not evaluations:
        raise SetupError(_("expected at least one evaluation to draw, got none"))
    figure = Figure(figsize=(10, 1.2 + 0.6 * len(evaluations)), layout="constrained")
    success, returns, lengths = figure.subplots(1, 3, sharey=True)
    places = list(range(len(evaluations)))
    for place, each in zip(places, evaluations, strict=True):
        if each.success is not None and each.interval is not None:
            low, high = each.interval
            error = [[each.success - low], [high - each.success]]
            colour = _colour(place)
            success.errorbar(
                each.success,
                place,
                xerr=error,
                fmt=MARKERS[place % len(MARKERS)],
                color=colour,
                capsize=4,
            )
    returns.boxplot(
        [each.rewards for each in evaluations], positions=places, orientation="horizontal"
    )
    lengths.boxplot(
        [each.lengths for each in evaluations], positions=places, orientation="horizontal"
    )
    success.set(
        xlim=(-0.03, 1.03), xlabel=translate(_("success (with 95% interval)")), yticks=places
    )
    success.set_yticks(places, [_plain(each.name) for each in evaluations])
    success.invert_yaxis()
    returns.set_xlabel(translate(_("return of an episode")))
    lengths.set_xlabel(translate(_("decisions in an episode")))
    _save(figure, path)


def plot_curves(curves: Mapping[str, Mapping[str, Sequence[Check]]], path: Path) -> None:
    """Plot success by steps: a panel for each title, a line for each training.

    Raises:
        SetupError: there are no panels, or the file's name ends in no picture's format.
    """
    if not curves:
        raise SetupError(_("expected at least one panel to draw, got none"))
    figure = Figure(figsize=(4.2 * len(curves), 3.2), layout="constrained")
    panels: Any = figure.subplots(1, len(curves), sharey=True, squeeze=False)[0]
    for panel, (title, runs) in zip(panels, curves.items(), strict=True):
        for index, (name, checks) in enumerate(runs.items()):
            panel.plot(
                [check.steps for check in checks],
                [check.success or 0.0 for check in checks],
                color=_colour(index),
                marker=MARKERS[index % len(MARKERS)],
                markersize=4,
                label=_plain(name),
            )
        panel.set(
            title=_plain(title), xlabel=translate(_("decisions learned from")), ylim=(-0.03, 1.03)
        )
        panel.set_xlim(left=0)
        panel.locator_params(axis="x", nbins=5)
        panel.grid(alpha=0.3)
    panels[0].set_ylabel(translate(_("success in a check")))
    if panels[0].lines:
        panels[0].legend(fontsize="small")
    _save(figure, path)


def _colour(index: int) -> str:
    return PALETTE[COLOURS[index % len(COLOURS)]]


def check_picture(path: Path) -> None:
    """Check that a picture can be written in the format that a file's name ends in.

    Raises:
        SetupError: it can't; names those that can.
    """
    known = sorted(FigureCanvasBase.get_supported_filetypes())
    ending = path.suffix.lower().removeprefix(".")
    if ending not in known:
        raise SetupError(
            _(
                "{path}: expected a name that ends in .png, got {name!r}; known are {known}",
                path=str(path),
                name=path.name,
                known=", ".join(known),
            )
        )


def _plain(text: str) -> str:
    """Escape dollar signs, which matplotlib reads as formulas."""
    return text.replace("$", r"\$")


def _save(figure: Figure, path: Path) -> None:
    check_picture(path)
    FigureCanvasAgg(figure)
    figure.savefig(path, dpi=120)
