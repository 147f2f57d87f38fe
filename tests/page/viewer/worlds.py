"""A world in which there is one of everything."""

from typing import Any

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CapsuleShape,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    PolygonShape,
    RBMoveActuator,
    RingShape,
    SegmentShape,
    TouchRewardFunc,
    World,
)
from ai4u_edu.snapshot import (
    Snapshot,
    StaticScene,
    capture_agent,
    capture_bodies,
    capture_static_scene,
)


def busy_world() -> World:
    world = World(seed=1)
    world.add_floor("plate", BoxShape(size=(10, 10)))
    world.add_floor("ring", RingShape(inner=1, outer=2), position=(7.5, 0), colour="light grey")
    world.add_floor(
        "step", PolygonShape(vertices=((1, 0), (0, 1), (-1, 0))), position=(0, 3), top=0.5
    )
    world.add_floor("pier", CapsuleShape(length=2, radius=0.5), position=(0, -5.6), heading_deg=90)
    world.add_area("goal", CircleShape(radius=1), position=(3, 3), label="the <goal>")
    world.add_body("robot", CircleShape(radius=0.4), tags=("agent",))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0), tags=("target",), label="<b>")
    world.add_body("twin", BoxShape(size=(0.6, 0.6)), position=(-3, -1))
    world.add_body("other twin", BoxShape(size=(0.6, 0.6)), position=(-3, 1), colour="purple")
    wall = SegmentShape(a=(-4, -3), b=(4, -3))
    world.add_body("wall", wall, kind="static", tags=("wall",))
    return world


def busy_sim(controller: Any = lambda _percept: {}) -> ControlRequestor:
    agent = BasicAgent(
        body="robot",
        sensors=[
            LinearRayCastingSensor(
                perception_key="fan",
                number_of_rays=5,
                field_of_view=120,
                vision_max_distance=5,
                group_code={"target": 1, "wall": 2},
            )
        ],
        actuators=[RBMoveActuator(move_amount=2)],
        rewards=[TouchRewardFunc(target="box", reward=1)],
        brains=[LocalBrain(controller=controller, skip_frame=0)],
    )
    return ControlRequestor(busy_world(), [agent])


def static_scene_of(world: World) -> StaticScene:
    brain = LocalBrain(controller=lambda _percept: {})
    return capture_static_scene(ControlRequestor(world, [BasicAgent(body="robot", brains=[brain])]))


def picture(sim: ControlRequestor) -> Snapshot:
    return Snapshot(
        static_scene=capture_static_scene(sim),
        tick=sim.world.ticks,
        time=sim.world.time,
        episode_time=sim.world.time,
        seed=sim.world.seeds.seed,
        episode=sim.episode,
        paused=False,
        time_scale=1.0,
        real_time_factor=1.0,
        error="",
        bodies=capture_bodies(sim),
        agents=tuple(capture_agent(agent) for agent in sim.agents),
        state=sim.get_state(with_motions=False),
    )
