"""Error of explanations."""

from ai4u_edu.base.errors import AI4UError


class NotExplainableError(AI4UError):
    """A decision does not follow from the percept alone, or gives no action to compare."""
