"""Report of a sweep: one HTML page, and its pictures. Loads matplotlib."""

import base64
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.html_template import render_html
from ai4u_edu.learn.training.evaluating import Evaluation
from ai4u_edu.learn.training.settings import NO_REWARD
from ai4u_edu.learn.training.sweep.plan import SweepPlan
from ai4u_edu.learn.training.sweep.result import STATES, TrialResult, groups, ranked
from ai4u_edu.learn.training.sweep.search_space import LEFT_OUT, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

TITLES = (_("Learning curves"), _("Settings and results"), _("Without one reward term"))
COLOURS = {"sac": "blue", "ppo": "orange", "dqn": "green"}
TERM_COLOURS = ("orange", "blue", "green", "vermillion", "purple", "sky blue", "yellow")
MAX_TICK_LABELS = 8


def page_of(
    plan: SweepPlan,
    results: Sequence[TrialResult],
    evaluation: Evaluation | None,
    total: int,
    pictures: Sequence[Path],
) -> str:
    """Return the page.

    Args:
        plan: the sweep's plan.
        results: results of the trials that ended, at least one.
        evaluation: of the best network; None if there is none yet.
        total: number of trials of the whole sweep.
        pictures: drawn by :func:`draw_pictures`.
    """
    names = [each.name for each in plan.parameters]
    order = ranked(results)
    has_equal_settings = len({each.label for each in results}) < len(results)
    return render_html(
        "learn/training/sweep/page.html",
        plan=plan,
        scene=str(plan.scene["name"]).removesuffix(".yaml").removesuffix(".yml"),
        seeds=_seeds(plan.seeds),
        total=total,
        missing=total - len(results),
        counts=Counter(each.state for each in results),
        states=STATES,
        evaluation=evaluation,
        groups=groups(results) if has_equal_settings else None,
        pictures=[
            (translate(title), base64.b64encode(picture.read_bytes()).decode())
            for title, picture in zip(TITLES, pictures, strict=False)
        ],
        order=order,
        trials=[each.cells(names) for each in order],
        failed=[each for each in results if each.error],
    )


def draw_pictures(results: Sequence[TrialResult], names: Sequence[str], folder: Path) -> list[Path]:
    """Draw the pictures into a folder, and return their files.

    They are learning curves, parallel coordinates, and learning without each reward term if that
    was tried; none if no trial was checked.

    Args:
        results: results of the trials that ended.
        names: of the settings that vary.
        folder: gets the files.
    """
    if not any(result.checks for result in results):
        return []
    curves, parallel, terms = (folder / f"{name}.png" for name in ("curves", "parallel", "terms"))
    _plot_curves(results, curves)
    _plot_parallel(results, names, parallel)
    if LEFT_OUT not in names:
        return [curves, parallel]
    _plot_terms(results, terms)
    return [curves, parallel, terms]


def _seeds(seeds: Sequence[int]) -> str:
    if len(seeds) > 1 and list(seeds) == [*range(seeds[0], seeds[-1] + 1)]:
        return f"{seeds[0]}-{seeds[-1]}"
    return ", ".join(map(str, seeds))


def _plot_curves(results: Sequence[TrialResult], path: Path) -> None:
    """Plot each trial's checks by steps, coloured by algorithm; the best one is thick."""
    figure = Figure(figsize=(9, 4), layout="constrained")
    panel: Any = figure.subplots()
    checked = [each for each in ranked(results) if each.checks]
    named: set[str] = set()
    for place, each in reversed([*enumerate(checked)]):
        algorithm = each.choice.algorithm
        xs = [check.steps for check in each.checks]
        panel.plot(
            xs,
            each.curve[: len(xs)],  # without what follows an early end
            color=PALETTE[COLOURS[algorithm]],
            alpha=1.0 if place == 0 else 0.55,
            linewidth=2.8 if place == 0 else 1.2,
            linestyle="--" if each.pruned else "-",
            marker="." if len(xs) == 1 or place == 0 else "",
            label="" if algorithm in named else algorithm,
        )
        named.add(algorithm)
    has_goal = checked[0].has_goal
    panel.set(
        xlabel=translate(_("decisions learned from")),
        ylabel=translate(_("success in a check") if has_goal else _("reward")),
    )
    if has_goal:
        panel.set_ylim(-0.03, 1.03)
    panel.set_xlim(left=0)
    panel.grid(alpha=0.3)
    panel.set_title(
        translate(
            _("best: trial {number} (thick); pruned ones are dashed", number=checked[0].number)
        ),
        fontsize=10,
    )
    for handle in panel.legend(fontsize="small").get_lines():
        handle.set(alpha=1.0, linewidth=1.5, linestyle="-", marker="")
    _save(figure, path)


