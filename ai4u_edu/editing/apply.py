"""Brings a running world from what it is to what a person wants it to be."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, cast

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.rebind import Blocks, rebind, sense_again
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Actuator, Block, Brain, RemoteBrain, RewardFunc, Sensor
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.editing.body_edits import Furniture
from ai4u_edu.editing.change_result import When
from ai4u_edu.editing.difference import OWN, Difference
from ai4u_edu.editing.drivers import DriverRegistry
from ai4u_edu.editing.state import EditState
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.serialization import from_plain
from ai4u_edu.world import Pose

Plain = Mapping[str, Any]


class Live:
    """The running world, and the state that it shows. Belongs to the runner's thread.

    Args:
        runner: whose world it is.
        state: what that world was built from.
        drivers: make the brains that are in no description.
    """

    def __init__(self, runner: Runner, state: EditState, drivers: DriverRegistry) -> None:
        self._runner = runner
        self._drivers = drivers
        self.shown = state
        """What the running world is."""
        self.wanted = state
        """What it is to be after the next reset."""
        self._watch()

    @property
    def is_due(self) -> bool:
        """Whether something waits for the next reset."""
        return self.shown != self.wanted

    @property
    def is_ours(self) -> bool:
        """Whether the runner's world is still the one that is changed here."""
        return self._runner.sim is self._sim

    def bring_about(self, state: EditState, places: Mapping[str, Pose]) -> When:
        """Applies as much as can be while the world runs; the rest waits for the next reset.

        Args:
            state: what is wanted.
            places: where bodies that are moved are put; others go where the state says.

        Raises:
            AI4UError: it can't be; then all is as it was.
        """
        difference = Difference(self.shown, state)
        partly = difference.possible_now
        if difference.has_changed or places:
            try:
                self._apply(partly, places)
            except AI4UError:
                if partly == state:
                    raise
                partly = self.shown  # it may need what comes with the reset
        self.shown, self.wanted = partly, state
        self._describe()
        if partly != state:
            return "next reset"
        return "now" if difference.only_things else "next decision"

    def build_anew(self, state: EditState, seed: int | None = None) -> None:
        """Has a world that is built from a state run in place of the one that there is."""
        sim = state.scene.build()
        for agent in sim.agents:
            if agent.id in state.drivers:
                self._driven(agent, state)
        if self._runner.recorder is not None:
            self._runner.recorder.scene = state.description
        self._runner.replace_sim_now(sim, seed=seed)
        self.shown = self.wanted = state
        self._watch()

    def hand_back(self, agent_id: str) -> None:
        """Lets an agent's own driver drive, in place of whoever took its place meanwhile."""
        agent, plain = self._sim.agent(agent_id), self.shown.agent(agent_id)["brains"]
        brains = agent.brains[: len(plain)]
        with files_in(self.shown.folder), _as_they_were(agent):
            for brain, given in zip(brains, plain, strict=True):
                brain.enabled = bool(given.get("enabled", True))
            if agent_id in self.shown.drivers:
                brains = self._with_guest(agent_id, self.shown, brains)
            _swap(agent, brains)

    def stir(self, *, look: bool = True) -> None:
        """Something was changed by hand: what is recorded ends here, and everybody looks again."""
        if self._runner.recorder is not None:
            self._runner.recorder.finish()
        for agent in self._sim.agents if look else ():
            sense_again(agent)

    # -- how -------------------------------------------------------------------------------------

    def _apply(self, state: EditState, places: Mapping[str, Pose]) -> None:
        sim, before = self._sim, self.shown
        furniture = Furniture(sim.world)
        fresh = self._is_fresh()
        moved = furniture.rearrange(before.description, state.description, places)
        done: list[tuple[BasicAgent, Blocks]] = []
        try:
            for agent in sim.agents:
                had = Blocks.of(agent)
                if self._fit(agent, before, state, world_changed=moved):
                    done.append((agent, had))
        except BaseException:
            furniture.undo()
            for agent in sim.agents:
                _set_own(agent, before.agent(agent.id))
            for agent, had in done:
                rebind(agent, sim.world, had)
            raise
        if not moved and _without_brains(before) == _without_brains(state):
            return  # who drives is no part of what is recorded
        if fresh:
            sim.reset(sim.world.seeds.seed)
            furniture.put_where_they_belong(places)
        if not fresh or furniture.is_astray:
            self.stir(look=moved)

    def _is_fresh(self) -> bool:
        """Whether nothing has happened yet, so that the episode may as well begin again."""
        agents = self._sim.agents
        return self._sim.world.ticks == 0 and not any(
            agent.steps or isinstance(agent.brain, RemoteBrain) for agent in agents
        )

    def _fit(
        self, agent: BasicAgent, before: EditState, state: EditState, *, world_changed: bool
    ) -> bool:
        old, new = before.agent(agent.id), state.agent(agent.id)
        _set_own(agent, new)
        blocks_changed = any(
            old.get(kind, ()) != new.get(kind, ()) for kind in ("sensors", "actuators", "rewards")
        )
        other_brain = old.get("brains", ()) != new.get("brains", ()) or before.drivers.get(
            agent.id
        ) != state.drivers.get(agent.id)
        if not (world_changed or blocks_changed or other_brain):
            return False
        with files_in(state.folder), _as_they_were(agent):
            blocks = Blocks(
                sensors=cast(list[Sensor], _made(Sensor, agent.sensors, old, new, "sensors")),
                actuators=cast(
                    list[Actuator], _made(Actuator, agent.actuators, old, new, "actuators")
                ),
                rewards=cast(
                    list[RewardFunc], _made(RewardFunc, agent.rewards, old, new, "rewards")
                ),
                brains=self._brains(agent, old, new, other_brain, blocks_changed),
            )
            if other_brain and agent.id in state.drivers:
                guests = self._with_guest(agent.id, state, blocks.brains)
                blocks = Blocks(blocks.sensors, blocks.actuators, blocks.rewards, guests)
            if world_changed or blocks_changed:
                rebind(agent, self._sim.world, blocks, keep_brain=not blocks_changed)
            else:
                _swap(agent, blocks.brains)
        return True

    def _brains(
        self, agent: BasicAgent, old: Plain, new: Plain, other: bool, blocks_changed: bool
    ) -> list[Brain]:
        described = agent.brains[: len(old.get("brains", ()))]
        brains = cast(list[Brain], _made(Brain, described, old, new, "brains"))
        guest = agent.brain
        is_guest = not any(guest is brain for brain in described)
        # who drives over a connection of its own was told what it senses, and of nothing else
        over = blocks_changed and isinstance(guest, RemoteBrain) and guest.is_given
        if is_guest and not other and not over:
            return [*brains, guest]
        if not other and any(guest is brain for brain in brains):
            return brains  # whichever drives now: a person may have taken over
        for brain, plain in zip(brains, new.get("brains", ()), strict=True):
            brain.enabled = bool(plain.get("enabled", True))
        return brains

    def _with_guest(self, agent_id: str, state: EditState, brains: Sequence[Brain]) -> list[Brain]:
        """With the driver that a state names, who drives then."""
        like = next(brain for brain in brains if brain.enabled)
        guest = self._drivers.brain(state.drivers[agent_id], agent_id, like)
        like.enabled = False
        return [*brains, guest]

    def _driven(self, agent: BasicAgent, state: EditState) -> None:
        agent.use_brain(self._drivers.brain(state.drivers[agent.id], agent.id, agent.brain))

    def _describe(self) -> None:
        """Tells those who show the scene what it is called, and what is to be done in it."""
        self._sim.goal = self.shown.description.goal
        self._sim.success = self.shown.description.success or ""
        if self._runner.recorder is not None:
            self._runner.recorder.scene = self.shown.description

    def _watch(self) -> None:
        self._sim = self._runner.sim
        self._episode = self._sim.episode
        self._sim.agents[0].begin_of_episode.connect(self._began)

    def _began(self, _agent: BasicAgent) -> None:
        sim = self._sim
        if sim.episode == self._episode:
            return  # of this agent alone
        self._episode = sim.episode
        if self.is_due and self.is_ours:
            seed = sim.world.seeds.seed
            # not in the middle of the reset that tells of it
            self._runner.submit(lambda: self._take_over(seed))

    def _take_over(self, seed: int) -> None:
        if self.is_due and self.is_ours:
            self.build_anew(self.wanted, seed)


