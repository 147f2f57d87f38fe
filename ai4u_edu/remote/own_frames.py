"""Short tracebacks for the errors that a script gets."""

from types import TracebackType

from ai4u_edu.base.errors import AI4UError


class OwnFramesHidden:
    """Context manager that removes the client's own frames from an error's traceback.

    The sentence of an error of ours is then right below the user's line, in a terminal and in a
    notebook. It works since Python adds no frame for an exception that a ``with`` statement raises
    again. Other errors keep their frames, since they are mistakes in this package.
    """

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Remove the frames from here to where the error was raised."""
        if isinstance(error, AI4UError):
            error.__traceback__ = None
            error.__suppress_context__ = True


OWN_FRAMES_HIDDEN = OwnFramesHidden()
