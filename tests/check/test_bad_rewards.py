"""The findings about reward functions that break a rule, word for word."""

from typing import Any

import pytest

from ai4u_edu import (
    RewardFunc,
    check_reward,
)
from ai4u_edu.check import Outcome
from tests.check.reports import SHORT, failed, outcome


class Fee(RewardFunc):
    """Costs the distance to the middle; the other classes break one rule each."""

    def on_update(self, body: Any, view: Any) -> Any:
        return -abs(body.position[0])


class PaysWords(Fee):
    """Pays in words."""

    def on_update(self, body: Any, view: Any) -> Any:
        return "a lot"


class Infinite(Fee):
    """Pays too much."""

    def on_update(self, body: Any, view: Any) -> Any:
        return float("inf")


class Growing(Fee):
    """Pays more each time, also in the next episode."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = 0

    def on_update(self, body: Any, view: Any) -> Any:
        self.count += 1
        return self.count


class Kicking(Fee):
    """Kicks the agent for its own good."""

    def on_update(self, body: Any, view: Any) -> Any:
        body.set_velocity(5, 0)
        return body.position[0]


class Flat(Fee):
    """Pays a point each time."""

    def on_update(self, body: Any, view: Any) -> Any:
        return 1.0


@pytest.mark.parametrize(
    ("reward", "expected"),
    [
        (Fee(), {}),
        (Fee(cause_episode_to_end=True), {}),
        (
            PaysWords(),
            {
                "runs": "expected 20 decisions without an error, got ReadingError: agent '0', "
                "PaysWords 'pays_words': expected a number from on_update, got 'a lot'"
            },
        ),
        (
            Infinite(),
            {
                "runs": "expected 20 decisions without an error, got ReadingError: agent '0', "
                "Infinite 'infinite': expected a finite number, got inf"
            },
        ),
        (
            Growing(),
            {
                "forgets": "expected the same rewards again after a reset, got 21.0 in place of "
                "1.0 after decision 1; put back in on_reset whatever changes in an episode"
            },
        ),
        (
            Kicking(),
            {
                "only looks": "expected the world to go on as it does without it, got body 'robot' "
                "at another place after decision 2; what only looks must not move anything"
            },
        ),
    ],
)
def test_bad_rewards(reward: RewardFunc, expected: dict[str, str]) -> None:
    assert failed(check_reward(reward, **SHORT)) == expected


def test_a_reward_that_never_changes_is_a_warning() -> None:
    for reward, got in ((Flat(), "1.0 all 20 times"), (Flat(is_active=False), "none")):
        report = check_reward(reward, **SHORT)
        assert report.ok
        assert outcome(report, "changes") == (
            Outcome.WARNING,
            f"expected rewards that change while the agent drives about, got {got}; if there is "
            "nothing here to make them change, check it in another scene, by scene=...",
        )
