"""Player of an episode: a world in which the recorded actions are taken again."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import cast

from ai4u_edu.agent.block_errors import may_be_kept, sentence_of
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Answer, Brain, Command, Percept
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.agent_record import DONE_REQUESTED, REPEAT
from ai4u_edu.recording.episode import Episode, Input
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.scene_export import export_scene, without_brains, without_unknown_brains
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import PlainDataError, from_plain


class RecordedBrain(Brain):
    """Takes the recorded decisions at their recorded ticks."""

    abstract = True  # not for scene files: a player sets the actions

    def attach(self, player: "Player", index: int) -> None:
        """Set the player, and the index of the agent, whose decisions to take."""
        self._player, self._index = player, index

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - it needs to sense nothing
        """Return the recorded answer for this tick."""
        return self._player.answer(self._index, self)

    def title(self) -> str:
        """Return the title to show to a person."""
        return "Recording"


class Player:
    """Replays an episode step by step, from its beginning.

    Args:
        episode: the recorded episode.
        sim: a world of the episode's scene to use; by default a new one is made.
        on_step: called before each step; an exception that it raises ends the replay.

    Raises:
        RecordingError: the episode's scene can't be built, or the world has another one.
    """

    def __init__(
        self,
        episode: Episode,
        sim: ControlRequestor | None = None,
        *,
        on_step: Callable[[], object] | None = None,
    ) -> None:
        self.episode = episode
        self._on_step = on_step
        self.brains = [RecordedBrain() for _ in episode.agents]
        self.sim = _new_world(episode, self.brains) if sim is None else _same(sim, episode)
        self._can_skip_ticks = len(episode.agents) == 1 and not episode.restarts
        self._owns_sim = sim is None
        self._before: list[Brain] = []
        for index, (agent, brain) in enumerate(zip(self.sim.agents, self.brains, strict=True)):
            brain.attach(self, index)
            self._before.append(agent.bound_blocks.brain)
            agent.bound_blocks.brain = brain
        self.rewind()

    @property
    def is_over(self) -> bool:
        """True if the whole episode has been replayed."""
        ticks = self.sim.world.ticks
        return ticks > self.episode.ticks or (
            ticks == self.episode.ticks and not self._restart_is_due()
        )

    def rewind(self) -> None:
        """Go back to the beginning."""
        self.taken = [0] * len(self.episode.agents)
        """Number of replayed decisions of each agent."""
        self.restarted = 0
        """Number of replayed restarts."""
        self._set_inputs(self.episode.inputs)
        for agent in self.sim.agents:
            for sensor in agent.bound_blocks.array_sensors():
                sensor.numbers[:] = 0.0
        self._guard(partial(self.sim.reset, self.episode.seed))

    def advance(self, *, tick_by_tick: bool = False) -> None:
        """Replay one restart or one tick; of a single agent one decision, unless tick by tick."""
        if self._on_step is not None:
            self._on_step()
        self._guard(partial(self._advance, tick_by_tick=tick_by_tick))

    def _advance(self, *, tick_by_tick: bool) -> None:
        if self._restart_is_due():
            self._restart()
            return
        if self._can_skip_ticks and not tick_by_tick:
            self.sim.step()
            return
        before = list(self.taken)
        self.sim.tick()
        if self.sim.waiting_for_brain and self.taken == before:
            self._restart()  # the replay differs: a decision before the restart will never come

    def seek(self, index: int, step: int) -> None:
        """Go to the moment just before an agent took a decision.

        Args:
            index: of the agent.
            step: index of the decision.
        """
        tick = int(self.episode.agents[index].begin[step])
        place = self.episode.places[index][step]
        restarts = int((self.episode.restart_places < place).sum())
        if self.sim.world.ticks > tick or self.restarted > restarts or self.taken[index] > step:
            self.rewind()
        while self.sim.world.ticks < tick or self.restarted < restarts:
            self.advance()

    def replace_brains(self, brains: Mapping[str, Brain]) -> ControlRequestor:
        """Give the agents other brains, and return the world; a begun decision is finished first.

        Args:
            brains: brains by agent id. Other agents get a new brain as in the scene if the player
                made the world, and otherwise the brain that they had before.
        """
        self._set_inputs(())
        for index, agent in enumerate(self.sim.agents):
            before = agent.bound_blocks.brain = self._before[index]
            if agent.id in brains:
                agent.use_brain(brains[agent.id])
            elif self._owns_sim:
                agent.use_brain(self._brain_of_the_scene(index))
            else:
                before.on_reset(agent, agent.view)
        return self.sim

    def answer(self, index: int, brain: RecordedBrain) -> Answer:
        """Return an agent's answer for this tick."""
        record, ticks = self.episode.agents[index], self.sim.world.ticks
        step = self.taken[index]
        places = self.episode.restart_places
        ahead = int(places[self.restarted]) if self.restarted < len(places) else None
        due = step < len(record) and record.begin[step] == ticks
        if due and (ahead is None or self.episode.places[index][step] < ahead):
            self.taken[index] += 1
            agent = self.sim.agents[index]
            agent.ledger.carried = record.carried_into(step)
            if record.flags[step] & DONE_REQUESTED:
                agent.request_done()
            brain.skip_frame = int(record.skip[step])
            brain.repeat_action = bool(record.flags[step] & REPEAT)
            return record.actions[step]
        if ahead is not None and self.episode.restarts[self.restarted].tick == ticks:
            return Command.HOLD
        return Command.WAIT

    def _set_inputs(self, inputs: Sequence[Input]) -> None:
        """Let the sensors that a script sets read what it set then, and nothing else."""
        scripts: dict[tuple[int, str], dict[int, list[tuple[float, ...]]]] = {}
        for given in inputs:
            script = scripts.setdefault((given.agent, given.name), {})
            script.setdefault(given.moment, []).append(given.values)
        for index, agent in enumerate(self.sim.agents):
            for sensor in agent.bound_blocks.array_sensors():
                sensor.script = scripts.get((index, sensor.perception_key), {})

    def _guard(self, step: Callable[[], None]) -> None:
        """Run a step, and turn errors of blocks into a RecordingError.

        Raises:
            RecordingError: a block failed.
        """
        try:
            step()
        except BaseException as error:
            if isinstance(error, AI4UError) or not may_be_kept(error):
                raise
            told = _("a block failed: {error}", error=sentence_of(error, self.sim.agents))
            raise RecordingError(told) from error

    def _restart_is_due(self) -> bool:
        """Return True if the next restart is due, and all decisions before it were replayed."""
        if self.restarted == len(self.episode.restarts):
            return False
        if self.episode.restarts[self.restarted].tick != self.sim.world.ticks:
            return False
        place = self.episode.restart_places[self.restarted]
        return all(
            taken == len(places) or places[taken] > place
            for taken, places in zip(self.taken, self.episode.places, strict=True)
        )

    def _restart(self) -> None:
        group = self.episode.restarts[self.restarted].agents
        self.restarted += 1
        self.sim.restart(*(self.sim.agents[index] for index in group))

    def _brain_of_the_scene(self, index: int) -> Brain:
        scene = without_unknown_brains(self.episode.scene)
        for path, data in enumerate(scene.agents[index].get("brains", ())):
            if data.get("enabled", True):
                try:
                    return cast(Brain, from_plain(Brain, data, ("agents", index, "brains", path)))
                except PlainDataError as error:
                    raise RecordingError(
                        _("the episode's scene: {error}", error=text_of(error))
                    ) from None
        agent = self.episode.agents[index].id
        raise RecordingError(
            _(
                "agent {agent} was driven by what no file can hold, such as a Python function; "
                "expected a brain for it, as in brains={{{agent}: LocalBrain(...)}}",
                agent=repr(agent),
            )
        )


def _new_world(episode: Episode, brains: list[RecordedBrain]) -> ControlRequestor:
    """Build an episode's world; the scene's brains may be of types that are not defined here."""
    agents = [{k: v for k, v in each.items() if k != "brains"} for each in episode.scene.agents]
    scene = Scene(episode.scene.model_copy(update={"agents": tuple(agents)}))
    by_id = dict(zip(episode.ids, brains, strict=True))
    try:
        return scene.build(episode.seed, brains=lambda agent: by_id[agent.id])
    except AI4UError as error:
        raise RecordingError(
            _("the episode's scene can't be made: {error}", error=text_of(error))
        ) from None


def _same(sim: ControlRequestor, episode: Episode) -> ControlRequestor:
    if without_brains(export_scene(sim)) != without_brains(episode.scene):
        raise RecordingError(
            _(
                "the episode was recorded in another world, or with other blocks; expected a sim "
                "of its own scene: Scene(episode.scene).build()"
            )
        )
    return sim