def _plot_parallel(results: Sequence[TrialResult], names: Sequence[str], path: Path) -> None:
    """Plot a line for each trial through its algorithm, its settings and its result."""
    checked = [each for each in results if each.checks]
    columns: dict[str, list[Any]] = {
        translate(_("algorithm")): [each.choice.algorithm for each in checked]
    }
    for name in names:
        columns[name] = [each.choice.settings.get(name) for each in checked]
    values = [each.value for each in checked]
    figure = Figure(figsize=(max(6.0, 2.2 * (len(columns) + 1)), 4), layout="constrained")
    panel: Any = figure.subplots()
    heights = [_heights(panel, place, each) for place, each in enumerate(columns.values())]
    heights.append(_heights(panel, len(columns), values))
    low, high = min(values), max(values)
    scale = Normalize(low, high if high > low else low + 1)
    lines = sorted(zip(values, *heights, strict=True))  # the best ones are drawn last
    for value, *points in lines:
        panel.plot(range(len(points)), points, color=colormaps["viridis"](scale(value)), alpha=0.7)
    title = translate(_("success") if checked[0].has_goal else _("reward"))
    labels = [name.replace("$", r"\$") for name in (*columns, title)]
    panel.set_xticks(range(len(labels)), labels)
    panel.set_yticks([])
    panel.set_xlim(-0.35, len(labels) - 0.45)
    panel.set_ylim(-0.06, 1.06)
    for side in ("left", "right", "top", "bottom"):
        panel.spines[side].set_visible(False)
    figure.colorbar(ScalarMappable(scale, colormaps["viridis"]), ax=panel, label=title)
    _save(figure, path)


def _plot_terms(results: Sequence[TrialResult], path: Path) -> None:
    """Plot how it learned without each reward term: a line a trial, thick for the mean of all.

    The training with all terms is black.
    """
    found: dict[str, list[TrialResult]] = {}
    for each in results:
        if each.checks:
            found.setdefault(str(each.choice.settings.get(LEFT_OUT, NO_REWARD)), []).append(each)
    figure = Figure(figsize=(9, 4), layout="constrained")
    panel: Any = figure.subplots()
    terms = [term for term in found if term != NO_REWARD]
    colours = {term: TERM_COLOURS[i % len(TERM_COLOURS)] for i, term in enumerate(terms)}
    for term, members in found.items():
        colour = PALETTE[colours.get(term, "black")]
        steps = max((each.checks for each in members), key=len)
        xs = [check.steps for check in steps]
        curves = np.array([each.curve for each in members])[:, : len(xs)]
        for curve in curves:
            panel.plot(xs, curve, color=colour, alpha=0.35, linewidth=0.9)
        label = _("all terms") if term == NO_REWARD else _("without {term}", term=term)
        mean = curves.mean(axis=0)
        panel.plot(xs, mean, color=colour, linewidth=2.6, marker=".", label=translate(label))
    has_goal = next(iter(found.values()))[0].has_goal
    panel.set(
        xlabel=translate(_("decisions learned from")),
        ylabel=translate(_("success in a check") if has_goal else _("reward (all terms)")),
    )
    if has_goal:
        panel.set_ylim(-0.03, 1.03)
    panel.set_xlim(left=0)
    panel.grid(alpha=0.3)
    panel.legend(fontsize="small")
    _save(figure, path)


def _heights(panel: Any, place: int, values: Sequence[Any]) -> list[float]:
    """Draw a column's axis with labels, and return the height of each value, 0..1."""
    panel.axvline(place, color="#888888", linewidth=0.8)
    known = [each for each in values if each is not None]
    is_number = all(isinstance(each, int | float) and not isinstance(each, bool) for each in known)
    if not known or not is_number:
        texts = [text_of(each) if each is not None else "-" for each in values]
        order = sorted(set(texts))
        at = {text: _share(index, len(order) - 1) for index, text in enumerate(order)}
        _label(panel, place, [(at[text], text) for text in order])
        return [at[text] for text in texts]
    is_log = min(known) > 0 and max(known) / min(known) > 20
    used = [float(np.log10(each)) if is_log else float(each) for each in known]
    low, high = min(used), max(used)
    marks = np.linspace(low, high, 5 if high > low else 1)
    _label(
        panel,
        place,
        [
            (_share(mark - low, high - low), f"{10**mark if is_log else mark:.3g}")
            for mark in marks.tolist()
        ],
    )
    left = iter(used)
    # a setting that the trial's algorithm does not have is drawn below the axis
    return [-0.05 if v is None else _share(next(left) - low, high - low) for v in values]


def _label(panel: Any, place: int, marks: Sequence[tuple[float, str]]) -> None:
    for height, text in marks[:: -(-len(marks) // MAX_TICK_LABELS)]:
        panel.text(
            place + 0.03,
            height,
            text.replace("$", r"\$"),
            fontsize=8,
            va="center",
            bbox={"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 1},
            zorder=5,
        )


def _share(part: float, whole: float) -> float:
    return part / whole if whole else 0.5


def _save(figure: Figure, path: Path) -> None:
    FigureCanvasAgg(figure)
    figure.savefig(path, dpi=120)
