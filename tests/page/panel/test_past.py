"""Recorded episodes, through the panel's socket."""

from collections.abc import Iterator

import pytest

from ai4u_edu.recording.episode import encode
from tests.page.panel.rooms import Message, PanelPage, PanelRoom, panel_room
from tests.waiting import until


@pytest.fixture
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as page:
        page.show("0", "past")
        yield page


def episode(page: PanelPage) -> int:
    """Let an episode of three decisions end, and return its number."""
    for _ in range(3):
        page.done("decision")
    before = len(page.part("past")["episodes"])
    page.done("new_start")
    part = page.part("past", lambda m: len(m["episodes"]) > before)
    return int(part["episodes"][0]["number"])


def test_episodes_are_listed_and_pinned(page: PanelPage) -> None:
    number = episode(page)
    entry = page.part("past")["episodes"][0]
    assert entry["decisions"] == 3
    assert entry["is_person"]
    assert entry["driver"] == "Keys W, A, S, D"
    assert entry["seed"] == "1"
    assert entry["end"] == "over"
    assert page.done("pin", number=number, on=True)["text"] == f"Episode {number} is kept."
    page.done("tick")
    assert page.part("past", lambda m: m["episodes"][0]["is_pinned"])
    assert "not kept any more" in page.failed("pin", number=99, on=True)["text"]


def playing(page: PanelPage, **wanted: object) -> Message:
    return page.part("past", lambda m: m["playing"] and wanted.items() <= m["playing"].items())


def test_episodes_and_titles_are_those_of_their_scene(page: PanelPage) -> None:
    number = episode(page)
    assert page.part("past")["episodes"][0]["is_here"]
    here = page.part("scene")
    page.done("open_scene", name="donut")
    donut = page.part("scene", title="Donut")
    assert donut["key"] != here["key"]
    assert donut["can_edit_goal"]
    entry = page.part("past", lambda m: not m["episodes"][-1]["is_here"])["episodes"][-1]
    assert (entry["number"], entry["scene"]) == (number, "Box chase")
    page.done("episode", number=number)
    page.done("step", step=1)
    assert not playing(page, number=number, step=1)["playing"]["is_here"]
    shown = page.part("scene", title="Box chase")
    assert (shown["goal"], shown["scene"], shown["key"]) == (here["goal"], "donut", donut["key"])
    assert not shown["can_edit_goal"]
    page.done("back_to_live")
    page.part("scene", title="Donut")


def test_the_running_episode_is_shown_again_though_nothing_has_changed(page: PanelPage) -> None:
    page.done("decision")
    page.done("episode", number=0)
    playing(page, number=0)
    page.parts.clear()
    page.done("episode", number=0)  # the page waits until it is there
    playing(page, number=0)


def test_an_episode_is_stepped_through_and_left(page: PanelPage) -> None:
    number = episode(page)
    page.done("episode", number=number)
    page.done("step", step=1)
    assert playing(page, number=number, step=1)
    part = page.part("past", is_showing=True)
    assert part["shown"]
    assert [each["format"] for each in part["downloads"]][:2] == ["html", "gif"]
    page.part("run", lambda m: m["status"].startswith("Showing "))
    page.done("back_to_live")
    page.part("past", is_showing=False)


def test_paid_lists_reward_terms_and_moments(page: PanelPage, room: PanelRoom) -> None:
    assert "choose an episode first" in page.failed("paid")["text"]
    agent = room.runner.sim.agents[0]
    agent.end_of_step.connect(lambda _: agent.add_reward(7 * (agent.steps == 2), name="found"))
    page.done("episode", number=episode(page))
    until(lambda: room.context.player.frame_cache)
    told = page.done("paid")
    found = next(each for each in told["terms"] if each["term"] == "found")
    assert (found["total"], found["curve"]) == (7, [0, 0, 7])
    assert told["moments"][0]["step"] == 2
    assert {"term": "found", "amount": 7} in told["moments"][0]["terms"]


def test_an_episode_is_played(page: PanelPage) -> None:
    number = episode(page)
    page.done("episode", number=number)
    page.done("play_speed", speed=16)
    page.done("play")
    assert playing(page, step=3, is_playing=False)


def test_the_world_goes_on_from_a_decision(page: PanelPage, room: PanelRoom) -> None:
    number = episode(page)
    page.done("episode", number=number)
    page.done("step", step=2)
    playing(page, step=2)
    page.done("continue")
    assert page.part("run", is_paused=False)
    assert room.runner.sim.world.seeds.seed == 1


def test_a_race_against_a_ghost(page: PanelPage) -> None:
    number = episode(page)
    page.done("episode", number=number)
    assert page.done("race")["text"].startswith(f"Race against episode {number}")
    assert page.part("past", ghost=f"Ghost: episode {number}")
    page.part("run", seed="1", is_paused=False)
    page.done("remove_ghost")
    page.part("past", ghost="")


def test_a_recording_is_opened(page: PanelPage, room: PanelRoom) -> None:
    episode(page)
    recorder = room.runner.recorder
    assert recorder is not None
    data = encode(recorder.episodes[0])
    page.socket.send(data)
    done = page.done("open_recording", name="friend.episode", size=len(data))
    page.part("past", lambda m: m["episodes"][0]["source"] == "friend.episode")
    assert playing(page, number=done["number"])
    page.socket.send(b"nonsense")
    assert "friend.episode" in page.failed("open_recording", name="friend.episode", size=8)["text"]


def test_commands_without_a_chosen_episode_are_refused(page: PanelPage) -> None:
    for command in ("play", "continue", "race"):
        assert page.failed(command)["text"] == "choose an episode first"
