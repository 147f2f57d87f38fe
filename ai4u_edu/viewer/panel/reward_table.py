"""The reward ledger in the panel: which term paid what, at which decision."""

from collections.abc import Sequence
from html import escape

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import Entry
from ai4u_edu.snapshot import AgentState
from ai4u_edu.viewer.panel.bars import amount
from ai4u_edu.viewer.panel.readings import block, heading, rewards, table

REMEMBERED = 240
"""So many decisions are kept for the page."""
MINUS = "\u2212"
Curves = tuple[npt.NDArray[np.float64], ...]
LAST = 6
"""So many of them stand in the table; one in which nothing was paid says nothing."""


def reward_table(agent: AgentState) -> str:
    """This decision and this episode by term, and the latest decisions in which something was."""
    paid = [entry for entry in agent.history if any(entry.terms.values())][-LAST:]
    rows = [
        (f"decision {entry.step}", _terms(entry), f"<b>{signed(entry.total)}</b>")
        for entry in reversed(paid)
    ]
    last = heading("Paid last") + table(rows) if rows else ""
    return rewards(agent.reward_terms, agent.episode_terms) + (block(last) if last else "")


def signed(paid: float) -> str:
    """An amount with its sign.

    >>> signed(100.0), signed(-0.5), signed(0.0)
    ('+100.00', '\u22120.50', '0.00')
    """
    text = amount(abs(paid))
    return text if not float(text) else ("+" if paid > 0 else MINUS) + text


def curves(history: Sequence[Entry]) -> Curves:
    """What is plotted: the decisions' numbers, what each was paid, and the episode's sum so far.

    An empty history is a single point at zero, since a plot needs one.
    """
    if not history:
        return (np.zeros(1), np.zeros(1), np.zeros(1))
    columns = [(entry.step, entry.total, entry.so_far) for entry in history]
    return tuple(np.array(column, np.float64) for column in zip(*columns, strict=True))


def _terms(entry: Entry) -> str:
    return ", ".join(f"{escape(name)} {signed(paid)}" for name, paid in entry.terms.items() if paid)
