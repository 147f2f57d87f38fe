"""The page in the language of its browser."""

import pytest
from playwright.sync_api import expect

from tests.browser.served_viser import ServedViser
from tests.waiting import until

pytestmark = pytest.mark.browser


def test_notices_of_viser_speak_portuguese(site: ServedViser) -> None:
    page = site.page(has_viser=True, locale="pt-BR")
    until(lambda: len(site.inner.get_clients()) == 1)
    (client,) = site.inner.get_clients().values()
    client.add_notification("That didn't work", "as written")
    notice = page.locator(".mantine-Notification-root", has_text="as written")
    expect(notice).to_contain_text("Não funcionou")
