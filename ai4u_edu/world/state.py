"""The state of a world at one tick as data, so that a copy of the world can go on from there."""

from collections.abc import Mapping
from typing import Any, NamedTuple, Protocol

from ai4u_edu.world.contacts import ContactState
from ai4u_edu.world.descriptions import BodyDescription
from ai4u_edu.world.ink import InkImage
from ai4u_edu.world.messages import Message


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
