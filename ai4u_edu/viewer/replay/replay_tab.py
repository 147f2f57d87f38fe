"""The "Past" tab: the recorded episodes, and a slider through the decisions of one."""

import asyncio
from html import escape

from viser import (
    GuiButtonGroupHandle,
    GuiButtonHandle,
    GuiDropdownHandle,
    GuiEvent,
    GuiSliderHandle,
    GuiUploadButtonHandle,
)

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.optional_deps import has
from ai4u_edu.recording import ArchiveEntry, Episode
from ai4u_edu.recording.file import MAX_FILE_BYTES, decode
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.viewer.backend.reporting import report_errors
from ai4u_edu.viewer.panel.html_parts import section
from ai4u_edu.viewer.panel.notify import notify_failure
from ai4u_edu.viewer.panel.tabs import TabKind
from ai4u_edu.viewer.panel.uploads import limit_uploads, take_file
from ai4u_edu.viewer.panel.widgets import set_options, set_value
from ai4u_edu.viewer.replay.episode_list import FORMATS, download_links, episode_table
from ai4u_edu.viewer.replay.ghosts import Ghosts
from ai4u_edu.viewer.replay.replay_player import RUNNING_EPISODE, ReplayPlayer
from ai4u_edu.viewer.viewer_client import ViewerClient

NONE, RUNNING = "choose one", "this one, so far"
BACK, PLAY, STOP, ON = "Step back", "Play", "Stop", "Step on"
BACK_TO_NOW, GO_ON, RACE = "Back to now", "Continue here", "Race it"
BARE = section(kind="bare")
SPEEDS = {"0.25x": 0.25, "0.5x": 0.5, "1x": 1.0, "2x": 2.0, "4x": 4.0}


