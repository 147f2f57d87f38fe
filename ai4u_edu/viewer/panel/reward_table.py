"""Rewards by term and decision, as tables and curves for the panel."""

from collections.abc import Sequence
from html import escape

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import Entry
from ai4u_edu.snapshot import AgentState
from ai4u_edu.snapshot.numbers import amount
from ai4u_edu.viewer.panel.html_parts import heading, section, table
from ai4u_edu.viewer.panel.readings import rewards

MAX_PLOTTED_DECISIONS = 240
"""Number of decisions that an agent's history keeps for the page."""
MINUS = "\u2212"
Curves = tuple[npt.NDArray[np.float64], ...]
MAX_LISTED_DECISIONS = 6
"""Most decisions in the table of the latest rewards; those without a reward are left out."""


def reward_table(agent: AgentState) -> str:
    """Return rewards by term, of this decision and episode, and the latest rewarded decisions."""
    paid = [entry for entry in agent.history if any(entry.terms.values())][-MAX_LISTED_DECISIONS:]
    rows = [
        (f"decision {entry.step}", _terms(entry), f"<b>{signed(entry.total)}</b>")
        for entry in reversed(paid)
    ]
    last = heading("Paid last") + table(rows) if rows else ""
    return rewards(agent.reward_terms, agent.episode_terms) + (section(last) if last else "")


def signed(paid: float) -> str:
    """Format a reward with its sign.

    >>> signed(100.0), signed(-0.5), signed(0.0)
    ('+100.00', '\u22120.50', '0.00')
    """
    text = amount(abs(paid))
    return text if not float(text) else ("+" if paid > 0 else MINUS) + text


def curves(history: Sequence[Entry]) -> Curves:
    """Return the plotted columns: decision numbers, rewards, and sums of the episode so far.

    An empty history gives a single point at zero, because a plot needs one.
    """
    if not history:
        return (np.zeros(1), np.zeros(1), np.zeros(1))
    columns = [(entry.step, entry.total, entry.so_far) for entry in history]
    return tuple(np.array(column, np.float64) for column in zip(*columns, strict=True))


def _terms(entry: Entry) -> str:
    return ", ".join(f"{escape(name)} {signed(paid)}" for name, paid in entry.terms.items() if paid)
