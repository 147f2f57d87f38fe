"""Error of recorded episodes."""

from ai4u_edu.base.errors import AI4UError


class RecordingError(AI4UError):
    """An episode that can't be read or replayed."""
