"""What can go wrong on a script's side of the line."""

from ai4u_edu.base.errors import AI4UError


class RemoteError(AI4UError):
    """The root of what a remote robot raises.

    Attributes:
        code: the world's word for it, such as ``"agent_taken"``; empty where it is not the world
            that complains.
    """

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code


class RefusedError(RemoteError):
    """The world does not give the agent to this script, or does not let it do this."""


class LostError(RemoteError):
    """The connection is lost, or the world has ended it, and it could not be taken up again."""
