"""The networks that come with the package: small, at home in their scenes, and good."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.zoo import MAX_ZOO_NETWORK_BYTES, MIN_SUCCESS_SHARE

pytestmark = pytest.mark.needs("train")

NAMES = zoo.names()


def test_the_first_scenes_have_one() -> None:
    assert {"box_chase", "sample_scene"} <= set(NAMES)
    assert set(NAMES) <= set(Scene.names())


@pytest.mark.parametrize("name", NAMES)
def test_it_is_small_and_says_where_it_learned(name: str) -> None:
    assert zoo.network_of(name).stat().st_size <= MAX_ZOO_NETWORK_BYTES
    about = Network(zoo.network_of(name)).about
    assert about["scene"] == name
    assert about["steps"] > 0


def row(name: str) -> list[str]:
    """The README's row of a network, cell by cell."""
    lines = (zoo.FOLDER / "README.md").read_text(encoding="utf-8").splitlines()
    (found,) = (line for line in lines if line.startswith(f"| {name} |"))
    return [cell.strip() for cell in found.strip("|").split("|")]


@pytest.mark.parametrize("name", NAMES)
def test_it_still_drives_as_the_readme_says(name: str) -> None:
    """On fewer seeds than when it was made: a change of the scene or the physics shows here."""
    said = row(name)[4]
    assert said == "-" or float(said.rstrip("%")) >= 100 * MIN_SUCCESS_SHARE
    told = evaluate(entrant(f"zoo:{name}"), Scene.load(name), range(200, 220))
    if told.success is None:
        assert said == "-"
    else:
        assert told.success >= float(said.rstrip("%")) / 100 - 0.15, told


@pytest.mark.parametrize("name", NAMES)
def test_the_readme_says_how_it_learned(name: str) -> None:
    about = Network(zoo.network_of(name)).about
    assert row(name)[1:4] == [str(about[key]) for key in ("algorithm", "steps", "seed")]
