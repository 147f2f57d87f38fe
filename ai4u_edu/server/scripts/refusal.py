"""Why a script does not get what it wants."""


class RefusalError(Exception):
    """A script does not get what it wants.

    Attributes:
        code: one of :data:`ai4u_edu.wire.native.PROBLEMS`.
    """

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.code = code


def wrong_version(expected: str, got: object) -> str:
    """What to do about two versions that don't go together."""
    return (
        f"expected {expected}, got {got}; install the ai4u-edu that the world has "
        "(pip install -U ai4u-edu, on both machines)"
    )
