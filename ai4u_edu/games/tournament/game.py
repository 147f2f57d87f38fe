"""One game: a job's function."""

import base64
import tempfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.agent import ControlRequestor
from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError, BlockError, text_of
from ai4u_edu.blocks import Answer, Brain, Command, Controller, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.block import Block
from ai4u_edu.games.tournament.drivers import driver_for, make
from ai4u_edu.games.tournament.limits import CpuMeter, OverTimeError, memory_limit
from ai4u_edu.games.tournament.sides import Sides, sides_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed, unpacked
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.recording.episode import encode
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene_data import scene_from
from ai4u_edu.world import WorldView

DEFAULT_MAX_DECISIONS = 3_000
"""Decisions after which a game ends in a scene without a limit of its own."""
MAX_REASON_CHARS = 600


class _Result(BaseModel):
    """Form of a game's result; see :func:`game`."""

    model_config = ConfigDict(extra="forbid", strict=True)

    points: list[Annotated[float, Field(allow_inf_nan=False)]]
    goal: list[bool]
    ticks: Annotated[int, Field(ge=0)]
    episode: Annotated[str, Field(pattern=r"^[A-Za-z0-9+/]*={0,2}$")]
    forfeit: int
    reason: str


def result_fault(result: Any, sides: int) -> str:
    """Return what is wrong with data that stands for the result of a game; empty if nothing is.

    Args:
        result: as a journal has it.
        sides: number of the scene's sides.
    """
    try:
        told = _Result.model_validate(result)
    except ValidationError as error:
        return "; ".join(f"{each['loc']}: {each['msg']}" for each in error.errors())
    if len(told.episode) % 4:
        return _("a recording that is no base64")
    if not len(told.points) == len(told.goal) == sides:
        return _("points of {n} sides, and the scene has {sides}", n=len(told.points), sides=sides)
    reason = unpacked(told.reason)
    if not -1 <= told.forfeit < sides or (told.forfeit < 0) != (not reason):
        return _(
            "forfeit {forfeit} for the reason {reason!r}", forfeit=told.forfeit, reason=str(reason)
        )
    return ""


