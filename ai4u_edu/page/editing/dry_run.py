"""Dry run of a state in a new world, before anything in the running world is changed."""

from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, WorldError, text_of
from ai4u_edu.base.parameters import ParameterProblem, format_path
from ai4u_edu.blocks import Answer, Brain, Command, Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.plain import BlockPath
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene import field_named_in
from ai4u_edu.scenes.serialization import PlainDataError


class IdleBrain(Brain):
    """A brain that does nothing, so that a dry run opens no socket and loads no network."""

    abstract = True

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - it needs to sense nothing
        """Wait."""
        return Command.WAIT


def dry_run(state: EditState, path: BlockPath = (), *, resets: int = 1) -> ControlRequestor:
    """Build a state's world with idle brains, reset it, and let its agents sense once.

    Args:
        state: the state to try.
        path: of the part that was changed; paths of problems are relative to it.
        resets: number of resets to try if the scene is randomized.

    Raises:
        ChangeError: something in it does not fit.
    """
    description = state.description
    try:
        sim = Scene(description, state.folder).build(brains=lambda _: IdleBrain())
        for seed in range(resets if any(each.random for each in description.things) else 1):
            sim.reset(seed)
    except PlainDataError as error:
        raise ChangeError([relative_to(path, each) for each in error.problems]) from None
    except WorldError as error:
        text = _("where all begin, {problem}", problem=text_of(error))
        problem = ParameterProblem(description.where_is(error.thing), text)
        raise ChangeError([relative_to(path, problem)]) from None
    except AI4UError as error:
        changed = _at(description.agents, path[1:]) if path else None
        field = field_named_in(text_of(error), changed)
        raise ChangeError([ParameterProblem(field, text_of(error))]) from None
    except (ArithmeticError, MemoryError) as error:
        text = _(
            "it can't be set up: {error}: {problem}",
            error=type(error).__name__,
            problem=str(error),
        )
        raise ChangeError([ParameterProblem((), text)]) from error
    return sim


def relative_to(path: BlockPath, problem: ParameterProblem) -> ParameterProblem:
    """Return a problem with a relative path; one that lies elsewhere has its path in its text."""
    if problem.path[: len(path)] == path:
        return ParameterProblem(problem.path[len(path) :], problem.text)
    place = format_path(problem.path)
    return ParameterProblem(
        (), _("{place}: {problem}", place=place, problem=problem.text) if place else problem.text
    )


def _at(data: Any, path: BlockPath) -> Any:
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            return None
    return data
