"""The settings of a room for its scripts."""

import math
from dataclasses import dataclass

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.wire.native import OnMissing

MAX_GRACE_S = 600.0
MIN_RECEIVE_TIMEOUT_MS = 200
MAX_RECEIVE_TIMEOUT_MS = 600_000


@dataclass(frozen=True, slots=True)
class Rules:
    """The settings of a room for its scripts: timeouts, token, permissions.

    Raises:
        SetupError: a number is out of range.

    >>> Rules(grace=-1.0)
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.SetupError: grace: expected a number of seconds from 0 to 600, got -1.0
    """

    grace: float = 3.0
    """Seconds for which a script whose connection is lost keeps its agent."""
    receive_timeout: int = 2000
    """Milliseconds for which a world in lockstep waits for an action; a script that is silent for
    longer is given up until it speaks again."""
    token: str = ""
    """Token that scripts and pages must send; empty: none is needed."""
    seeded_resets: bool = False
    """True allows the script of one of several agents to reset the whole world with a seed."""
    lockstep: bool | None = None
    """True allows scripts to make the world wait for their actions; by default this is allowed only
    if there is a single agent. A program that drives all agents in lockstep needs True."""
    on_missing: OnMissing = ""
    """Substitute for an action that is missing, if a script does not choose; empty: hold
    while its connection is there, stop when it is lost."""
    hello_timeout: float = 10.0
    """Seconds that a connection has to send its hello."""

    def __post_init__(self) -> None:
        if not (math.isfinite(self.grace) and 0 <= self.grace <= MAX_GRACE_S):
            raise SetupError(
                _(
                    "grace: expected a number of seconds from 0 to {most}, got {got}",
                    most=f"{MAX_GRACE_S:g}",
                    got=self.grace,
                )
            )
        if not MIN_RECEIVE_TIMEOUT_MS <= self.receive_timeout <= MAX_RECEIVE_TIMEOUT_MS:
            raise SetupError(
                _(
                    "receive_timeout: expected a number of milliseconds from {least} to {most}, "
                    "got {got}",
                    least=MIN_RECEIVE_TIMEOUT_MS,
                    most=MAX_RECEIVE_TIMEOUT_MS,
                    got=self.receive_timeout,
                )
            )
