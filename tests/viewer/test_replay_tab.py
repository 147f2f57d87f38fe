"""The "Past" tab: its list, its widgets, and uploads from untrusted pages."""

from collections.abc import Iterator

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.recording import Archive, Recorder
from ai4u_edu.recording.file import encode
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.uploads import limit_uploads
from ai4u_edu.viewer.replay.episode_list import download_links, episode_table, short_brain_title
from ai4u_edu.viewer.replay.replay_tab import ReplayTab
from tests.recording.recorded_drives import take
from tests.viewer.pages import Page, page, seen, shown, tabs_of, until


@pytest.fixture
def runner() -> Iterator[Runner]:
    """A world that stands; one episode of it is kept."""
    scene = Scene.load("box_chase")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [0.1, 0.3, 0, 0]}))
    recorder = Recorder(sim, scene=scene.description, episodes=Archive())
    runner = Runner(sim, seed=5, recorder=recorder)
    for _ in range(20):
        sim.step()
    sim.reset(6)
    runner.paused = True
    runner.start()
    yield runner
    runner.stop()


@pytest.fixture
def viewer(runner: Runner) -> Iterator[Viewer]:
    viewer = Viewer(runner)
    yield viewer
    viewer.stop()


def tab_of(viewer: Viewer) -> ReplayTab:
    """The tab of the only page, as it is now."""
    viewer.viewer_clients.refresh()
    shown(viewer)
    (tab,) = tabs_of(viewer, ReplayTab)
    return tab


def opened(viewer: Viewer, here: Page) -> ReplayTab:
    """The tab, in which episode 1 was chosen."""
    tab = tab_of(viewer)
    here.change(tab.episode, "1")
    until(lambda: viewer.player.number == 1)
    frame_cache = viewer.player.frame_cache
    assert frame_cache is not None
    until(lambda: frame_cache.snapshot(frame_cache.last) is not None)
    seen(viewer, lambda: tab.step.visible)
    return tab


def test_it_lists_what_is_kept(viewer: Viewer) -> None:
    with page(viewer):
        tab = tab_of(viewer)
        assert tab.episode.options == ("choose one", "this one, so far", "1")
        assert "<th>1</th><td>5</td><td>1.7 s</td>" in tab.table.content
        assert not tab.step.visible
        assert tab.links.content == ""


def test_the_slider_moves_what_all_see(viewer: Viewer, runner: Runner) -> None:
    with page(viewer) as here:
        tab = opened(viewer, here)
        assert (tab.step.visible, tab.step.max, tab.step.value) == (True, 21, 1)
        assert 'href="api/past/1.episode"' in tab.links.content
        here.change(tab.step, 8)
        until(lambda: runner.latest.past == "episode 1, step 8 of 20")
        here.change(tab.step_buttons, "Step back")
        until(lambda: runner.latest.past == "episode 1, step 7 of 20")
        shown(viewer)
        assert tab.step.value == 7
        assert "Seen now: episode 1, step 7 of 20" in tab.status.content
        with page(viewer):  # whoever comes later sees the same
            until(lambda: len(viewer.server.get_clients()) == 2)
            viewer.viewer_clients.refresh()
            shown(viewer)
            assert [each.step.value for each in tabs_of(viewer, ReplayTab)] == [7, 7]
        here.change(tab.actions, "Back to now")
        until(lambda: runner.latest.past == "")
        assert runner.latest.seed == 6


def test_it_continues(viewer: Viewer, runner: Runner) -> None:
    with page(viewer) as here:
        tab = opened(viewer, here)
        here.change(tab.step, 8)
        here.change(tab.actions, "Continue here")
        until(lambda: not runner.paused and runner.latest.seed == 5 and runner.latest.tick > 35)


