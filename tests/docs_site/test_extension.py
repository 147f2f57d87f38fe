"""Names that the docs may refer to."""

import pytest

from ai4u_edu import Scene
from tests.docs_site.api_pages import constant_text
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


def test_a_constant_has_the_text_of_its_own_module() -> None:
    # other modules have constants of that name, too
    own = constant_text("ai4u_edu.explain", "LIMITS")
    assert own == "The method's limits, in words for people."
    assert constant_text("ai4u_edu.explain.occlusion", "LIMITS") == own
    assert constant_text("ai4u_edu.page.panel.socket", "LIMITS") not in ("", own)
    assert constant_text("ai4u_edu", "EVENTS") != ""  # which is imported when it is used first
