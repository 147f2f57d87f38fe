"""The plot of rewards: each decision's reward, and the episode's sum."""

import time
from collections.abc import Callable, Sequence

from viser import GuiApi, uplot

from ai4u_edu.agent import Entry
from ai4u_edu.viewer.panel.reward_table import Curves, curves

MIN_REDRAW_S = 0.4
"""Shortest time (s) between two drawings."""
BLUE, ORANGE = "#2b8cc4", "#d55e00"
"""Line colours, readable on light and dark backgrounds."""
FONT = "11px sans-serif"
NO_GRID = uplot.Axis_Grid(show=False)
INCREMENTS = tuple(
    float(f"{digit}e{power}") for power in range(-3, 16) for digit in ("1", "2", "5")
)
"""Steps between the labels of an axis, none below 0.001: uPlot rounds labels to three decimals, so
finer steps would repeat a label."""


class RewardPlot:
    """The plot in the panel of one page.

    Args:
        gui: the page's GUI.
    """

    def __init__(self, gui: GuiApi) -> None:
        self._drawn_entry: Entry | None = None
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
                    grid=NO_GRID,
                    incrs=INCREMENTS,
                ),
            ),
            height=150,
            padding=(8, 0, 0, 0),
        )

    def draw(self, history: Sequence[Entry], get_curves: Callable[[], Curves]) -> None:
        """Draw the latest decisions, if there are new ones, at most every :data:`MIN_REDRAW_S`.

        Args:
            history: the agent's rewards.
            get_curves: returns the curves of that history.
        """
        last, now = history[-1] if history else None, time.monotonic()
        if last is self._drawn_entry or now - self._drawn_at < MIN_REDRAW_S:
            return
        self._drawn_entry, self._drawn_at = last, now
        self._plot.data = get_curves()
