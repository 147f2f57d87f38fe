"""The lines to paste into a notebook."""

import viser
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server import Rules, ServerThread, room_app
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.agent_tab import AgentTab
from ai4u_edu.viewer.panel.remote_lines import lines
from tests.builders import small_sim
from tests.remote.rooms import log_sim
from tests.viewer.pages import Page, page, shown, tabs_of, until


def lines_on(viewer: Viewer) -> list[str]:
    """The lines on each page."""
    shown(viewer)
    return [tab.remote_lines.lines.content for tab in tabs_of(viewer, AgentTab)]


def test_the_lines_are_python_for_this_agent() -> None:
    agent = small_sim().agents[0]
    text = lines("http://teacher:8080", agent)
    code = text.split("```python\n")[1].split("```")[0]
    assert code == (
        "from ai4u_edu.remote import connect\n\n"
        "robot = connect('http://teacher:8080', agent='0')\n"
        "for percept in robot:\n"
        "    robot.act(move=[1, 0, 0, 0])\n"
        "robot.close()\n"
    )
    compile(code, "lines", "exec")


def test_each_page_has_them_with_the_address_by_which_it_came(
    viewer: Viewer, runner: Runner
) -> None:
    with ServerThread(room_app(runner, viser_port=viewer.port, title="A room")) as server:
        address = server.url.rstrip("/").replace("127.0.0.1", "localhost")
        with connect(
            address.replace("http", "ws", 1),
            origin=address,  # type: ignore[arg-type]  # a NewType of str
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            max_size=None,
            compression=None,
            proxy=None,
        ) as connection:
            Page(connection).report_camera()
            until(viewer.server.get_clients)
            (told,) = lines_on(viewer)
            assert f"connect({address!r}, agent=" in told


def test_a_page_that_knows_the_token_has_it_in_its_lines(viewer: Viewer, runner: Runner) -> None:
    rules = Rules(token="open sesame")
    room = room_app(runner, viser_port=viewer.port, title="A room", rules=rules)
    with ServerThread(room) as server:
        with connect(
            server.url.replace("http", "ws", 1) + "?token=open%20sesame",
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            max_size=None,
            compression=None,
            proxy=None,
        ) as connection:
            Page(connection).report_camera()
            until(viewer.server.get_clients)
            (told,) = lines_on(viewer)
            assert f"connect('{server.url}?token=open%20sesame', agent=" in told
        until(lambda: not viewer.server.get_clients())
    with page(viewer):  # around the proxy, and so without having been asked
        (told,) = lines_on(viewer)
        assert "sesame" not in told


def test_they_are_those_of_the_agent_that_the_page_looks_at() -> None:
    runner = Runner(log_sim(2), seed=1)
    viewer = Viewer(runner)
    with page(viewer):
        assert "agent='a'" in lines_on(viewer)[0]
        (viewer_client,) = viewer.viewer_clients.values()
        viewer_client.agent = "b"
        assert "agent='b'" in lines_on(viewer)[0]
    viewer.stop()
