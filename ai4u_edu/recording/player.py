"""A world in which recorded actions are taken again, by the same decision cycle."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, cast

from ai4u_edu.agent.block_errors import may_be_kept, sentence_of
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Answer, Brain, Command, Percept
from ai4u_edu.recording.episode import REPEAT, Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.scene_export import export_scene, without_brains, without_unknown_brains
from ai4u_edu.scenes.description import make_agents
from ai4u_edu.scenes.serialization import PlainDataError, from_plain
from ai4u_edu.world import World


class RecordedBrain(Brain):
    """Decides what was decided, when it was decided."""

    abstract = True  # nothing for a scene file: a player puts the actions in

    def play(self, player: "Player", index: int) -> None:
        """Says whose recording it is."""
        self._player, self._index = player, index

    def decide(self, percept: Percept) -> Answer:  # noqa: ARG002 - it needs to sense nothing
        """What was decided at this tick, in the rhythm it was decided in."""
        return self._player.answer(self._index, self)

    def title(self) -> str:
        """What a person calls it."""
        return "Recording"


class Player:
    """Lets an episode happen again, from its beginning.

    Args:
        episode: which.
        sim: a world to play it in, as it was recorded; left out, a new one is made.
        on_step: called before each step; what it raises ends the playing.

    Raises:
        RecordingError: the episode's scene can't be made, or the world is another one.
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
        self._hurries = len(episode.agents) == 1 and not episode.restarts
        self._own = sim is None
        self._before: list[Brain] = []
        for index, (agent, brain) in enumerate(zip(self.sim.agents, self.brains, strict=True)):
            brain.play(self, index)
            self._before.append(agent.bound_blocks.brain)
            agent.bound_blocks.brain = brain
        self.rewind()

    @property
    def over(self) -> bool:
        """Whether all that was recorded has happened."""
        ticks = self.sim.world.ticks
        return ticks > self.episode.ticks or (
            ticks == self.episode.ticks and not self._restart_is_due()
        )

    def rewind(self) -> None:
        """Back to the beginning."""
        self.taken = [0] * len(self.episode.agents)
        """How many decisions of each agent were taken again."""
        self.restarted = 0
        """How many of the recorded restarts happened again."""
        self._guard(partial(self.sim.reset, self.episode.seed))

    def go_on(self, *, tick_by_tick: bool = False) -> None:
        """One thing more happens: a restart, or a tick, or (where that is the same) a decision."""
        if self._on_step is not None:
            self._on_step()
        self._guard(partial(self._happen, tick_by_tick=tick_by_tick))

    def _happen(self, *, tick_by_tick: bool) -> None:
        if self._restart_is_due():
            self._restart()
            return
        if self._hurries and not tick_by_tick:
            self.sim.step()
            return
        before = list(self.taken)
        self.sim.tick()
        if self.sim.waiting_for_brain and self.taken == before:
            self._restart()  # who should have decided before it never will: it went otherwise

    def go_to(self, index: int, step: int) -> None:
        """To the moment at which an agent took a decision, before it did.

        Args:
            index: the agent's number.
            step: the decision's number.
        """
        tick = int(self.episode.agents[index].begin[step])
        place = self.episode.places[index][step]
        restarts = int((self.episode.restart_places < place).sum())
        if self.sim.world.ticks > tick or self.restarted > restarts or self.taken[index] > step:
            self.rewind()
        while self.sim.world.ticks < tick or self.restarted < restarts:
            self.go_on()

    def hand_over(self, brains: Mapping[str, Brain]) -> ControlRequestor:
        """Gives the agents other brains; a decision that is under way is carried out first.

        Args:
            brains: by the agent's id. Who is not named gets, in a world of the player's own, the
                brain that the scene says, and else the one that it had.
        """
        for index, agent in enumerate(self.sim.agents):
            before = agent.bound_blocks.brain = self._before[index]
            if agent.id in brains:
                agent.use_brain(brains[agent.id])
            elif self._own:
                agent.use_brain(self._brain_of_the_scene(index))
            else:
                before.on_reset(agent, agent.view)
        return self.sim

    def answer(self, index: int, brain: RecordedBrain) -> Answer:
        """What an agent does at this tick."""
        record, ticks = self.episode.agents[index], self.sim.world.ticks
        step = self.taken[index]
        places = self.episode.restart_places
        ahead = int(places[self.restarted]) if self.restarted < len(places) else None
        due = step < len(record) and record.begin[step] == ticks
        if due and (ahead is None or self.episode.places[index][step] < ahead):
            self.taken[index] += 1
            brain.skip_frame = int(record.skip[step])
            brain.repeat_action = bool(record.flags[step] & REPEAT)
            return record.actions[step]
        if ahead is not None and self.episode.restarts[self.restarted].tick == ticks:
            return Command.HOLD
        return Command.WAIT

    def _guard(self, happen: Callable[[], None]) -> None:
        """Let something happen; a block may raise anything, and who plays again catches our errors.

        Raises:
            RecordingError: a block failed.
        """
        try:
            happen()
        except BaseException as error:
            if isinstance(error, AI4UError) or not may_be_kept(error):
                raise
            told = f"a block failed: {sentence_of(error, self.sim.agents)}"
            raise RecordingError(told) from error

    def _restart_is_due(self) -> bool:
        """Whether it is time, and all that was decided before was decided."""
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
                    raise RecordingError(f"the episode's scene: {error}") from None
        agent = self.episode.agents[index].id
        raise RecordingError(
            f"agent {agent!r} was driven by what no file can hold, such as a Python function; "
            f"expected a brain for it, as in brains={{{agent!r}: LocalBrain(...)}}"
        )


def _new_world(episode: Episode, brains: list[RecordedBrain]) -> ControlRequestor:
    scene = episode.scene
    bare: list[dict[str, Any]] = [
        {name: value for name, value in agent.items() if name != "brains"} for agent in scene.agents
    ]
    try:
        world = World(seed=episode.seed, **dict(scene.world))
        world.add_all([*scene.floors, *scene.areas, *scene.bodies])
        agents = make_agents(scene.model_copy(update={"agents": tuple(bare)}))
        for agent, brain in zip(agents, brains, strict=True):
            agent.brains = [brain]
        return ControlRequestor(
            world,
            agents,
            default_time_scale=scene.time_scale,
            goal=scene.goal,
            success=scene.success or "",
            spread_decisions=scene.spread_decisions,
        )
    except AI4UError as error:
        raise RecordingError(f"the episode's scene can't be made: {error}") from None


def _same(sim: ControlRequestor, episode: Episode) -> ControlRequestor:
    if without_brains(export_scene(sim)) != without_brains(episode.scene):
        raise RecordingError(
            "the episode was recorded in another world, or with other blocks; expected a sim of "
            "its own scene: Scene(episode.scene).build()"
        )
    return sim
