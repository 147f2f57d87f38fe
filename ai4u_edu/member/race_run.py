"""A race of a class in one world."""

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import Any

from ai4u_edu.base.errors import AI4UError, shorten, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.assigned_scenes import OPEN_TIMEOUT_S, AssignedScenes
from ai4u_edu.member.class_view import ClassView
from ai4u_edu.member.episode_watch import EndedEpisode, EpisodeWatch
from ai4u_edu.member.holds import Holds
from ai4u_edu.member.room_state import WINS
from ai4u_edu.recording import Episode, RecordingError
from ai4u_edu.recording.episode import decode
from ai4u_edu.recording.scene_export import export_scene, without_brains
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.class_link import Applied, CurrentRace
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

ShowGhosts = Callable[[Sequence[tuple[Episode, str]]], object]
"""Shows the ghosts of episodes under their drivers' names, in place of those before."""


class RaceRun:
    """Takes a world to a race's start, holds it there, and says which episodes count.

    One thread calls it.

    Args:
        runner: runs the world.
        scenes: opens the race's scene.
        watch: has the recorded episodes.
        holds: of the world.
        view: what pages show.
        show_ghosts: shows the best drives so far.
        clock: seconds.
        open_timeout: time (s) that the world has to open the race's scene.
    """

    def __init__(
        self,
        runner: Runner,
        scenes: AssignedScenes,
        watch: EpisodeWatch,
        holds: Holds,
        view: ClassView,
        show_ghosts: ShowGhosts,
        clock: Callable[[], float],
        open_timeout: float = OPEN_TIMEOUT_S,
    ) -> None:
        self._runner, self._scenes, self._watch, self._holds = runner, scenes, watch, holds
        self._view, self._show_ghosts, self._clock = view, show_ghosts, clock
        self._open_timeout = open_timeout
        self._race: CurrentRace | None = None
        """The race that runs here; None for none."""
        self._track: list[Any] = []
        """The scene's parts that determine an episode."""
        self._starts_at = -math.inf
        self._is_started = self._is_late = False
        self._was_locked = False
        self._best = math.inf
        self._best_of = ""
        self._ghosts: tuple[bytes, ...] = ()

    def update(self, race: CurrentRace, starts_at: float) -> Applied | None:
        """Follow the class's race.

        Args:
            race: the message.
            starts_at: time of the clock (s) at which it starts.

        Returns:
            An answer if the race can't run here.
        """
        answer = None
        if not race.id or race.phase == "over":
            self.stop()
        elif self._race is None or self._race.id != race.id:
            self.stop()
            answer = self._prepare(race, starts_at)
        else:
            self._race, self._starts_at = race, starts_at
            self._holds.for_race(starts_at)
        if self._race is not None:
            self._show_best(self._race)
        if race.id != self._best_of:
            self._best_of, self._best = race.id, math.inf
        if race.own_best > 0:  # of an earlier process, say
            self._best = min(self._best, race.own_best)
        is_shown = bool(race.id) and answer is None
        self._view.set_race(race if is_shown else None, starts_at, self._own_best())
        return answer

    def poll(self) -> None:
        """Start the race when it is time, and keep its seed."""
        race = self._race
        if race is None:
            return
        if not self._is_started:
            if self._clock() < self._starts_at:
                return
            self._is_started = True
            self._holds.refresh()
            if not self._is_late:  # else nobody may be there: the first key starts it
                self._runner.start_episode()
        if self._runner.latest.seed != race.seed:
            self._runner.submit(lambda: self._restore_seed(race))

    def id_of(self, ended: EndedEpisode, word: str) -> str:
        """Return the race's id if an episode counts there; empty otherwise."""
        race, episode = self._race, ended.recorded
        if race is None or episode is None or not self._is_started or ended.seed != race.seed:
            return ""
        is_whole = episode.changed is None and not episode.restarts and not episode.cut
        if not is_whole or without_brains(episode.scene) != self._track:
            return ""
        if word in WINS and ended.seconds < self._best:
            self._best = ended.seconds
            self._view.set_race(race, self._starts_at, self._own_best())
        return race.id

    def stop(self) -> None:
        """End the race here: other seeds are drawn again, and no ghost is shown."""
        if self._race is None:
            return
        self._race = None
        self._watch.has_recordings = False
        self._holds.for_race(-math.inf)
        self._runner.lock_seed(self._was_locked)
        self._show_ghosts(())
        self._ghosts = ()

    def _prepare(self, race: CurrentRace, starts_at: float) -> Applied | None:
        self._is_late = starts_at <= self._clock()
        self._holds.for_race(starts_at)
        self._was_locked = self._runner.latest.is_seed_locked
        try:
            self._track = self._scenes.open_race(race.id, race.scene, race.seed)
            self._race, self._starts_at, self._is_started = race, starts_at, False
            self._runner.submit(lambda: self._go_to_start(race)).result(self._open_timeout)
        except (AI4UError, TimeoutError) as error:
            self._race = None
            self._holds.for_race(-math.inf)
            return Applied(
                race.id, shorten(_("the race: {problem}", problem=text_of(error)), MAX_TEXT_CHARS)
            )
        self._watch.has_recordings = True
        return None

    def _go_to_start(self, race: CurrentRace) -> None:
        """Go to the race's start and repeat it, unless another scene is open.

        In the world's thread.
        """
        sim = self._runner.sim
        if self._race is race and without_brains(export_scene(sim)) == self._track:
            sim.is_seed_locked = True
            if sim.world.seeds.seed != race.seed or sim.world.ticks:
                sim.reset(race.seed)

    def _restore_seed(self, race: CurrentRace) -> None:
        """Go back to the race's seed; in the world's thread."""
        if self._runner.sim.world.seeds.seed != race.seed:
            self._go_to_start(race)

    def _own_best(self) -> float | None:
        return None if math.isinf(self._best) else round(self._best, 2)

    def _show_best(self, race: CurrentRace) -> None:
        if race.ghosts == self._ghosts:
            return
        self._ghosts = race.ghosts
        drives = []
        for place, recorded in enumerate(race.ghosts):
            name = race.board[place].name if place < len(race.board) else f"place {place + 1}"
            with suppress(RecordingError):  # of another version, say; the race goes on without it
                drives.append((decode(Episode, recorded, "ghost"), name))
        self._show_ghosts(drives)
