"""The agent: a body, its blocks, its brain, its events and its rewards."""

from ai4u_edu.agent.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.events import EVENTS, Event
from ai4u_edu.agent.ledger import Ledger, LedgerEntry

__all__ = ["EVENTS", "BasicAgent", "ControlRequestor", "Event", "Ledger", "LedgerEntry"]
