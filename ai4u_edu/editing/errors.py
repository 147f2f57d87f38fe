"""What can't be changed so, parameter by parameter."""

from collections.abc import Sequence

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.parameters import Problem, listed


class ChangeError(SetupError):
    """A change that can't be made; all stays as it was.

    Args:
        problems: what is wrong, each with the path of the parameter that it is about, as seen from
            the block or the body that was to be changed; () for the whole of it.
    """

    def __init__(self, problems: Sequence[Problem]) -> None:
        super().__init__(listed(problems))
        self.problems = tuple(problems)
