"""Errors of joining a class from a program."""

from ai4u_edu.base.errors import AI4UError


class NotJoinedError(AI4UError):
    """A class gives no seat, or can't be asked; the message is for the person who wants to join."""


class UnreachableError(NotJoinedError):
    """Nobody answers at the class's address; the same attempt may succeed later."""
