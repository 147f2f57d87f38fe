"""A script that comes from elsewhere, with the world's token and without."""

from typing import Any

import httpx
import pytest

from tests.remote.second_host import (
    HERE,
    REFUSED,
    is_possible,
    open_world,
    script,
    second_host,
)
from tests.waiting import LIMIT_S


def get(url: str, **options: Any) -> httpx.Response:
    return httpx.get(url, timeout=LIMIT_S, **options)


pytestmark = pytest.mark.slow


def test_from_another_address_with_the_token_and_without() -> None:
    with open_world() as (server, port, token):
        there = f"http://127.0.0.2:{port}/"
        assert script(f"{there}?token={token}").startswith("drove to step ")
        assert script(there) == REFUSED
        assert script(f"{there}?token=guess") == REFUSED.replace("got none", "got another one")
        refused = get(there + "api/snapshot")
        assert refused.status_code == 401
        assert refused.text.startswith("token: expected this world's token, got none; open the")
        assert get(there + "api/snapshot", params={"token": token}).status_code == 200
        assert any("Other machines can reach it." in line for line in server.told)
        foreign = get(there, headers={"Host": "evil.example"}, params={"token": token})
        assert foreign.status_code == 403


@pytest.mark.alone  # Chromium ends all that it loads when an address of its machine comes or goes
def test_from_another_host_with_the_token_and_without() -> None:
    if not is_possible():
        pytest.skip("a network namespace takes Linux, root and iproute2")
    with open_world() as (_, port, token), second_host() as host:
        assert script(f"http://{HERE}:{port}/?token={token}", *host).startswith("drove to step ")
        assert script(f"http://{HERE}:{port}/", *host) == REFUSED
