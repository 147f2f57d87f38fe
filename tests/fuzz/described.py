"""The API checked against its OpenAPI document, by schemathesis."""

import math
from typing import Any

from hypothesis import HealthCheck, given, settings

from ai4u_edu.page.server import room_app
from ai4u_edu.runtime.runner import Runner
from tests.builders import small_sim


def hold_against_description(examples: int) -> str:
    """Send generated requests to each operation, and return a summary sentence.

    Raises:
        AssertionError: an answer does not fit the description.
    """
    import schemathesis  # not everybody has it

    runner = Runner(small_sim(), seed=1, time_scale=math.inf)
    app = room_app(runner, viser_port=9, title="A room", allowed_hosts=("localhost", "testserver"))
    schema: Any = schemathesis.openapi.from_asgi("/api/openapi.json", app)
    asked = 0
    for found in schema.get_all_operations():
        operation = found.ok()

        @given(case=operation.as_strategy())
        @settings(
            max_examples=examples,
            deadline=None,
            derandomize=True,
            suppress_health_check=list(HealthCheck),
            database=None,
        )
        def answers_as_described(case: Any) -> None:
            nonlocal asked
            asked += 1
            runner.advance()
            case.call_and_validate()

        answers_as_described()
    return f"{'http':<14} schemathesis: {asked} requests answered as described"
