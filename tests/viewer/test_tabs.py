"""Each page has its own tabs."""

import pytest

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.tabs import TabKind, Tabs
from ai4u_edu.viewer.viewer_client import ViewerClient
from tests.viewer.pages import page, part_of, shown, until


class Counter:
    """Counts how often it is drawn."""

    def __init__(self, viewer_client: ViewerClient) -> None:
        self.html = viewer_client.client.gui.add_html("")
        self.drawn = 0

    def draw(self, snapshot: Snapshot) -> None:
        self.drawn += 1
        self.html.content = f"<p>{snapshot.tick}</p>"


class Broken(Counter):
    """Can't be drawn."""

    def draw(self, snapshot: Snapshot) -> None:
        raise ValueError("no drawing today")


def broken(viewer_client: ViewerClient) -> Counter:
    raise ValueError("not even opened")


@pytest.fixture
def tabs(viewer: Viewer) -> Tabs:
    """The viewer's tabs, with some of ours."""
    tabs = part_of(viewer, Tabs)
    mine = (TabKind("Odd", Broken), TabKind("None", broken), TabKind("Mine", Counter))
    tabs.kinds = (*tabs.kinds, *mine)
    return tabs


def mine_of(tabs: Tabs) -> list[Counter]:
    return [
        tab
        for _, each in sorted(tabs.pages.items())
        for tab in each.tabs
        if isinstance(tab, Counter) and not isinstance(tab, Broken)
    ]


def test_each_page_has_all_tabs_and_what_is_broken_stops_no_other(
    viewer: Viewer, runner: Runner, tabs: Tabs, capsys: pytest.CaptureFixture[str]
) -> None:
    with page(viewer), page(viewer):
        until(lambda: len(viewer.server.get_clients()) == 2)
        shown(viewer)
        shown(viewer)
        assert [tab.drawn for tab in mine_of(tabs)] == [2, 2]
        titles = [each.panel._tab_labels for _, each in sorted(tabs.pages.items())]
        assert titles[0] == titles[1]
        assert titles[0][0] == "Agent"
        assert titles[0][-1] == "Mine"
    assert capsys.readouterr().err.count("Traceback") == 2  # each is told once


def test_what_a_page_adds_stands_in_its_own_tab(viewer: Viewer, tabs: Tabs) -> None:
    with page(viewer):
        shown(viewer)
        (mine,) = mine_of(tabs)
        (opened,) = tabs.pages.values()
        assert mine.html._impl.parent_container_id == opened.panel._tab_container_ids[-1]


def test_a_page_that_is_gone_is_forgotten(viewer: Viewer, tabs: Tabs) -> None:
    with page(viewer):
        shown(viewer)
        assert tabs.pages
    until(lambda: not viewer.server.get_clients())
    shown(viewer)
    assert not tabs.pages
