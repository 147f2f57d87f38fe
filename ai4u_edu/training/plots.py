"""Pictures of evaluations and trainings, as PNG. Loads matplotlib."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ai4u_edu.palette import PALETTE
from ai4u_edu.training.evaluating import Evaluation
from ai4u_edu.training.run import Check

COLOURS = ("blue", "orange", "green", "vermillion", "purple", "sky blue", "black")
MARKERS = "osD^v<>"
"""Besides its colour each line has a marker of its own."""


def plot_evaluations(evaluations: Sequence[Evaluation], path: Path) -> None:
    """Success with its interval, and the returns and lengths of all episodes."""
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
    success.set(xlim=(-0.03, 1.03), xlabel="success (with 95% interval)", yticks=places)
    success.set_yticks(places, [each.name for each in evaluations])
    success.invert_yaxis()
    returns.set_xlabel("return of an episode")
    lengths.set_xlabel("decisions in an episode")
    _save(figure, path)


def plot_curves(curves: Mapping[str, Mapping[str, Sequence[Check]]], path: Path) -> None:
    """Success by steps: a panel a title, a line a training."""
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
                label=name,
            )
        panel.set(title=title, xlabel="decisions learned from", ylim=(-0.03, 1.03))
        panel.set_xlim(left=0)
        panel.locator_params(axis="x", nbins=5)
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("success in a check")
    panels[0].legend(fontsize="small")
    _save(figure, path)


def _colour(index: int) -> str:
    return PALETTE[COLOURS[index % len(COLOURS)]]


def _save(figure: Figure, path: Path) -> None:
    FigureCanvasAgg(figure)
    figure.savefig(path, dpi=120)
