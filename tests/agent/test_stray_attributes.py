"""A slip in the name of an attribute is an error with a suggestion, and not without effect."""

import pytest

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    RBMoveActuator,
    RewardFunc,
    Scene,
    World,
)
from ai4u_edu.base.errors import UnknownAttributeError
from ai4u_edu.world import Body, WorldView


class Counting(RewardFunc):
    """A student's block, which keeps what it likes."""

    def on_update(self, body: Body, view: WorldView) -> float:  # type: ignore[override]
        self.count = getattr(self, "count", 0) + 1
        self._hidden = self.count
        return 0.0


def test_a_world_takes_no_other_attributes() -> None:
    world = World()
    with pytest.raises(UnknownAttributeError, match=r"'gravty'; .* World\(gravity=\.\.\.\)"):
        world.gravty = 1.6  # type: ignore[attr-defined]  # it is refused
    with pytest.raises(UnknownAttributeError, match=r"options=\{'world.gravity'"):
        world.gravity = 1.6  # type: ignore[attr-defined]  # it is refused
    with pytest.raises(AttributeError, match="'boddies'; did you mean 'bodies'"):
        world.boddies = []  # type: ignore[attr-defined]  # it is refused
    world.tick()
    assert world.ticks == 1
    world.reset(1)
    assert world.ticks == 0


def agent_with(sensor: LinearRayCastingSensor) -> BasicAgent:
    return BasicAgent(
        body="robot",
        sensors=[sensor],
        actuators=[RBMoveActuator()],
        rewards=[Counting()],
        brains=[LocalBrain(controller=lambda percept: {})],
    )


def test_a_block_with_another_attribute_is_refused_at_setup() -> None:
    world = World()
    world.add_body("robot", CircleShape())
    sensor = LinearRayCastingSensor()
    sensor.number_of_ray = 3  # type: ignore[attr-defined]  # it is refused
    with pytest.raises(
        UnknownAttributeError, match="'number_of_ray'; did you mean 'number_of_rays'"
    ):
        ControlRequestor(world, [agent_with(sensor)])


def test_a_block_that_gets_one_later_is_refused_at_the_next_reset() -> None:
    world = World()
    world.add_body("robot", CircleShape())
    sensor = LinearRayCastingSensor()
    sim = ControlRequestor(world, [agent_with(sensor)])
    sim.reset(1)
    sim.step()
    sim.reset(2)  # what the student's block keeps is its own
    sensor.field_of_veiw = 30  # type: ignore[attr-defined]  # it is refused
    with pytest.raises(UnknownAttributeError, match="did you mean 'field_of_view'"):
        sim.reset(3)
    del sensor.field_of_veiw  # type: ignore[attr-defined]  # as it says to
    sim.reset(3)


@pytest.mark.parametrize("name", Scene.names())
def test_the_blocks_of_the_library_know_all_their_attributes(name: str) -> None:
    sim = Scene.load(name).build()
    for seed in range(2):
        sim.reset(seed)
        for _ in range(30):
            sim.step_decision()
