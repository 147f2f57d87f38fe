"""The state of a world at one tick as data, so that a copy of the world can go on from there."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from ai4u_edu.world.contacts import ContactState
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.ink import InkImage
from ai4u_edu.world.messages import Message

if TYPE_CHECKING:
    from ai4u_edu.world.world import World


class Motion(Protocol):
    """Pose and velocity of a body: metres, radians, m/s, rad/s.

    A snapshot's BodyState is one; :class:`BodyMotion` has the heading with its whole turns.
    """

    @property
    def x(self) -> float:
        """Centre."""

    @property
    def y(self) -> float:
        """Centre."""

    @property
    def z(self) -> float:
        """Height of the underside."""

    @property
    def heading(self) -> float:
        """Counter-clockwise from +x."""

    @property
    def vx(self) -> float:
        """Velocity in the world's frame."""

    @property
    def vy(self) -> float:
        """Velocity in the world's frame."""

    @property
    def vz(self) -> float:
        """Upward speed."""

    @property
    def angular_velocity(self) -> float:
        """Turning speed."""

    @property
    def on_ground(self) -> bool:
        """True if it stands on something."""

    @property
    def fallen(self) -> bool:
        """True if it is out of the world."""


class BodyMotion(NamedTuple):
    """Pose and velocity of a body, as the physics has them."""

    x: float
    y: float
    z: float
    heading: float
    vx: float
    vy: float
    vz: float
    angular_velocity: float
    on_ground: bool
    fallen: bool


class WorldState(NamedTuple):
    """Everything that changes in a world while it runs."""

    seed: int
    ticks: int
    generators: Mapping[str, Mapping[str, Any]]
    """States of the random generators that were used, by name."""
    held: tuple[tuple[str, str], ...]
    """Names of bodies that hold another one, and of the one that they hold."""
    sampled: Mapping[str, BodyDescription]
    """Descriptions of bodies that a restart has put to another random place than the seed's."""
    contacts: ContactState
    ink: InkImage
    messages: Mapping[str, Message]
    """The last message of each speaker, by its body's name."""
    motions: Mapping[str, Motion]
    """The bodies' motions by name; empty where a snapshot has them."""


def capture_world(world: "World", *, with_motions: bool = True) -> WorldState:
    """Return the state of a world.

    Args:
        world: the world, between two ticks.
        with_motions: False leaves out the bodies' motions, which take most of the time.
    """
    return WorldState(
        seed=world.seeds.seed,
        ticks=world.ticks,
        generators=world.seeds.get_state(),
        held=tuple(_held(world)),
        sampled={
            body.name: body.sampled for body in world.bodies.values() if body.description.random
        },
        contacts=world.contacts.get_state(),
        ink=world.ink.image(),
        messages=world.messages.get_state(),
        motions=motions_of(world) if with_motions else {},
    )


def motions_of(world: "World") -> dict[str, BodyMotion]:
    """Return the motions of a world's bodies by name."""
    return {
        body.name: BodyMotion(
            *body._pm.position,
            body.z,
            body._pm.angle,
            *body.velocity,
            body.vz,
            body.angular_velocity,
            body.on_ground,
            body.fallen,
        )
        for body in world.bodies.values()
    }


def _held(world: "World") -> Iterator[tuple[str, str]]:
    if world.space.constraints:
        for body in world.bodies.values():
            held = body.held
            if held is not None:
                yield body.name, held.name


def restore_world(world: "World", state: WorldState) -> None:
    """Put a world into the state of another one of the same description.

    Bodies that only one of the two has are left as they are.

    Args:
        world: a world that has just been reset to the state's seed.
        state: of :func:`capture_world`.
    """
    bodies = world.bodies
    for name, sampled in state.sampled.items():
        if name in bodies and bodies[name].sampled != sampled:
            world.place_as(name, sampled)
    for name, motion in state.motions.items():
        if name in bodies:
            world.set_motion(name, motion)
    for holder, held in state.held:
        if holder in bodies and held in bodies:
            bodies[holder].hold(bodies[held])
    world.ticks = world.contacts.tick = state.ticks
    world.ink.set_image(state.ink)
    world.messages.set_state(state.messages)
    world.contacts.set_state(state.contacts)
    world.seeds.set_state(state.generators)
