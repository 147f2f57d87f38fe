"""Bodies that leave the world and come back."""

import pytest

from ai4u_edu.base.errors import WorldError
from ai4u_edu.world import CircleShape, World, WorldView


@pytest.fixture
def world() -> World:
    """A robot on endless ground that touches a post, and a ball."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("post", CircleShape(radius=0.5), position=(0.9995, 0), kind="static")
    world.add_body("ball", CircleShape(radius=0.5), position=(0, 3))
    world.contacts.watch(world["robot"])
    world.tick()
    return world


@pytest.mark.parametrize("name", ["post", "ball"])
def test_body_that_left_has_no_contacts(world: World, name: str) -> None:
    x, y = world[name].position
    world[name].leave()
    assert world[name].fallen
    robot = world["robot"]
    assert WorldView(world).contacts(robot) == (() if name == "post" else ("post",))
    robot.move_to(x, y)
    for _ in range(10):
        world.tick()
    assert robot.position == (x, y), "nothing pushes it away"


@pytest.mark.parametrize("name", ["post", "ball"])
def test_it_comes_back_to_its_place(world: World, name: str) -> None:
    body = world[name]
    place = body.position
    body.leave()
    body.leave()  # there is nothing more to leave
    world.tick()
    body.come_back()
    assert not body.fallen
    assert body.position == place
    world.tick()
    assert WorldView(world).contacts(world["robot"]) == ("post",)


def test_it_can_be_put_somewhere_else(world: World) -> None:
    world["post"].leave()
    world["post"].move_to(5, 5)
    assert not world["post"].fallen
    assert world["post"].position == (5, 5)


def test_a_reset_brings_it_back(world: World) -> None:
    world["post"].leave()
    world.reset()
    assert not world["post"].fallen


def test_returning_body_gets_a_new_random_place() -> None:
    def places(seed: int) -> list[tuple[float, float]]:
        world = World()
        world.add_body("coin", CircleShape(radius=0.2), random={"x": (-9, 9), "y": (-9, 9)})
        world.reset(seed)
        found = [world["coin"].position]
        for _ in range(5):
            world["coin"].come_back()
            found.append(world["coin"].position)
        return found

    assert places(1) == places(1)
    assert len({*places(1), *places(2)}) == 12


def test_without_room_it_stays_away() -> None:
    world = World()
    world.add_body("coin", CircleShape(radius=0.2), random={"places": [(2, 0)]})
    world.add_body("robot", CircleShape(radius=0.5))
    coin = world["coin"]
    coin.leave()
    world["robot"].move_to(2, 0)
    with pytest.raises(WorldError, match=r"body 'coin': found no free place"):
        coin.come_back()
    assert coin.fallen
    world["robot"].move_to(0, 0)
    coin.come_back()
    assert coin.position == (2.0, 0.0)
    coin.come_back()  # it is not in its own way
    assert coin.position == (2.0, 0.0)
