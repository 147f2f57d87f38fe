"""The tournament on the teacher's page and on the projector, with messages that a test sends."""

from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from tests.browser.wall_data import MARKUP, REFUSAL, handed_in, name_of, tournament
from tests.browser.wall_server import WallServer, wall_server
from tests.chromium import close_page, quick_page
from tests.waiting import until

pytestmark = pytest.mark.browser
GRAVE = {"serious", "critical"}


@pytest.fixture(scope="module")
def server() -> Iterator[WallServer]:
    with wall_server(8) as server:
        server.moves = False
        yield server


@pytest.fixture
def school(server: WallServer) -> WallServer:
    """Return the server of a class in which nothing has happened yet."""
    server.reset()
    return server


@pytest.fixture
def page(chromium: Browser, school: WallServer) -> Iterator[Page]:
    page = quick_page(chromium)
    page.goto(f"{school.url}teacher")
    page.get_by_role("tab", name="Tournament").click()
    yield page
    close_page(page)


def test_the_teacher_begins_starts_and_ends_a_tournament_by_keyboard(
    page: Page, school: WallServer
) -> None:
    board = page.get_by_role("tabpanel", name="Tournament")
    school.send(tournament=None, handed_in=handed_in(2))
    expect(board).to_contain_text("Handed in already: Soccer: 2 networks.")
    board.get_by_role("button", name="Tournament…").focus()
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="Tournament")
    dialog.get_by_label("Scene").select_option("soccer")
    dialog.get_by_role("button", name="Collect networks").click()
    until(lambda: school.commands[-1:] == [{"do": "tournament", "scene": "soccer"}])

    begun = {**tournament(2, "open"), "results": None}
    networks = handed_in(5)
    networks["networks"][0]["file"] = MARKUP
    school.send(tournament=begun, handed_in=networks)
    rows = board.get_by_role("row")
    expect(rows.filter(has_text=name_of(1))).to_contain_text(MARKUP)
    expect(rows.filter(has_text=name_of(3))).to_contain_text(f"refused: {REFUSAL}")
    expect(rows.filter(has_text=name_of(4))).to_contain_text("policy4.onnx (keeper)")
    expect(rows.filter(has_text=name_of(5))).to_contain_text("is being checked")
    expect(board).to_contain_text("Nothing yet from 3 students")
    board.get_by_role("button", name="Start…").click()
    dialog = page.get_by_role("dialog", name="Start the tournament")
    expect(dialog.get_by_role("status")).to_have_text("2 players: 4 games.")
    dialog.get_by_label("own player takes part").check()
    dialog.get_by_label("Matches of each pair").select_option("3")
    expect(dialog.get_by_role("status")).to_have_text("3 players: 18 games.")
    dialog.get_by_label("Neighbours in the standings").check()
    school.problem = "A tournament needs two players."
    dialog.get_by_role("button", name="Start").click()
    expect(dialog.get_by_role("alert")).to_have_text("A tournament needs two players.")
    school.problem = ""
    dialog.get_by_role("button", name="Start").click()
    expect(dialog).to_have_count(0)
    wanted = {"do": "start tournament", "seeds": 3, "system": "swiss", "own_player": True}
    assert school.commands[-1] == wanted

    school.send(tournament={**begun, "players": 0})
    expect(board).to_contain_text("0 players can play.")
    school.send(tournament={**begun, "players": 2})  # two were checked meanwhile
    expect(board).to_contain_text("2 players can play.")
    school.send(tournament=tournament(6))
    board.get_by_role("button", name="Cancel").click()
    until(lambda: school.commands[-1] == {"do": "cancel tournament"})
    game = board.get_by_role("link", name="Watch game 3").first
    expect(game).to_have_attribute("href", "./teacher/tournament/3")
    board.get_by_role("button", name="Game 3 to the projector").click()
    until(lambda: school.commands[-1] == {"do": "show", "kind": "game", "game": 3})
    board.get_by_role("button", name="Show on the projector").click()
    until(lambda: school.commands[-1] == {"do": "show", "kind": "tournament"})
    school.send(tournament=tournament(6, "over"))
    expect(board.get_by_role("link", name="Report")).to_be_visible()
    expect(board.get_by_role("table", name="Standings")).to_contain_text(name_of(6))
    found = Axe().run(page, context="#view-tournament").response["violations"]
    assert [each["id"] for each in found if each["impact"] in GRAVE] == []
    problem = 'install with: pip install "ai4u-edu[tournament]"'
    school.send(handed_in={**handed_in(0), "missing": problem})
    expect(board.get_by_role("alert")).to_have_text(problem)


def test_a_click_counts_though_a_game_ends_before_the_button_is_let_go(
    page: Page, school: WallServer
) -> None:
    page.set_viewport_size({"width": 700, "height": 900})  # one column: what ends moves the rest
    board = page.get_by_role("tabpanel", name="Tournament")
    played = tournament(6)
    school.send(tournament=played)
    board.get_by_role("button", name="Game 3 to the projector").hover()
    page.mouse.down()
    before = played["results"]
    contest = {**before["latest"][0], "problem": "One of them took too long."}
    latest = [contest, *before["latest"]]
    results = {**before, "games": before["games"] + 1, "latest": latest}
    school.send(tournament={**played, "results": results})
    expect(board).to_contain_text(f"{results['games']} of {results['total']} games")
    page.mouse.up()
    until(lambda: school.commands[-1:] == [{"do": "show", "kind": "game", "game": 3}])


def test_the_projector_shows_standings_and_the_last_match(
    chromium: Browser, school: WallServer
) -> None:
    page = quick_page(chromium, 1280, 720)
    played = tournament(7)
    played["results"]["latest"][0]["entries"][0]["name"] = MARKUP
    school.send(shown={"kind": "tournament", "room": ""}, tournament=played)
    page.goto(f"{school.url}projector")
    shown = page.get_by_role("region", name="Tournament")
    expect(shown.get_by_role("heading")).to_have_text("Tournament: Soccer")
    expect(shown).to_contain_text("21 of 42 games")
    expect(shown.get_by_role("status")).to_contain_text(f"{MARKUP} wins")
    expect(shown.get_by_role("table", name="Standings").get_by_role("row")).to_have_count(8)
    row = shown.get_by_role("row").filter(has_text=name_of(1))
    expect(row.get_by_role("cell").nth(2)).to_have_attribute(
        "title", f"{name_of(1)} against {name_of(2)}: 1 won, 0 drawn, 0 lost"
    )
    school.send(tournament=tournament(30))
    expect(shown.get_by_role("listitem")).to_have_count(30)
    found = Axe().run(page, context="#tournament").response["violations"]
    assert [each["id"] for each in found if each["impact"] in GRAVE] == []
    school.send(tournament={**tournament(2, "open"), "results": None})
    expect(shown).to_contain_text("2 players so far. Hand in your network!")
    close_page(page)
