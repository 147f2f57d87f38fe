"""Evaluations as a table for a terminal."""

from collections.abc import Sequence

from rich.table import Table

from ai4u_edu.learn.training.evaluating import Evaluation


def table(evaluations: Sequence[Evaluation]) -> Table:
    """Return a table with a row for each evaluation, at least one."""
    told = Table(box=None, pad_edge=False)
    who, *others = evaluations[0].cells
    told.add_column(who, overflow="fold")
    for heading in others:
        told.add_column(heading, justify="right")
    for each in evaluations:
        told.add_row(*each.cells.values())
    return told
