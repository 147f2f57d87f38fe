"""The reward as curves: what each decision was paid, and the episode's sum."""

import time
from collections.abc import Callable, Sequence

from viser import GuiApi, uplot

from ai4u_edu.agent import Entry
from ai4u_edu.viewer.panel.reward_table import Curves, curves

PERIOD = 0.4
"""Seconds between two pictures at least."""
BLUE, ORANGE = "#2b8cc4", "#d55e00"
"""Both can be told from a light and from a dark ground."""
FONT = "11px sans-serif"
NONE = uplot.Axis_Grid(show=False)
INCREMENTS = tuple(
    float(f"{digit}e{power}") for power in range(-3, 16) for digit in ("1", "2", "5")
)
"""Steps between two numbers of an axis: uPlot rounds them to three digits after the point, so finer
ones would print the same number twice."""


class RewardPlot:
    """A plot in the panel of one page.

    Args:
        gui: the page's.
    """

    def __init__(self, gui: GuiApi) -> None:
        self._drawn: Entry | None = None
        self._drawn_at = 0.0
        self._plot = gui.add_uplot(
            curves(()),
            (
                uplot.Series(label="decision"),
                uplot.Series(label="paid", stroke=BLUE, width=1.5, scale="paid"),
                uplot.Series(label="episode", stroke=ORANGE, width=2, dash=(6, 3), scale="sum"),
            ),
            scales={"x": uplot.Scale(time=False), "paid": uplot.Scale(), "sum": uplot.Scale()},
            axes=(
                uplot.Axis(size=30, font=FONT),
                uplot.Axis(scale="paid", size=46, stroke=BLUE, font=FONT, incrs=INCREMENTS),
                uplot.Axis(
                    scale="sum",
                    size=46,
                    side=1,
                    stroke=ORANGE,
                    font=FONT,
                    grid=NONE,
                    incrs=INCREMENTS,
                ),
            ),
            height=150,
            padding=(8, 0, 0, 0),
        )

    def draw(self, history: Sequence[Entry], drawn: Callable[[], Curves]) -> None:
        """Draws the latest decisions, if there are others than before and it is time again.

        Args:
            history: of the agent.
            drawn: gives its curves.
        """
        last, now = history[-1] if history else None, time.monotonic()
        if last is self._drawn or now - self._drawn_at < PERIOD:
            return
        self._drawn, self._drawn_at = last, now
        self._plot.data = drawn()
