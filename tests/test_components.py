"""Every component has a test and a sample; every class of AI4U has a counterpart.

The table of them stands at the end of the log.
"""

from collections.abc import Callable

import pytest

import ai4u_edu
from ai4u_edu import Block
from tests.components import AI4U, MISSING, Component, components, parity_rows, table
from tests.conftest import COMPONENT_TABLE


def test_the_table_is_in_the_log(record_property: Callable[[str, object], None]) -> None:
    told = table()
    assert len(told.splitlines()) > 50
    record_property(COMPONENT_TABLE, told)


@pytest.mark.parametrize("component", components(), ids=lambda component: component.name)
def test_each_has_a_test_of_its_own(component: Component) -> None:
    assert component.tests, f"no test names {component.name}; expected one that tries it"
    assert component.contract != "NO", f"add a sample of {component.name} in tests/check/samples/"


def test_none_of_ai4us_is_forgotten() -> None:
    assert sorted(parity_rows().keys() | MISSING.keys()) == sorted(AI4U.split())
    for ours in filter(None, parity_rows().values()):
        assert hasattr(ai4u_edu, ours), f"{ours} is said to be here, and the package has none"


def test_what_is_said_to_be_missing_is() -> None:
    rows = parity_rows()
    here = [name for name in [*MISSING, *rows] if not rows.get(name) and _is_here(name)]
    assert here == [], "they are there: say so in tests/components.py or blocks/docs.py"


def _is_here(name: str) -> bool:
    return name in Block.types or hasattr(ai4u_edu, name)
