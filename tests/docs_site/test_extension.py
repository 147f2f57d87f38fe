"""Names that the docs may refer to."""

import pytest

from ai4u_edu import Scene
from tests.docs_site.extension import exists

pytestmark = pytest.mark.needs("docs")


@pytest.mark.parametrize(
    ("name", "is_there"),
    [
        ("numpy.ndarray", True),
        ("Scene.load", hasattr(Scene, "load")),
        ("numpi.ndarray", False),
        ("Scene.lod", False),
    ],
)
def test_a_name_exists_in_any_package_or_in_a_module_of_this_one(name: str, is_there: bool) -> None:
    assert exists(name) is is_there
