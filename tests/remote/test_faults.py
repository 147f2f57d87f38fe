"""A short slice of ``python -m tests.remote.faults``, and each kind of fault by itself."""

import pytest

from tests.remote.faults import run
from tests.remote.faulty_proxy import Faults

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    "faults",
    [
        Faults(drop=0.05, duplicate=0.05, reorder=0.10, single_bytes=0.5),
        Faults(reset=0.05, latency=0.02),
    ],
    ids=["frames", "connections"],
)
def test_every_action_is_applied_once_in_order_and_on_its_step(faults: Faults) -> None:
    assert run(40, 4, faults) == []