def test_a_race_begins_with_the_same_seed(viewer: Viewer, runner: Runner) -> None:
    with page(viewer) as here:
        tab = opened(viewer, here)
        here.change(tab.actions, "Race it")
        until(lambda: runner.latest.seed == 5 and not runner.paused)
        shown(viewer)
        assert viewer.ghosts.text(runner.latest) == "Ghost: episode 1"
        assert tab.no_ghost.visible
        here.press(tab.no_ghost)
        until(lambda: viewer.ghosts.text(runner.latest) == "")


def send(
    here: Page, tab: ReplayTab, name: str, content: bytes, declared: int | None = None
) -> None:
    size = len(content) if declared is None else declared
    uuid = tab.upload._impl.uuid
    here.say(
        "FileTransferStartUpload",
        source_component_uuid=uuid,
        transfer_uuid=name,
        filename=name,
        mime_type="",
        part_count=1,
        size_bytes=size,
    )
    if not content:  # it has only begun
        return
    here.say(
        "FileTransferPart",
        source_component_uuid=uuid,
        transfer_uuid=name,
        part_index=0,
        content=content,
    )


def test_a_friends_recording_is_taken(viewer: Viewer) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        send(here, tab, "<friend>.episode", encode(take("donut", decisions=9).episode))
        until(lambda: viewer.player.number == 2)
        shown(viewer)
        assert "<td>&lt;friend&gt;.episode</td>" in tab.table.content
        assert viewer.player.archive is not None
        entry = viewer.player.archive.find(2)
        assert entry is not None
        assert entry.episode.scene.name == "donut"


def test_what_is_no_recording_or_too_large_is_refused(
    viewer: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        told: list[str] = []

        def note(title: str, body: str, **_: object) -> None:
            told.append(f"{title}: {body}")

        monkeypatch.setattr(tab.client, "add_notification", note)
        send(here, tab, "x.pickle", b"cos\nsystem\n(S'x'\ntR.")
        until(lambda: len(told) == 1)
        assert told[0].startswith("That is no recording: x.pickle: expected a recorded episode")
        send(here, tab, "big", b"x", declared=17 * 2**20)
        until(lambda: len(told) == 2)
        assert told[1] == "That file can't be taken: expected at most 16 MB"
        send(here, tab, "liar", b"x" * 5000, declared=10)
        until(lambda: len(told) == 3)
        assert told[2] == "That file can't be taken: it is larger than it said"
        assert not tab.client.gui._current_file_upload_states
        limit_uploads(tab.client, 2**30)  # another tab takes larger files
        send(here, tab, "big", b"", declared=17 * 2**20)
        until(lambda: tab.client.gui._current_file_upload_states or len(told) > 3)
        assert len(told) == 3


def test_the_table_marks_what_was_chosen_and_shortens_what_is_long() -> None:
    archive = Archive()
    for _ in range(2):
        archive.append(take("box_chase", seed=2**40, decisions=3).episode)
    html = episode_table(archive.entries, 2)
    assert html.index("<th>2</th>") < html.index("<th>1</th>")
    assert '<tr class="chosen" aria-current="true"><th>2</th><td>109951…</td>' in html
    assert "<th>1 <b" in episode_table(archive.entries, 2, archive.entries[0])
    assert "Every episode is kept here" in episode_table((), None)
    assert [
        short_brain_title(each) for each in ("LocalBrain(WASDRBMoveController)", "Recording", "")
    ] == [
        "WASDRBMove",
        "Recording",
        "",
    ]
    assert download_links(3, ["csv"]).count("href") == 1


def test_without_a_recorder_there_is_no_such_tab() -> None:
    viewer = Viewer(Runner(Scene.load("box_chase").build(), seed=1))
    with page(viewer):
        viewer.viewer_clients.refresh()
        shown(viewer)
        assert tabs_of(viewer, ReplayTab) == []
    viewer.stop()


def test_files_have_an_ending_for_each_format() -> None:
    from ai4u_edu.server.past import RECORDING, WRITERS
    from ai4u_edu.viewer.replay.episode_list import FORMATS

    assert set(FORMATS) == {RECORDING, *WRITERS}
