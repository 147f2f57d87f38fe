"""Whether a scene can be, found out on a copy before anything in the running world is touched."""

from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, WorldError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.blocks import Answer, Brain, Command, Percept
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.state import EditState
from ai4u_edu.scenes.description import check_success, make_agents
from ai4u_edu.scenes.scene import EPISODES
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.scenes.setup_errors import field_named_in
from ai4u_edu.world import World

Path = tuple[str | int, ...]


class _Nobody(Brain):
    """Drives nowhere, so that no socket is opened and no network loaded for a trial."""

    abstract = True

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - it needs to sense nothing
        """Nothing."""
        return Command.WAIT


def tried(state: EditState, where: Path = (), *, episodes: int = 1) -> ControlRequestor:
    """Builds a scene, with brains that do nothing, and lets its agents sense once.

    Args:
        state: what is to be.
        where: the path of what was changed; problems are told as seen from there.
        episodes: of a scene in which chance has a say, so many are set up.

    Raises:
        ChangeError: something in it does not fit.
    """
    description = state.description
    try:
        world = World(**dict(description.world))
        world.add_all(description.things)
        with files_in(state.folder):
            agents = make_agents(description)
        for agent in agents:
            agent.brains = [_Nobody()]
        check_success(description.success, agents)
        sim = ControlRequestor(world, agents)
        for seed in range(episodes if any(each.random for each in description.things) else 1):
            sim.reset(seed)
    except PlainDataError as error:
        raise ChangeError([seen_from(where, each) for each in error.problems]) from None
    except WorldError as error:
        problem = Problem(description.where_is(error.thing), f"where all begin, {error}")
        raise ChangeError([seen_from(where, problem)]) from None
    except AI4UError as error:
        path = field_named_in(str(error), _at(description.agents, where[1:]) if where else None)
        raise ChangeError([Problem(path, str(error))]) from None
    except (ArithmeticError, MemoryError) as error:
        text = f"it can't be set up: {type(error).__name__}: {error}"
        raise ChangeError([Problem((), text)]) from error
    return sim


def seen_from(where: Path, problem: Problem) -> Problem:
    """A problem with its path as seen from a place in the scene; what lies elsewhere says where."""
    if problem.path[: len(where)] == where:
        return Problem(problem.path[len(where) :], problem.text)
    return Problem((), str(problem))


def _at(data: Any, path: Path) -> Any:
    for part in path:
        try:
            data = data[part]
        except (KeyError, IndexError, TypeError):
            return None
    return data


THOROUGHLY = EPISODES
"""So many episodes are set up where places were changed."""