def _set_own(agent: BasicAgent, plain: Plain) -> None:
    """Give an agent the parameters, besides its blocks, that can change under way."""
    for name in OWN:
        default = BasicAgent.parameters()[name].get_default(call_default_factory=True)
        setattr(agent, name, plain.get(name, default))


@contextmanager
def _as_they_were(agent: BasicAgent) -> Iterator[None]:
    """If something goes wrong, the same brain is on as before."""
    before = [(brain, brain.enabled) for brain in agent.brains]
    try:
        yield
    except BaseException:
        for brain, enabled in before:
            brain.enabled = enabled
        raise


def _swap(agent: BasicAgent, brains: Sequence[Brain]) -> None:
    """Gives an agent other brains; on the body nothing changes."""
    before = agent.brain
    wanted = next(brain for brain in brains if brain.enabled)
    try:
        if wanted is not before:
            agent.use_brain(wanted)
        agent.brains = list(brains)
    finally:
        for brain in (*brains, before):
            brain.enabled = brain is agent.brain


def _made(
    kind: type[Block], blocks: Sequence[Block], old: Plain, new: Plain, name: str
) -> list[Block]:
    """Blocks as they are wanted; those that are there already in that form stay."""
    there = list(zip(old.get(name, ()), blocks, strict=False))
    made = []
    for plain in new.get(name, ()):
        for index, (known, block) in enumerate(there):
            if _alike(known, plain):
                made.append(block)
                del there[index]
                break
        else:
            made.append(from_plain(kind, plain))
    return made


def _without_brains(state: EditState) -> list[dict[str, Any]]:
    agents = state.description.agents
    return [{name: each for name, each in agent.items() if name != "brains"} for agent in agents]


def _alike(one: Plain, other: Plain) -> bool:
    """The same but for which brain is on: that is said of it afterwards."""
    return {**one, "enabled": None} == {**other, "enabled": None}
