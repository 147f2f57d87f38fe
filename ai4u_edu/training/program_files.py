"""Python files that drive an agent as they do in the page."""

import tokenize
from pathlib import Path

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import BlockError, SetupError
from ai4u_edu.blocks import Controller, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Action
from ai4u_edu.program import Program, ProgramError, obstacle_in
from ai4u_edu.world import WorldView

CALL_LIMIT_S = 5.0
"""Longest time that a program outside the page may take for a decision, and for loading."""


class ProgramController(Controller):
    """Asks a program for its decisions, as the page does.

    It gets plain Python numbers as readings, and the numbers of its actions are rounded to nine
    digits; so it decides here as there.
    """

    program: Program
    """The program, loaded."""

    abstract = True  # a scene file can't name it

    def on_reset(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002  # a hook's form
        """Begin an episode of the program."""
        try:
            self.program.begin()
        except ProgramError as error:
            raise BlockError(self._told(error)) from error

    def get_action(self, percept: Percept) -> Action:
        """Return the program's action.

        Raises:
            BlockError: a mistake in the program, with its line.
        """
        try:
            return self.program.decide(percept)
        except ProgramError as error:
            raise BlockError(self._told(error)) from error

    def _told(self, error: ProgramError) -> str:
        return mistake_text(Path(self.program.file), error)


def program_text(path: Path) -> str | None:
    """Return the text of a file that could run in the page; None for one that could not.

    The others import numpy, another package or blocks of ai4u_edu, or have a Controller that looks
    at its agent or its world.

    Raises:
        SetupError: the file can't be read.
    """
    try:
        with tokenize.open(path) as file:
            source = file.read()
    except (OSError, SyntaxError, ValueError) as error:
        raise SetupError(f"{path}: expected a text of Python in UTF-8: {error}") from error
    return None if obstacle_in(source) else source


def load_program(source: str, path: Path, entry: str, agent: BasicAgent | None = None) -> Program:
    """Load a program from a file's text.

    Args:
        source: the text.
        path: of the file, for messages.
        entry: name of a function, a class with ``get_action`` or such an object.
        agent: its actuators are checked; None for none.

    Raises:
        SetupError: a mistake in the program, with its line.
    """
    outputs = None
    if agent is not None:
        actuators = agent.bound_blocks.actuators
        outputs = {name: each.limits() for name, each in actuators.items()}
    try:
        return Program.load(
            source, str(path), entry, outputs, limit_s=CALL_LIMIT_S, keeps_lines=False
        )
    except ProgramError as error:
        raise SetupError(mistake_text(path, error)) from error


def program_controller(source: str, path: Path, entry: str, agent: BasicAgent) -> ProgramController:
    """Return a controller that asks a program that was loaded anew for this agent."""
    return ProgramController(program=load_program(source, path, entry, agent))


def mistake_text(path: Path, error: ProgramError) -> str:
    """Return the sentence on a mistake with its file and line."""
    if not error.line:
        return error.text if error.text.startswith(str(path)) else f"{path}: {error.text}"
    return f"{path}, line {error.line}: {error.text}"
