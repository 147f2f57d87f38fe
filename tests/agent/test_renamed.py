"""Old names of agents and requestors work for one release, with a warning."""

import pytest

from tests.builders import small_sim


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("fitting", "bound_blocks"),
        ("companions", "other_agents"),
        ("see", "replace_percept"),
        ("obey", "apply_command"),
    ],
)
def test_an_agents_old_name(old: str, new: str) -> None:
    agent = small_sim().agents[0]
    with pytest.warns(DeprecationWarning, match=f"BasicAgent.{old} is now BasicAgent.{new}"):
        assert getattr(agent, old) == getattr(agent, new)


@pytest.mark.parametrize(("old", "new"), [("leap", "step_decision"), ("held", "waiting_for_brain")])
def test_a_requestors_old_name(old: str, new: str) -> None:
    sim = small_sim()
    with pytest.warns(DeprecationWarning, match=f"{old} is now ControlRequestor.{new}"):
        assert getattr(sim, old) == getattr(sim, new)


def test_a_ledgers_old_name() -> None:
    ledger = small_sim().agents[0].ledger
    with pytest.warns(DeprecationWarning, match="remember is now Ledger.keep_history"):
        ledger.remember(3)  # type: ignore[attr-defined]  # hidden from type checkers
    assert ledger.history.maxlen == 3