def game(
    scene: Mapping[str, Any], seed: int, entries: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    """Play one game, and return its result and its recording as data.

    Args:
        scene: as :func:`~ai4u_edu.scenes.scene_data.scene_data` made it.
        seed: of the episode.
        entries: an entry for each side of the scene: name and drivers of an
            :class:`~ai4u_edu.games.tournament.entry.Entry`.

    Returns:
        ``points`` of each side (sum of its agents' rewards), ``goal`` (True for a side that
        reached the scene's goal), ``ticks``, the ``episode`` (a file's bytes in base64; empty if
        the game did not begin), and for a side that failed its index as ``forfeit`` (else -1) and
        the ``reason``, :func:`~ai4u_edu.locale.packed`.
    """
    loaded = scene_from(scene)
    sides = sides_of(loaded)
    faults: list[tuple[int, str]] = []
    with ExitStack() as ending:
        folder = Path(ending.enter_context(tempfile.TemporaryDirectory(prefix="ai4u-game-")))
        ending.enter_context(memory_limit())
        sim = loaded.build()
        for index, entry in enumerate(entries):
            try:
                _seat(sim, sides, index, entry, folder, seed, faults, ending)
            except Exception as error:  # whatever is wrong with an entry
                if not isinstance(error, AI4UError | OverTimeError | MemoryError):
                    raise
                faults.append((index, _reason_of(error)))
        episode = None if faults else _played(sim, loaded, seed, faults)
    return _result(episode, sides, loaded.description.success, faults)


def _seat(
    sim: ControlRequestor,
    sides: Sides,
    index: int,
    entry: Mapping[str, Any],
    folder: Path,
    seed: int,
    faults: list[tuple[int, str]],
    ending: ExitStack,
) -> None:
    """Give the agents of a side brains that ask an entry's controllers."""
    networks: list[Any] = []
    meter = CpuMeter(lambda: [each.stop() for each in networks])
    ending.callback(meter.close)
    for name in sides.agents[index]:
        agent = sim.agent(name)
        made = make(driver_for(entry["drivers"], sides, name), sim, sides, agent, folder, seed)
        network = getattr(made.controller, "network", None)
        networks += [] if network is None else [network]
        close = getattr(made.controller, "close", None)
        if close is not None:
            ending.callback(close)
        brain = MatchBrain(skip_frame=made.skip_frame, repeat_action=made.repeat_action)
        brain.attach(
            made.controller, str(entry["name"]), meter, lambda why: faults.append((index, why))
        )
        agent.use_brain(brain)


def _played(
    sim: ControlRequestor, scene: Scene, seed: int, faults: list[tuple[int, str]]
) -> Episode | None:
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(seed)
    limits = [
        (each.max_steps_per_episode or DEFAULT_MAX_DECISIONS) * (each.brain.skip_frame + 1)
        for each in sim.agents
    ]
    last = max(limits)
    try:
        while not faults and sim.world.ticks < last:
            if all(each.done or each.stopped for each in sim.agents) and sim.between_decisions():
                break
            sim.tick()
    except AI4UError as error:  # of the scene's own blocks: nobody's fault
        raise AI4UError(_("the scene failed: {problem}", problem=message_of(error))) from error
    recorder.finish()
    return recorder.episodes[-1] if len(recorder.episodes) else None


def _result(
    episode: Episode | None, sides: Sides, goal: str | None, faults: list[tuple[int, str]]
) -> dict[str, Any]:
    index, reason = faults[0] if faults else (-1, "")
    points, reached = [0.0 for _ in sides.names], [False for _ in sides.names]
    if episode is not None:
        for side, agents in enumerate(sides.agents):
            records = [episode.agent(each) for each in agents]
            points[side] = float(sum(each.total for each in records))
            reached[side] = goal is not None and any(
                decision.reward_terms.get(goal, 0.0) > 0 for each in records for decision in each
            )
    return {
        "points": points,
        "goal": reached,
        "ticks": 0 if episode is None else episode.ticks,
        "episode": "" if episode is None else base64.b64encode(encode(episode)).decode(),
        "forfeit": index,
        "reason": packed(reason),
    }


class MatchBrain(Brain):
    """Asks a controller within limits of processor time; whatever that raises is a fault of it."""

    abstract = True  # not for scene files: a game makes it

    def attach(
        self, controller: Controller, title: str, meter: CpuMeter, blame: Callable[[str], None]
    ) -> None:
        """Set the controller.

        Args:
            controller: is asked for actions.
            title: the entry's name.
            meter: of the entry's processor time.
            blame: called with a sentence when the controller fails.
        """
        self._controller, self._title = controller, title
        self._meter, self._blame = meter, blame
        self._actuators: dict[str, Any] = {}

    def inner_blocks(self) -> Sequence[Block]:
        """Return the controller."""
        return (self._controller,)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Set the controller up."""
        self._actuators = {each.action_name: each for each in agent.actuators}
        self._controller.on_setup(agent, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Reset the controller."""
        try:
            self._controller.on_reset(agent, view)
        except Exception as error:  # it is the entry's
            self._blame(_reason_of(error))

    def decide(self, percept: Percept) -> Answer:
        """Return the controller's checked action; STOP where it fails."""
        if percept["done"]:
            return Command.WAIT
        try:
            with self._meter.measuring():
                self._controller.new_state_event(percept)
                answer = self._controller.get_action(percept)
            if not isinstance(answer, Command):
                return {name: self._accepted(name, each) for name, each in answer.items()}
        except Exception as error:  # it is the entry's
            self._blame(_reason_of(error))
            return Command.STOP
        # no entry restarts a game, or has the other one wait
        return Command.STOP if answer in (Command.STOP, Command.RESTART) else Command.WAIT

    def title(self) -> str:
        """Return the entry's name."""
        return self._title

    def _accepted(self, name: str, numbers: Any) -> tuple[float, ...]:
        if name not in self._actuators:
            raise AI4UError(_("it drives an actuator {name!r}, and there is none", name=name))
        accepted: tuple[float, ...] = self._actuators[name].accept(numbers)
        return accepted


def _reason_of(error: Exception) -> str:
    """Return why an entry failed, as one sentence."""
    if isinstance(error, BlockError) and error.problem:
        whole = error.problem  # without a network's path, in a folder that is gone
    elif isinstance(error, AI4UError | OverTimeError):
        whole = text_of(error)
    else:
        whole = f"{type(error).__name__}: {error}"
    text = " ".join(whole.split())
    if text == whole and len(text) <= MAX_REASON_CHARS:
        return whole  # as it is, it can be translated
    return text if len(text) <= MAX_REASON_CHARS else text[: MAX_REASON_CHARS - 1] + "…"
