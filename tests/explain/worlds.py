"""A robot before a box, for explanations."""

from typing import Any

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    RBMoveActuator,
    World,
)


def robot_and_box(
    controller: Any, *, box: tuple[float, float] = (3.0, 1.0), rays: int = 9, **sensor: Any
) -> ControlRequestor:
    """A robot at the origin that looks along x, with level rays and the bearing of a box."""
    world = World()
    world.add_floor("floor", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.4))
    world.add_body("box", BoxShape(size=(0.8, 0.8)), position=box, tags=["box"])
    fields = {"return_distance": True, "field_of_view": 90.0} | sensor
    agent = BasicAgent(
        body="robot",
        max_steps_per_episode=50,
        sensors=[
            LinearRayCastingSensor(
                perception_key="eyes", number_of_rays=rays, group_code={"box": 1}, **fields
            ),
            BearingSensor(target="box"),
        ],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=2, jump_power=0)],
        brains=[LocalBrain(controller=controller)],
    )
    sim = ControlRequestor(world, [agent])
    sim.reset(seed=0)
    return sim
