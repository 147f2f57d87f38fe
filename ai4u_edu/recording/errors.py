"""What can go wrong with a recorded episode."""

from ai4u_edu.base.errors import AI4UError


class RecordingError(AI4UError):
    """A recorded episode can't be read, or can't be played again."""
