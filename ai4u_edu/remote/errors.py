"""Errors that scripts get."""

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.locale import translate


class RemoteError(AI4UError):
    """The base of the errors that a remote robot raises.

    Attributes:
        code: the world's name of the problem, such as ``"agent_taken"``; empty if the error did not
            come from the world.
    """

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code

    def __str__(self) -> str:
        return translate(self.args[0])  # for the terminal of the script


class RefusedError(RemoteError):
    """The world does not give the agent to this script, or does not allow what it asked for."""


class LostError(RemoteError):
    """The world has ended the session, or the connection is lost and reconnecting failed."""
