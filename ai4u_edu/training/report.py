"""Evaluations as a table for a terminal."""

from collections.abc import Sequence

import numpy as np
from rich.table import Table

from ai4u_edu.training.evaluate import Evaluation


def table(evaluations: Sequence[Evaluation]) -> Table:
    """A row for each evaluation."""
    told = Table(box=None, pad_edge=False)
    told.add_column("who", overflow="fold")
    for heading in ("success", "95% between", "return", "length"):
        told.add_column(heading, justify="right")
    for each in evaluations:
        told.add_row(each.name, *row(each))
    return told


def row(each: Evaluation) -> tuple[str, str, str, str]:
    """Success, its interval, return and length, as text."""
    interval = each.interval
    return (
        "-" if each.success is None else f"{each.success:.0%}",
        "-" if interval is None else f"{100 * interval[0]:.1f} and {100 * interval[1]:.1f}%",
        f"{np.mean(each.rewards):.2f} ± {np.std(each.rewards):.2f}",
        f"{np.mean(each.lengths):.1f} ± {np.std(each.lengths):.1f}",
    )
