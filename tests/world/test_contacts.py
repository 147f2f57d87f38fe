"""Contacts: begin and separate, over and under, and removal."""

import gc

import pytest

from ai4u_edu.world import Body, BoxShape, CircleShape, World, WorldView


class Pair:
    """A watched robot at 0 and a ball at 2, both 1 m wide and high."""

    def __init__(self) -> None:
        self.world = World(damping=1.0)
        self.view = WorldView(self.world)
        self.robot = self.world.add_body("robot", CircleShape())
        self.ball = self.world.add_body("ball", CircleShape(), position=(2, 0))
        self.world.contacts.watch(self.robot)

    def touching(self) -> bool:
        return self.view.touching(self.robot, "ball")

    def touched_after(self, tick: int) -> bool:
        return self.view.touched_after(self.robot, "ball", tick)

    def run(self, ticks: int) -> int:
        """Ticks; returns in how many of them the two touched."""
        touched = 0
        for _ in range(ticks):
            self.world.tick()
            touched += self.touching()
        return touched

    def meet(self) -> None:
        self.robot.move_to(1.005, 0)
        self.world.tick()
        assert self.touching()


@pytest.fixture
def pair() -> Pair:
    return Pair()


def test_begin_and_separate(pair: Pair) -> None:
    pair.run(1)
    assert pair.view.contacts(pair.robot) == ()
    pair.meet()
    assert pair.view.contacts(pair.robot) == ("ball",)
    assert pair.run(5) == 5, "as long as they are together"
    pair.robot.move_to(-2, 0)
    pair.run(1)
    assert pair.view.contacts(pair.robot) == ()
    assert pair.world.contacts.begun("robot") == 1
    pair.meet()
    assert pair.world.contacts.begun("robot") == 2
    pair.world.reset()
    assert pair.world.contacts.begun("robot") == 0


def test_contacts_are_tracked_for_watched_bodies_only(pair: Pair) -> None:
    pair.meet()
    assert not pair.view.touching(pair.ball, "robot")
    pair.world.contacts.watch(pair.ball)
    assert pair.view.touching(pair.ball, "robot"), "also what began before"
    pair.run(3)
    assert pair.view.touching(pair.ball, "robot")


def test_contacts_come_in_the_order_of_first_touch(pair: Pair) -> None:
    post = pair.world.add_body("post", BoxShape(), kind="static", position=(0, 1.5))
    pair.meet()
    post.move_to(pair.robot.position[0], 0.995)
    pair.run(1)
    assert pair.view.contacts(pair.robot) == ("ball", "post")


def test_touched_after_counts_ticks(pair: Pair) -> None:
    assert not pair.touched_after(-1)
    pair.run(4)
    pair.meet()
    assert pair.world.ticks == 5
    pair.run(2)
    assert pair.touched_after(100), "they touch now"
    pair.robot.move_to(-2, 0)
    pair.run(1)
    assert not pair.touching()
    for tick in (0, 5, 6):
        assert pair.touched_after(tick)
    for tick in (7, 8, 9):
        assert not pair.touched_after(tick), "the last tick in which they touched was the 7th"


def test_a_touch_between_two_looks_is_not_missed() -> None:
    world = World(damping=1.0)
    robot = world.add_body("robot", CircleShape(), elasticity=1.0)
    ball = world.add_body("ball", CircleShape(), position=(2, 0), elasticity=1.0)
    world.contacts.watch(robot)
    ball.set_velocity(-6.0, 0.0)
    for _ in range(20):
        world.tick()
    view = WorldView(world)
    assert robot.velocity[0] < -5.0, "it was hit"
    assert not view.touching(robot, "ball")
    assert view.touched_after(robot, "ball", 5)
    assert not view.touched_after(robot, "ball", 18)


def test_an_area_is_touched_while_the_centre_is_in_it(pair: Pair) -> None:
    pair.world.add_area("goal", BoxShape(size=(2, 1)), position=(0, 4), heading_deg=90)
    for place, inside in (((0, 4.9), True), ((0, 5.1), False), ((0.6, 4), False)):
        pair.robot.move_to(*place)
        assert pair.view.touching(pair.robot, "goal") is inside
        assert pair.view.touched_after(pair.robot, "goal", 0) is inside
    assert pair.view.contacts(pair.robot) == ()
    assert "goal" in pair.view


