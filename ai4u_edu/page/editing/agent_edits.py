"""Changes of one running agent's blocks and brains."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TypeVar, cast

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.rebind import Blocks, rebind
from ai4u_edu.blocks import Actuator, Block, Brain, RemoteBrain, RewardFunc, Sensor
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.state_difference import RUNTIME_PARAMETERS
from ai4u_edu.scenes.serialization import from_plain
from ai4u_edu.world import World

B = TypeVar("B", bound=Block)


class AgentEdits:
    """Brings one running agent from one state to another, in the runner's thread.

    Args:
        agent: the agent to change.
        world: the agent's world.
        drivers: makes the brains that are in no scene description (guests).
    """

    def __init__(self, agent: BasicAgent, world: World, drivers: DriverRegistry) -> None:
        self._agent = agent
        self._world = world
        self._drivers = drivers

    def apply(self, before: EditState, after: EditState, *, world_changed: bool) -> bool:
        """Change the agent, and return True if its blocks or brains were replaced.

        Raises:
            AI4UError: some block can't be made or bound; its brains are as before.
        """
        agent = self._agent
        old, new = before.agent(agent.id), after.agent(agent.id)
        set_runtime_parameters(agent, new)
        blocks_changed = any(
            old.get(kind, ()) != new.get(kind, ()) for kind in ("sensors", "actuators", "rewards")
        )
        driver_changed = before.drivers.get(agent.id) != after.drivers.get(agent.id)
        brain_changed = driver_changed or old.get("brains", ()) != new.get("brains", ())
        if not (world_changed or blocks_changed or brain_changed):
            return False
        with files_in(after.folder), _restoring_enabled(agent):
            brains = self._brains(old, new, brain_changed, blocks_changed)
            if brain_changed and agent.id in after.drivers:
                brains = self._with_guest(after, brains)
            if world_changed or blocks_changed:
                blocks = Blocks(
                    _reuse_or_make(Sensor, agent.sensors, old, new, "sensors"),
                    _reuse_or_make(Actuator, agent.actuators, old, new, "actuators"),
                    _reuse_or_make(RewardFunc, agent.rewards, old, new, "rewards"),
                    brains,
                )
                rebind(agent, self._world, blocks, keep_brain=not blocks_changed)
            else:
                _replace_brains(agent, brains)
        return True

    def restore_driver(self, state: EditState) -> None:
        """Hand control back from a person or a script to the driver that the state names."""
        agent, described = self._agent, state.agent(self._agent.id)["brains"]
        brains: Sequence[Brain] = agent.brains[: len(described)]
        with files_in(state.folder), _restoring_enabled(agent):
            for brain, plain in zip(brains, described, strict=True):
                brain.enabled = bool(plain.get("enabled", True))
            if agent.id in state.drivers:
                brains = self._with_guest(state, brains)
            _replace_brains(agent, brains)

    def _brains(
        self, old: Plain, new: Plain, brain_changed: bool, blocks_changed: bool
    ) -> list[Brain]:
        agent = self._agent
        described = agent.brains[: len(old.get("brains", ()))]
        brains = _reuse_or_make(Brain, described, old, new, "brains")
        driving = agent.brain
        is_guest = not any(driving is brain for brain in described)
        # a script that connected by itself was told the blocks of before, so it has to reconnect
        is_outdated = blocks_changed and isinstance(driving, RemoteBrain) and driving.has_own_link
        if is_guest and not brain_changed and not is_outdated:
            return [*brains, driving]
        if not brain_changed and any(driving is brain for brain in brains):
            return brains  # a person may have taken over: the enabled brain stays as it is
        for brain, plain in zip(brains, new.get("brains", ()), strict=True):
            brain.enabled = bool(plain.get("enabled", True))
        return brains

    def _with_guest(self, state: EditState, brains: Sequence[Brain]) -> list[Brain]:
        """Add the driver that a state names, and disable the brain that was enabled."""
        like = next(brain for brain in brains if brain.enabled)
        guest = self._drivers.brain(state.drivers[self._agent.id], self._agent.id, like)
        like.enabled = False
        return [*brains, guest]


def set_runtime_parameters(agent: BasicAgent, plain: Plain) -> None:
    """Set those parameters of an agent, besides its blocks, that can change at run time."""
    for name in RUNTIME_PARAMETERS:
        default = BasicAgent.parameters()[name].get_default(call_default_factory=True)
        setattr(agent, name, plain.get(name, default))


@contextmanager
def _restoring_enabled(agent: BasicAgent) -> Iterator[None]:
    """Restore which brain is enabled if the block raises."""
    before = [(brain, brain.enabled) for brain in agent.brains]
    try:
        yield
    except BaseException:
        for brain, enabled in before:
            brain.enabled = enabled
        raise


def _replace_brains(agent: BasicAgent, brains: Sequence[Brain]) -> None:
    """Give an agent other brains without rebinding its other blocks."""
    before = agent.brain
    wanted = next(brain for brain in brains if brain.enabled)
    try:
        if wanted is not before:
            agent.use_brain(wanted)
        agent.brains = list(brains)
    finally:
        for brain in (*brains, before):
            brain.enabled = brain is agent.brain


def _reuse_or_make(
    kind: type[B], blocks: Sequence[B], old: Plain, new: Plain, name: str
) -> list[B]:
    """Return the wanted blocks of a kind; existing blocks with the same parameters are reused."""
    existing = list(zip(old.get(name, ()), blocks, strict=False))
    wanted: list[B] = []
    for plain in new.get(name, ()):
        for index, (known, block) in enumerate(existing):
            if _is_same_but_enabled(known, plain):
                wanted.append(block)
                del existing[index]
                break
        else:
            wanted.append(cast(B, from_plain(kind, plain)))
    return wanted


def _is_same_but_enabled(one: Plain, other: Mapping[str, object]) -> bool:
    return {**one, "enabled": None} == {**other, "enabled": None}
