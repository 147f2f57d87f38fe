"""Plots with matplotlib in the worlds' colours; lines differ by more than colour."""

import io
import math
from collections.abc import Mapping, Sequence

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.base.optional_deps import need
from ai4u_edu.lessons.notebook_output import image, put
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate

COLOURS = ("blue", "orange", "green", "vermillion", "purple", "sky blue", "black")
STYLES = ("-", "--", "-.", ":")
MARKERS = "osD^v<>"
MAX_MARKED_POINTS = 30
"""Number of points up to which each gets a marker."""


def plot(
    lines: Mapping[str, Sequence[float]],
    x: Sequence[float] | None = None,
    *,
    xlabel: str = "",
    ylabel: str = "",
    title: str = "",
) -> None:
    """Draw lines, one for each name.

    Args:
        lines: the values by the line's name.
        x: x values; default: 0, 1, 2 and so on.
        xlabel: name and unit of x.
        ylabel: name and unit of the values.
        title: the title above it.

    Raises:
        SetupError: matplotlib is not installed.
    """
    need("lessons", "matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 3.2), layout="constrained")
    panel = figure.subplots()
    for index, (name, heights) in enumerate(lines.items()):
        along = range(len(heights)) if x is None else x
        panel.plot(
            along,
            heights,
            STYLES[index % len(STYLES)],
            color=PALETTE[COLOURS[index % len(COLOURS)]],
            marker=MARKERS[index % len(MARKERS)] if len(heights) <= MAX_MARKED_POINTS else "",
            label=name.replace("$", r"\$"),
        )
    panel.set(xlabel=xlabel, ylabel=ylabel, title=title)
    panel.grid(alpha=0.3)
    if len(lines) > 1:
        panel.legend(fontsize="small")
    FigureCanvasAgg(figure)
    out = io.BytesIO()
    figure.savefig(out, dpi=100, format="png")
    put(image(out.getvalue(), title or ylabel), _words(lines, title or ylabel))


def bars(heights: Mapping[str, float], *, ylabel: str = "", title: str = "") -> None:
    """Draw a bar for each name.

    Args:
        heights: values by name.
        ylabel: name and unit of the values.
        title: the title above it.

    Raises:
        SetupError: matplotlib is not installed.
    """
    need("lessons", "matplotlib")
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 0.9 + 0.4 * len(heights)), layout="constrained")
    panel = figure.subplots()
    # a bar without an end has no picture; its number is written
    drawn = [height if math.isfinite(height) else 0.0 for height in heights.values()]
    names = [name.replace("$", r"\$") for name in heights]
    panel.barh(range(len(drawn)), drawn, color=PALETTE["sky blue"], edgecolor="black")
    panel.set_yticks(range(len(drawn)), names)
    for place, (end, height) in enumerate(zip(drawn, heights.values(), strict=True)):
        panel.text(max(end, 0), place, f" {height:.3g}", va="center")
    panel.invert_yaxis()
    panel.margins(x=0.15)
    panel.set(xlabel=ylabel, title=title)
    FigureCanvasAgg(figure)
    out = io.BytesIO()
    figure.savefig(out, dpi=100, format="png")
    put(image(out.getvalue(), title or ylabel), f"{title}: {dict(heights)}")


def _words(lines: Mapping[str, Sequence[float]], title: str) -> str:
    ends = [
        translate(
            _(
                "{name} from {first:.3g} to {last:.3g}",
                name=name,
                first=float(heights[0]),
                last=float(heights[-1]),
            )
        )
        for name, heights in lines.items()
        if len(heights) and math.isfinite(heights[-1])
    ]
    return f"[plot] {title}: {'; '.join(ends)}"
