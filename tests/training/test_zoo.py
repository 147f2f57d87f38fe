"""The networks that come with the package: small, at home in their scenes, and good."""

import pytest

from ai4u_edu import Scene, zoo
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.training.entrants import entrant
from ai4u_edu.training.evaluate import evaluate
from ai4u_edu.training.zoo import LARGEST, WANTED

NAMES = zoo.names()


def test_the_first_scenes_have_one() -> None:
    assert {"box_chase", "sample_scene"} <= set(NAMES)
    assert set(NAMES) <= set(Scene.names())


@pytest.mark.parametrize("name", NAMES)
def test_it_is_small_and_says_where_it_learned(name: str) -> None:
    assert zoo.network_of(name).stat().st_size <= LARGEST
    about = Network(zoo.network_of(name)).about
    assert about["scene"] == name
    assert about["steps"] > 0


@pytest.mark.parametrize("name", NAMES)
def test_it_still_drives_well(name: str) -> None:
    """On fewer seeds than when it was made: a change of the scene or the physics shows here."""
    told = evaluate(entrant(f"zoo:{name}"), Scene.load(name), range(200, 220))
    assert told.success is None or told.success >= WANTED - 0.1, told


@pytest.mark.parametrize("name", NAMES)
def test_the_readme_has_a_row_for_it(name: str) -> None:
    assert f"| {name} |" in (zoo.FOLDER / "README.md").read_text()
