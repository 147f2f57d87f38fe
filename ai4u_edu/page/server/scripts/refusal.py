"""Reasons for which a script is refused."""


class RefusalError(Exception):
    """A script does not get the agent that it asked for.

    Attributes:
        code: one of :data:`ai4u_edu.wire.native.PROBLEMS`.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


def wrong_version(expected: str, got: object) -> str:
    """Return the text for a script whose version of the protocol is another one."""
    return (
        f"expected {expected}, got {got}; install the ai4u-edu that the world has "
        "(pip install -U ai4u-edu, on both machines)"
    )