class ReplayTab:
    """The "Past" tab of one page; all pages share the player.

    Args:
        viewer_client: the page.
        runner: resets and resumes the world.
        player: shows the episodes.
        ghosts: draws the ghost of an episode in the running world.
    """

    def __init__(
        self, viewer_client: ViewerClient, runner: Runner, player: ReplayPlayer, ghosts: Ghosts
    ) -> None:
        gui = viewer_client.client.gui
        self._viewer_client, self.client, self._runner = (
            viewer_client,
            viewer_client.client,
            runner,
        )
        self._player, self._ghosts = player, ghosts
        self._listed: tuple[object, ...] = ()
        self._numbers: dict[str, int] = {}
        self.table = gui.add_html("")
        self.episode = gui.add_dropdown("Episode", (NONE, RUNNING))
        self.step = gui.add_slider("Moment", 1, 2, 1, 1, visible=False)
        self.status = gui.add_html(BARE)
        self.step_buttons = gui.add_button_group("Go", (BACK, PLAY, ON), visible=False)
        self._speed = gui.add_dropdown("Pace", tuple(SPEEDS), initial_value="1x", visible=False)
        gui.add_html(BARE)
        self.actions = gui.add_button_group("Then", (BACK_TO_NOW, GO_ON, RACE), visible=False)
        self.no_ghost = gui.add_button("No ghost", visible=False)
        self.links = gui.add_html("")
        hint = "An .episode file, of a friend's or your own"
        self.upload = gui.add_upload_button("Open a recording", hint=hint)
        limit_uploads(self.client, MAX_FILE_BYTES)
        self.episode.on_update(self._on_episode)
        self.step.on_update(self._on_step)
        self.step_buttons.on_click(self._on_steps)
        self._speed.on_update(self._on_speed)
        self.actions.on_click(self._on_action)
        self.no_ghost.on_click(self._on_no_ghost)
        self.upload.on_upload(report_errors(self._on_upload))

    def draw(self, snapshot: Snapshot) -> None:
        """Show the episodes, the chosen one, and the shown decision."""
        player, archive = self._player, self._player.archive
        entries = archive.entries if archive is not None else ()
        state = (entries, player.number)
        if state != self._listed:
            self._listed = state
            self._list_episodes(entries)
        self._show_player(snapshot)

    def _list_episodes(self, entries: tuple[ArchiveEntry, ...]) -> None:
        """List the episodes, with the chosen one marked."""
        chosen = self._player.number
        archive = self._player.archive
        best = archive.best if archive is not None and len(entries) > 1 else None
        self.table.content = episode_table(entries, chosen, best)
        numbers = {str(entry.number): entry.number for entry in reversed(entries)}
        self._numbers = {RUNNING: RUNNING_EPISODE} | numbers
        set_options(self.episode, (NONE, *self._numbers))
        name = next((name for name, each in self._numbers.items() if each == chosen), NONE)
        set_value(self.episode, name)
        is_kept = chosen in numbers.values()
        formats = [each for each in FORMATS if each != "mp4" or has("imageio_ffmpeg")]
        self.links.content = download_links(chosen, formats) if is_kept and chosen else ""

    def _show_player(self, snapshot: Snapshot) -> None:
        """Show the player's state, which any page may have changed."""
        player, frame_cache = self._player, self._player.frame_cache
        recorder = self._runner.recorder
        has_frames = frame_cache is not None and frame_cache.last >= 0
        for handle in (self.step, self.step_buttons, self._speed, self.actions):
            handle.visible = has_frames
        if frame_cache is not None and has_frames:
            # the slider counts from 1, and has the end after the last decision
            last = max(frame_cache.last, 1) + 1
            if self.step.max != last:
                self.step.max = last
            set_value(self.step, player.step + 1)
        set_options(self.step_buttons, (BACK, STOP if player.is_playing else PLAY, ON))
        self.no_ghost.visible = bool(self._ghosts.name)
        texts = [
            snapshot.past and f"Seen now: {snapshot.past}",
            escape(player.problem or (frame_cache.problem if frame_cache is not None else "")),
            escape(self._ghosts.text(snapshot)),
            escape(recorder.problem or recorder.save_problem) if recorder is not None else "",
        ]
        lines = "<br>".join(f"<small>{each}</small>" for each in texts if each)
        self.status.content = section(lines, kind="bare")

    # -- events; in viser's event loop, one after the other --------------------------------------

    async def _on_episode(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        number = self._numbers.get(event.target.value)
        if event.client is not None and number is not None:
            self._player.open(number, self._viewer_client.agent)

    async def _on_step(self, event: GuiEvent[GuiSliderHandle[int]]) -> None:
        if event.client is not None and self._player.frame_cache is not None:
            self._player.go_to(int(event.target.value) - 1)

    async def _on_steps(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        match event.target.value:
            case "Step back":
                self._player.move(-1)
            case "Step on":
                self._player.move(1)
            case "Play" | "Stop" as word:
                self._player.play(on=word == PLAY)

    async def _on_speed(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        self._player.speed = SPEEDS.get(event.target.value, 1.0)

    async def _on_action(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        player = self._player
        match event.target.value:
            case "Back to now" if player.is_showing:
                notify_failure(self.client, self._runner, player.return_to_present())
            case "Continue here":
                notify_failure(
                    self.client, self._runner, await asyncio.to_thread(player.continue_from_here)
                )
            case "Race it" if player.frame_cache is not None:
                frame_cache = player.frame_cache
                player.cancel()
                self._ghosts.race(frame_cache.episode, f"episode {frame_cache.number}")
                notify_failure(
                    self.client, self._runner, self._runner.reset(frame_cache.episode.seed)
                )
                notify_failure(self.client, self._runner, self._runner.resume())

    async def _on_no_ghost(self, _event: GuiEvent[GuiButtonHandle]) -> None:
        self._ghosts.race(None)

    async def _on_upload(self, event: GuiEvent[GuiUploadButtonHandle]) -> None:
        file, archive = take_file(event), self._player.archive
        if archive is None:
            return
        try:
            episode = await asyncio.to_thread(decode, Episode, file.content, file.name[:80])
        except AI4UError as error:
            self.client.add_notification("That is no recording", str(error))
            return
        self._player.open(archive.append(episode, file.name[:80]).number)


def replay_tab(runner: Runner, player: ReplayPlayer, ghosts: Ghosts) -> TabKind:
    """Return the "Past" tab."""
    return TabKind("Past", lambda viewer_client: ReplayTab(viewer_client, runner, player, ghosts))
