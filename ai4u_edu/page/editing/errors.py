"""Error of a change that can't be made."""

from collections.abc import Sequence

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.parameters import ParameterProblem, format_problems


class ChangeError(SetupError):
    """A change that can't be made; nothing was changed.

    Args:
        problems: what is wrong, each with the path of its parameter relative to the block or body
            that was to be changed; () for the block or body itself.
    """

    def __init__(self, problems: Sequence[ParameterProblem]) -> None:
        super().__init__(format_problems(problems))
        self.problems = tuple(problems)
