"""A program travels with the link to its scene: offered in the tab "Code", never run by itself."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from ai4u_edu.page.editing.sharing import read_shared, shared_link
from ai4u_edu.scenes import Scene
from tests.browser.code_tab import PROGRAM, CodePage
from tests.browser.fake_code import serve_fakes
from tests.browser.plain_page import WITHOUT_VISER
from tests.browser.served_viser import connected
from tests.browser.test_panel_accessibility import findings
from tests.browser.wall_data import MARKUP
from tests.chromium import new_page
from tests.playing import Played, played
from tests.waiting import until

pytestmark = pytest.mark.browser

SHARED = f"# {MARKUP} é 🤖\ndef decide(percept):\n    return {{}}\n"
FRAGMENT = shared_link(Scene.load("maze"), 77).fragment
MAKE = """async ([fragment, source]) => {
  const { withProgram } = await import("./web/scenes/program_link.js");
  return withProgram(fragment, { agent: "0", source }).catch((error) => error.message);
}"""
READ = """async (link) => {
  const { programIn } = await import("./web/scenes/program_link.js");
  return programIn(link).catch((error) => error.message);
}"""


@pytest.fixture(scope="module")
def opened(chromium: Browser) -> Iterator[CodePage]:
    with CodePage.opened(chromium) as tab:
        yield tab


def with_program(page: Page, source: str = SHARED) -> str:
    found: str = page.evaluate(MAKE, [FRAGMENT, source])
    return found


def test_a_link_holds_the_program_and_the_server_reads_its_scene(opened: CodePage) -> None:
    link = with_program(opened.page)
    assert opened.page.evaluate(READ, f"http://host/#{link}") == {"agent": "0", "source": SHARED}
    assert opened.page.evaluate(READ, f"#{FRAGMENT}") is None
    assert read_shared(link) == (Scene.load("maze"), 77)


def test_strange_programs_in_links_are_refused(opened: CodePage) -> None:
    page = opened.page
    link = with_program(page)
    for bad in (link.replace("&program=", "&program=x"), link.replace("&agent", "AAAA&agent")):
        assert "damaged" in page.evaluate(READ, bad)
    for data in ("", "%3Cscript%3E", "A" * 60_001):
        assert "damaged" in page.evaluate(READ, f"#{FRAGMENT}&program={data}&agent=0")
    assert "too large" in with_program(page, "x" * 100_001)
    bomb = """async () => {
      const bytes = new Uint8Array(20e6);
      const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
      const packed = new Uint8Array(await new Response(stream).arrayBuffer());
      const text = btoa(packed.reduce((all, each) => all + String.fromCharCode(each), ""));
      return text.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
    }"""
    assert "damaged" in page.evaluate(READ, f"#{FRAGMENT}&program={page.evaluate(bomb)}&agent=0")


def keep(tab: CodePage, **changes: Any) -> None:
    program = {"scene": "box_chase", "agent": "0", "source": SHARED} | changes
    module = "import('./web/scenes/shared_program.js')"
    tab.page.evaluate(f"each => {module}.then(({{ keepShared }}) => keepShared(each))", program)


def test_the_offer_replaces_nothing_until_it_is_taken(opened: CodePage) -> None:
    offer = opened.page.get_by_role("group", name="A shared program")
    opened.write(PROGRAM)
    for other in ({"scene": "maze"}, {"agent": "1"}, {"source": 7}):
        keep(opened, **other)
        expect(offer).to_be_hidden()
    keep(opened)
    expect(offer).to_contain_text("The link brought a program of 3 lines.")
    offer.get_by_text("Read it").click()
    expect(offer.get_by_label("The shared program")).to_have_text(SHARED)
    assert findings(opened.page, ".ai4u-code-shared") == []
    assert opened.text == PROGRAM
    offer.get_by_role("button", name="No, thanks").click()
    expect(offer).to_be_hidden()
    assert opened.text == PROGRAM

    keep(opened)
    offer.get_by_role("button", name="Take it").click()
    expect(offer).to_be_hidden()
    assert opened.text == SHARED
    opened.page.get_by_label("Earlier runs").select_option(index=1)
    assert opened.text == PROGRAM
    assert opened.calls("load") == []


def test_from_one_page_to_another(
    chromium: Browser, tmp_path_factory: pytest.TempPathFactory
) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        with played("maze", "--seed", "5") as server:
            page = new_page(chromium, permissions=["clipboard-read", "clipboard-write"])
            link = copied(page, server)
            assert read_shared(link) == (Scene.load("maze"), 5)
            page.goto(f"{server.url}start")  # forgets nothing, and leads to the world
            page.evaluate("localStorage.clear()")
            page.evaluate("hash => (location.hash = hash)", link.partition("#")[2])
            question = page.get_by_role("dialog", name="Open the shared scene “Maze”?")
            expect(question).to_contain_text("It contains a program")
            sent: list[str] = []
            page.on("request", lambda request: sent.append(request.post_data or ""))
            question.get_by_role("button", name="Open").click()
            page.wait_for_url(server.url)
            connected(page)
            page.get_by_role("tab", name="Code").click()
            offer = page.get_by_role("group", name="A shared program")
            expect(offer).to_be_visible()
            editor = page.get_by_role("textbox", name="Program in Python")
            expect(editor).not_to_contain_text(MARKUP)
            offer.get_by_role("button", name="Take it").click()
            expect(editor).to_contain_text(MARKUP)
            assert page.evaluate("(window.fake?.calls ?? []).length") == 0, "nothing ran"
            assert any("scene=" in each for each in sent)
            assert not any("program=" in each for each in sent)
            page.context.close()


def copied(page: Page, server: Played) -> str:
    """Write a program in a page, and return the link that is copied there."""
    serve_fakes(page)
    WITHOUT_VISER.serve(page, server.url)
    page.goto(server.url)
    connected(page)
    until(lambda: server.health()["scene"] == "Maze")
    page.get_by_role("tab", name="Code").click()
    editor = page.get_by_role("textbox", name="Program in Python")
    expect(editor).to_contain_text("def ")  # it would take the place of what is written
    editor.click()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.insert_text(SHARED)
    page.get_by_role("button", name="Copy link", exact=True).last.click()
    expect(page.get_by_text("Link copied.")).to_be_visible()
    found: str = page.evaluate("navigator.clipboard.readText()")
    return found