def test_a_reset_forgets(pair: Pair) -> None:
    pair.meet()
    pair.robot.move_to(-2, 0)
    pair.run(1)
    pair.meet()
    pair.world.reset()
    assert not pair.touching()
    assert not pair.touched_after(-1)
    pair.meet()
    pair.robot.move_to(-2, 0)
    assert pair.run(3) == 0


def test_a_reset_is_not_disturbed_by_the_space_before_it(pair: Pair) -> None:
    for _ in range(3):
        pair.meet()
        pair.world.reset()
        pair.meet()
        gc.collect()
        assert pair.touching(), "the old space's goodbye is none of ours"
        pair.run(2)


def test_a_removal_forgets(pair: Pair) -> None:
    pair.meet()
    tick = pair.world.ticks
    pair.world.remove("ball")
    assert not pair.touching()
    assert pair.view.contacts(pair.robot) == ()
    assert pair.touched_after(tick - 1)
    assert not pair.touched_after(tick)
    pair.world.add_body("ball", CircleShape(), position=(8, 0))
    assert pair.run(2) == 0


def test_removed_body_leaves_no_contact_after_a_late_watch(pair: Pair) -> None:
    post = pair.world.add_body("post", BoxShape(), kind="static", position=(5, 0))
    pair.ball.move_to(4.005, 0)
    pair.run(1)
    pair.world.contacts.watch(post)
    assert pair.view.contacts(post) == ("ball",)
    pair.world.remove("ball")
    assert pair.view.contacts(post) == ()


def test_standing_on_top_is_touching(pair: Pair) -> None:
    pair.robot.move_to(2, 0, z=2.0)
    assert pair.run(20) == 0, "it falls towards the ball"
    while not pair.robot.on_ground:
        pair.run(1)
    assert pair.robot.z == 1.0
    assert pair.run(10) == 10
    pair.robot.jump(3.0)
    pair.run(2)
    assert 0 < pair.run(60) < 60, "not while it is in the air"
    assert pair.robot.position == (2.0, 0.0)
    pair.ball.move_to(8, 0)
    assert pair.run(20) == 0


def jump_over(jumper: Body, speed: float) -> None:
    jumper.set_velocity(speed, 0.0)
    jumper.jump(8.0)


def test_jumping_over_is_not_touching(pair: Pair) -> None:
    jump_over(pair.robot, 3.0)
    assert pair.run(120) == 0
    assert pair.robot.position[0] > 3.0
    assert not pair.touched_after(-1)


def test_being_jumped_over_is_not_touching(pair: Pair) -> None:
    jump_over(pair.ball, -3.0)
    assert pair.run(120) == 0
    assert pair.ball.position[0] < -1.0
    assert not pair.touched_after(-1)


def test_passing_under_is_not_touching(pair: Pair) -> None:
    pair.world.add_body("bridge", BoxShape(), kind="static", z=1.2, position=(0, 3))
    pair.world.add_body("roof", BoxShape(), kind="static", z=1.0, position=(0, 6))
    seen: set[str] = set()
    pair.robot.set_velocity(0.0, 3.0)
    for _ in range(160):
        pair.world.tick()
        seen |= set(pair.view.contacts(pair.robot))
    assert pair.robot.position[1] > 7.0
    assert seen == {"roof"}, "what it scrapes along with its top it touches"


def test_bumping_the_side_of_something_in_the_air_is_touching(pair: Pair) -> None:
    pair.world.add_body("board", BoxShape(), kind="static", z=1.5, position=(0, 3))
    pair.robot.jump(5.0)
    pair.robot.set_velocity(0.0, 4.0)
    seen: set[str] = set()
    for _ in range(60):
        pair.world.tick()
        seen |= set(pair.view.contacts(pair.robot))
    assert seen == {"board"}
    assert pair.robot.position[1] < 2.1
