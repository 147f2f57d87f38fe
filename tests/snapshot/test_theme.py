from ai4u_edu.base.colors import rgb
from ai4u_edu.snapshot.theme import WALL, body_colour, group_colours, mix_colours
from ai4u_edu.world import BodyDescription
from tests.page.viewer.worlds import busy_world, static_scene_of


def test_a_body_without_a_colour_gets_that_of_its_role() -> None:
    assert body_colour(BodyDescription(name="x", kind="static"), False) == WALL
    assert body_colour(BodyDescription(name="x"), True) == rgb("blue")
    assert body_colour(BodyDescription(name="x", tags=("target",)), False) == rgb("orange")
    assert body_colour(BodyDescription(name="x"), False) == rgb("sky blue")
    assert body_colour(BodyDescription(name="x", kind="kinematic"), False) == rgb("green")


def test_a_described_colour_wins() -> None:
    agent = BodyDescription(name="x", colour="#010203", tags=("target",))
    assert body_colour(agent, True) == (1, 2, 3)


def test_a_group_has_the_colour_of_its_first_member() -> None:
    colours = group_colours(static_scene_of(busy_world()))
    assert colours["target"] == rgb("orange")
    assert colours["wall"] == WALL
    assert colours["agent"] == rgb("blue")
    assert colours["floor"] != colours["wall"]


def test_mixing_ends_at_both_colours() -> None:
    assert mix_colours((10, 20, 30), (200, 100, 0), 0.0) == (10, 20, 30)
    assert mix_colours((10, 20, 30), (200, 100, 0), 1.0) == (200, 100, 0)
