"""Plots of explanations with matplotlib, which ``pip install "ai4u-edu[lessons]"`` installs.

Each returns a figure, which a notebook shows and ``figure.savefig("why.png")`` writes. Colours can
be told apart by people who see fewer of them.
"""

import textwrap
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.explain.disagreement import Disagreement
from ai4u_edu.explain.field import ActionField
from ai4u_edu.explain.occlusion import LIMITS, Occlusion
from ai4u_edu.explain.reward_terms import RewardTerms
from ai4u_edu.explain.value_map import ValueMap
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

MAX_BARS = 30
"""Most groups in a bar chart: those that matter most."""
COLOURS = ("blue", "orange", "green", "vermillion", "purple", "sky blue", "black")


def plot_occlusion(told: Occlusion, names: Sequence[str] = ()) -> Figure:
    """Plot how far each group of slots moves each number of the action.

    Args:
        told: the result of :func:`~ai4u_edu.explain.occlusion`.
        names: names of the action's numbers.
    """
    kept = sorted(np.argsort(-told.importance, kind="stable")[:MAX_BARS].tolist())
    components = list(names) if len(names) == len(told.components) else list(told.components)
    figure = Figure(
        figsize=(2.2 + 2 * len(components), 1.4 + 0.24 * len(kept)), layout="constrained"
    )
    count = max(1, len(components))
    panels: Any = figure.subplots(1, count, sharex=True, sharey=True, squeeze=False)[0]
    places = np.arange(len(kept))
    for column, (panel, name) in enumerate(zip(panels, components, strict=False)):
        moved = told.shift[kept, column]
        colours = [PALETTE["blue" if each >= 0 else "orange"] for each in moved]
        panel.barh(places, moved, color=colours)
        panel.axvline(0, color="grey", linewidth=0.8)
        panel.set(title=f"{name} = {told.action[column]:.2f}", xlabel=translate(_("moved by")))
        panel.set_yticks(places, [translate(told.names[row]) for row in kept])
    panels[0].invert_yaxis()
    figure.supxlabel(
        "\n".join(textwrap.wrap(translate(LIMITS), 30 * len(panels) + 10)), fontsize="x-small"
    )
    return figure


def plot_field(told: ActionField) -> Figure:
    """Plot where each pose goes in one decision: arrows, coloured by the side it turns to."""
    figure = Figure(figsize=(6, 5.4), layout="constrained")
    panel = figure.subplots()
    here = told.can_stand.astype(bool)
    poses, moves = told.poses[here], told.moves[here]
    turns = moves[:, 2]
    side = _spacing(told.poses) * 0.45
    angles = poses[:, 2] + turns
    drives = np.hypot(moves[:, 0], moves[:, 1])
    # who drives points where it goes, who turns on the spot where it looks then
    angles = np.where(drives > 1e-3, np.arctan2(moves[:, 1], moves[:, 0]), angles)
    for name, colour, chosen in (
        (_("turns left"), "blue", turns > 0.02),
        (_("turns right"), "orange", turns < -0.02),
        (_("goes straight"), "black", np.abs(turns) <= 0.02),
    ):
        x, y = poses[chosen, 0], poses[chosen, 1]
        dx, dy = side * np.cos(angles[chosen]), side * np.sin(angles[chosen])
        panel.quiver(
            x,
            y,
            dx,
            dy,
            angles="xy",
            scale_units="xy",
            scale=0.5,
            width=0.004,
            color=PALETTE[colour],
            label=translate(name),
        )
    blocked = told.poses[~here]
    panel.plot(
        blocked[:, 0],
        blocked[:, 1],
        "x",
        color="lightgrey",
        markersize=3,
        label=translate(_("no room")),
    )
    panel.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    figure.legend(loc="outside lower center", ncols=4, fontsize="small")
    return figure


def plot_value_map(told: ValueMap) -> Figure:
    """Plot values as a heat map with a legend; colours are cividis, safe for all eyes."""
    figure = Figure(figsize=(6, 5), layout="constrained")
    panel = figure.subplots()
    side = _spacing(told.poses)
    xs, ys = np.unique(told.poses[:, 0]), np.unique(told.poses[:, 1])
    table = np.full((len(ys), len(xs)), np.nan)
    rows, columns = np.searchsorted(ys, told.poses[:, 1]), np.searchsorted(xs, told.poses[:, 0])
    table[rows, columns] = told.values
    edges = (xs[0] - side / 2, xs[-1] + side / 2, ys[0] - side / 2, ys[-1] + side / 2)
    image = panel.imshow(table, origin="lower", extent=edges, cmap="cividis", aspect="equal")
    panel.set(xlabel="x (m)", ylabel="y (m)")
    label = _("what one episode pays, discounted")
    if told.source == "critic":
        label = _("what its critic expects, discounted")
    figure.colorbar(image, label=translate(label))
    return figure


def plot_disagreement(told: Disagreement, names: tuple[str, str] = ("first", "second")) -> Figure:
    """Plot the actions of two policies over the decisions, and where they first disagree."""
    count = max(1, len(told.components))
    figure = Figure(figsize=(8, 1.6 * count + 0.6), layout="constrained")
    panels: Any = figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
    for column, (panel, component) in enumerate(zip(panels, told.components, strict=False)):
        panel.plot(told.first[:, column], color=PALETTE["blue"], label=names[0])
        panel.plot(told.second[:, column], color=PALETTE["orange"], linestyle="--", label=names[1])
        if told.step is not None:
            panel.axvline(told.step, color="grey", linewidth=1)
        panel.set_ylabel(component)
    panels[-1].set_xlabel(translate(_("decision")))
    panels[0].legend(fontsize="small")
    return figure


def plot_reward_terms(told: RewardTerms) -> Figure:
    """Plot the sum of each reward term so far over time, with the moments that paid most."""
    figure = Figure(figsize=(8, 3.6), layout="constrained")
    panel = figure.subplots()
    for column, name in enumerate(told.terms):
        colour = PALETTE[COLOURS[column % len(COLOURS)]]
        panel.plot(told.seconds, told.amounts[:, column].cumsum(), color=colour, label=name)
    for step in told.moments():
        panel.axvline(told.seconds[step], color="grey", linewidth=0.8, linestyle=":")
    panel.set(xlabel=translate(_("time (s)")), ylabel=translate(_("reward so far")))
    if told.terms:
        panel.legend(fontsize="small")
    return figure


def _spacing(poses: Any) -> float:
    """Return the distance between neighbours in a grid."""
    xs = np.unique(poses[:, 0])
    return float(np.diff(xs).min()) if len(xs) > 1 else 1.0
