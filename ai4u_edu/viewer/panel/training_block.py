"""Block of the panel that shows a training: decisions so far and the learning curve."""

import numpy as np
from viser import uplot

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.viewer.panel.plot import BLUE, FONT, NO_GRID, ORANGE
from ai4u_edu.viewer.panel.reward_table import Curves


class TrainingBlock:
    """The progress of a runner's training; the same on all pages.

    Args:
        server: viser's server.
        runner: whose training is shown; it has one.
        progress: its present state.
    """

    def __init__(self, server: LocalServer, runner: Runner, progress: TrainingProgress) -> None:
        self._runner, self._drawn = runner, progress
        self._status = server.gui.add_html(_status(progress))
        series = [
            uplot.Series(label="decisions"),
            uplot.Series(label="reward", stroke=BLUE, width=2, scale="reward"),
        ]
        axes = [
            uplot.Axis(size=30, font=FONT),
            uplot.Axis(scale="reward", size=46, stroke=BLUE, font=FONT),
        ]
        scales = {"x": uplot.Scale(time=False), "reward": uplot.Scale()}
        self._has_goal = bool(runner.sim.success)
        if self._has_goal:
            series.append(uplot.Series(label="success %", stroke=ORANGE, width=2, scale="share"))
            axes.append(
                uplot.Axis(scale="share", size=46, side=1, stroke=ORANGE, font=FONT, grid=NO_GRID)
            )
            scales["share"] = uplot.Scale(range=(0, 100))
        self._plot = server.gui.add_uplot(
            self._curves(progress),
            tuple(series),
            scales=scales,
            axes=tuple(axes),
            height=110,
            padding=(8, 0, 0, 0),
        )

    def build(self, _static_scene: StaticScene) -> None:
        """Do nothing; a training has one scene."""

    def draw(self, _snapshot: Snapshot) -> None:
        """Show the present progress."""
        progress = self._runner.training
        if progress is None or progress is self._drawn:
            return
        if progress.curve != self._drawn.curve:
            self._plot.data = self._curves(progress)
        self._drawn = progress
        self._status.content = _status(progress)

    def _curves(self, progress: TrainingProgress) -> Curves:
        """Return decisions, mean reward, and success in percent where the scene has a goal.

        A training without an evaluation yet gives a single point at zero.
        """
        curve = progress.curve
        columns = [[float(each.decisions) for each in curve], [each.reward for each in curve]]
        if self._has_goal:
            columns.append([100 * (each.success or 0.0) for each in curve])
        return tuple(np.array(column or [0.0]) for column in columns)


def _status(progress: TrainingProgress) -> str:
    decisions = f"{progress.decisions:,}"
    if progress.is_over:
        text = f"Training is over after {decisions} decisions. The best policy drives now."
    else:
        text = f"Training: {decisions} of at most {progress.total:,} decisions."
    return section(text)
