"""The tab in which the past is gone back to: kept episodes, and a slider through one of them."""

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
from ai4u_edu.viewer.backend.reporting import reporting
from ai4u_edu.viewer.panel.notify import notify_failure
from ai4u_edu.viewer.panel.readings import block
from ai4u_edu.viewer.panel.tabs import TabKind
from ai4u_edu.viewer.panel.uploads import limit_uploads, take_file
from ai4u_edu.viewer.replay.episode_list import FORMATS, downloads, listed
from ai4u_edu.viewer.replay.ghosts import Ghosts
from ai4u_edu.viewer.replay.replay_player import NOW, ReplayPlayer
from ai4u_edu.viewer.viewer_client import ViewerClient

NONE, UNDER_WAY = "choose one", "this one, so far"
BACK, PLAY, STOP, ON = "Step back", "Play", "Stop", "Step on"
NOW_AGAIN, GO_ON, RACE = "Back to now", "Continue here", "Race it"
BARE = block(kind="bare")
SPEEDS = {"0.25x": 0.25, "0.5x": 0.5, "1x": 1.0, "2x": 2.0, "4x": 4.0}


class ReplayTab:
    """One page's way into the past; all pages see the same moment of it.

    Args:
        viewer_client: the page.
        runner: continues episodes.
        player: shows their moments.
        ghosts: of episodes that are raced.
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
        self._seen: tuple[object, ...] = ()
        self._numbers: dict[str, int] = {}
        self.table = gui.add_html("")
        self.episode = gui.add_dropdown("Episode", (NONE, UNDER_WAY))
        self.step = gui.add_slider("Moment", 1, 2, 1, 1, visible=False)
        self.told = gui.add_html(BARE)
        self.step_buttons = gui.add_button_group("Go", (BACK, PLAY, ON), visible=False)
        self._speed = gui.add_dropdown("Pace", tuple(SPEEDS), initial_value="1x", visible=False)
        gui.add_html(BARE)
        self.actions = gui.add_button_group("Then", (NOW_AGAIN, GO_ON, RACE), visible=False)
        self.no_ghost = gui.add_button("No ghost", visible=False)
        self.links = gui.add_html("")
        hint = "An .episode file, of a friend's or your own"
        self.upload = gui.add_upload_button("Open a recording", hint=hint)
        limit_uploads(self.client, MAX_FILE_BYTES)
        self.episode.on_update(self._on_episode)
        self.step.on_update(self._on_step)
        self.step_buttons.on_click(self._on_steps)
        self._speed.on_update(self._on_speed)
        self.actions.on_click(self._on_verb)
        self.no_ghost.on_click(self._on_nobody)
        self.upload.on_upload(reporting(self._on_upload))

    def draw(self, snapshot: Snapshot) -> None:
        """Shows what there is, what was chosen, and which moment is seen."""
        player, archive = self._player, self._player.archive
        entries = archive.entries if archive is not None else ()
        seen = (entries, player.number)
        if seen != self._seen:
            self._seen = seen
            self._offer(entries)
        self._follow(snapshot)

    def _offer(self, entries: tuple[ArchiveEntry, ...]) -> None:
        """Lists the episodes, and marks the one that was chosen."""
        chosen = self._player.number
        archive = self._player.archive
        best = archive.best if archive is not None and len(entries) > 1 else None
        self.table.content = listed(entries, chosen, best)
        numbers = {str(entry.number): entry.number for entry in reversed(entries)}
        self._numbers = {UNDER_WAY: NOW} | numbers
        options = (NONE, *self._numbers)
        if self.episode.options != options:
            self.episode.options = options
        name = next((name for name, each in self._numbers.items() if each == chosen), NONE)
        if self.episode.value != name:
            self.episode.value = name  # type: ignore[misc]  # a method parts getter from setter
        is_kept = chosen in numbers.values()
        formats = [each for each in FORMATS if each != "mp4" or has("imageio_ffmpeg")]
        self.links.content = downloads(chosen, formats) if is_kept and chosen else ""

    def _follow(self, snapshot: Snapshot) -> None:
        """Shows the moment that is wanted, whoever wanted it."""
        player, frame_cache = self._player, self._player.frame_cache
        recorder = self._runner.recorder
        there = frame_cache is not None and frame_cache.last >= 0
        for handle in (self.step, self.step_buttons, self._speed, self.actions):
            handle.visible = there
        if frame_cache is not None and there:
            # people count from 1; the end comes after the last step
            last, step = max(frame_cache.last, 1) + 1, player.step + 1
            if self.step.max != last:
                self.step.max = last
            if self.step.value != step:
                self.step.value = step  # type: ignore[misc]
        options = (BACK, STOP if player.playing else PLAY, ON)
        if self.step_buttons.options != options:
            self.step_buttons.options = options
        self.no_ghost.visible = bool(self._ghosts.name)
        told = [
            snapshot.past and f"Seen now: {snapshot.past}",
            escape(player.problem or (frame_cache.problem if frame_cache is not None else "")),
            self._ghosts.told(snapshot),
            escape(recorder.problem or recorder.save_problem) if recorder is not None else "",
        ]
        lines = "<br>".join(f"<small>{each}</small>" for each in told if each)
        self.told.content = block(lines, kind="bare")

    # -- what people ask for; in viser's loop, one after the other -------------------------------

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

    async def _on_verb(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        player = self._player
        match event.target.value:
            case "Back to now" if player.is_showing:
                notify_failure(self.client, self._runner, player.back())
            case "Continue here":
                notify_failure(self.client, self._runner, await asyncio.to_thread(player.go_on))
            case "Race it" if player.frame_cache is not None:
                frame_cache = player.frame_cache
                player.leave()
                self._ghosts.race(frame_cache.episode, f"episode {frame_cache.number}")
                notify_failure(
                    self.client, self._runner, self._runner.reset(frame_cache.episode.seed)
                )
                notify_failure(self.client, self._runner, self._runner.resume())

    async def _on_nobody(self, _event: GuiEvent[GuiButtonHandle]) -> None:
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
    """The tab for the past."""
    return TabKind("Past", lambda viewer_client: ReplayTab(viewer_client, runner, player, ghosts))
