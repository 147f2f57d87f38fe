"""Errors of a class, each with a sentence for the person in front of it."""

from ai4u_edu.base.errors import AI4UError


class JoinError(AI4UError):
    """A person can't join; the message is for that person."""


class WrongCodeError(JoinError):
    """The code is not the class's."""


class NewSeatError(JoinError):
    """A new seat would be needed, and the caller has to ask for it."""


class NameTakenError(JoinError):
    """Another seat has that name."""


class RoomError(AI4UError):
    """A room can't be entered now."""


class StoreError(AI4UError):
    """The class's file can't be written to; nothing of the change is kept."""


class ProgramNotKeptError(AI4UError):
    """A program is not kept; the message is for the student."""


class NewerProgramError(ProgramNotKeptError):
    """A newer program is kept already."""


class NetworkError(AI4UError):
    """A network can't be taken; the message is for the student."""


class CommandError(AI4UError):
    """A teacher's command can't be done; the message is for the teacher."""
