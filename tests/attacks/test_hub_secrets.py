"""Wrong secrets at a hub: they cost it a number of requests, and not one each."""

import asyncio

import pytest

from ai4u_edu.classroom.hub import HubEnvironment
from ai4u_edu.classroom.hub.api import HubApi, HubUnreachableError
from ai4u_edu.page.server.limits.attempts import MAX_WRONG
from tests.classroom.fake_hub import NAME, PREFIX, SECRET, FakeHub, fake_hub
from tests.page.server.rooms import Clock


def api_of(hub: FakeHub) -> HubApi:
    variables = {
        "JUPYTERHUB_API_TOKEN": SECRET,
        "JUPYTERHUB_API_URL": hub.api_url,
        "JUPYTERHUB_BASE_URL": "/",
        "JUPYTERHUB_CLIENT_ID": f"service-{NAME}",
        "JUPYTERHUB_SERVICE_NAME": NAME,
        "JUPYTERHUB_SERVICE_PREFIX": PREFIX,
    }
    return HubApi(HubEnvironment.read(variables), Clock(1000.0))


def test_an_address_with_many_wrong_secrets_asks_the_hub_no_more(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ai4u_edu.page.server.limits.attempts.MAX_CODE_WAIT_S", 0.0)

    async def guess(hub: FakeHub) -> None:
        api, ada = api_of(hub), hub.add("ada")
        for number in range(MAX_WRONG):
            assert await api.user_of(f"guess {number}".replace(" ", ""), "mallory") is None
        assert len(hub.asked) == MAX_WRONG
        for number in range(10):
            with pytest.raises(HubUnreachableError, match="Too many sign-ins"):
                await api.user_of(f"more{number}", "mallory")
        assert len(hub.asked) == MAX_WRONG
        user = await api.user_of(ada, "another address")
        assert user is not None
        assert await api.user_of(ada, "mallory") == user  # the answer is known

    with fake_hub() as hub:
        asyncio.run(guess(hub))
