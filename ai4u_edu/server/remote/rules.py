"""What holds for all scripts of a room."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Rules:
    """How long a room waits for its scripts, and what they have to know."""

    grace: float = 3.0
    """Seconds that a seat is kept for a script whose connection is lost."""
    receive_timeout: int = 2000
    """Milliseconds for which a world in lockstep waits for an action."""
    token: str = ""
    """What a script, and a page, has to say to be let in; empty for nothing."""
    seeded_resets: bool = False
    """Whether the script of one of several agents may begin a new episode for all of them."""
