"""A mission that a person does: where they are in it, what went wrong, and their stars."""

from collections.abc import Mapping

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.missions.check import Following
from ai4u_edu.missions.events import Decision, Driver, Event, PersonAnswer, SeenPage
from ai4u_edu.missions.mission import Mission
from ai4u_edu.scenes import SceneDescription

OTHER_DRIVER_DECISIONS = 24
"""Decisions (2 s) in which another driver than asked moves the robot before the page says so."""
HINT_DECISIONS = 120
"""Decisions (10 s) in which a hint counts once, however often what it is about happens."""
HINT_SHOWN_DECISIONS = 120
"""Decisions (10 s) after which a hint goes away, if what it is about has not happened again."""
MOVING_M_PER_S = 0.1
HAS_TO_DRIVE: Mapping[str, str] = {
    "keys": _("This step is for *you*: let go of the program, or choose keys again, and drive."),
    "program": _("This step is for *your program*: open *Code* and press *Run*."),
    "network": _("This step is for a *network*."),
    "new network": _("This step is for a *new* network: see *Learn* and *Practise*."),
    "controller": _("This step is for a driver that comes with the scene."),
}
DOES_DRIVE: Mapping[Driver, str] = {
    "keys": _("You are driving with the keys."),
    "program": _("A program is driving."),
    "network": _("A network is driving."),
    "controller": _("Another driver is driving."),
}


class MissionRun:
    """A mission that one person does: the checks of the present step, its hints and the stars.

    It belongs to the world's thread; another one may read what a page shows.

    Args:
        mission: the mission.
        step: the step to begin with, from 0.
    """

    def __init__(self, mission: Mission, step: int = 0) -> None:
        self.mission = mission
        self.token = object()
        """Key of caches, which must not keep this mission of a page that has left."""
        self.agent = ""
        """Id of the agent whose decisions count; empty for any."""
        self.is_watching = False
        """True while another page drives: then no decision counts."""
        self.is_here = True
        """True while the world has the mission's scene."""
        self.version = 0
        """Grows with every change that a page shows."""
        self._latest: Decision | None = None
        self._first: Decision | None = None
        """First decision of the present episode, if one driver alone has driven in it so far."""
        self._page = SeenPage("")
        self._scene: SceneDescription | None = None
        self._networks: set[str] = set()
        """Files of networks that have driven so far."""
        self._old_networks: frozenset[str] = frozenset()
        """Those that had when the present step began."""
        self._stars = [Following(star.check) for star in mission.stars]
        self._other_decisions = 0
        self._decisions = 0
        """Decisions so far."""
        self.begin(step)

    def begin(self, step: int) -> None:
        """Begin a step; of what was before, only what is still so counts.

        Args:
            step: from 0; the last one if there are fewer.
        """
        self.index = min(step, len(self.mission.steps) - 1)
        self.step = self.mission.steps[self.index]
        # who has driven this episode from its start may go on with it
        first = self._first
        is_asked = first is not None and self.step.by in ("anyone", first.driver)
        self._following = Following(self.step.check, self._latest, first if is_asked else None)
        self._hints = [Following(hint.when, self._latest) for hint in self.step.hints]
        self.hint = self.driver = ""
        """Sentences about what went wrong, and about another driver; empty if there is none."""
        self.hints = 0
        """Hints in this step so far; see :data:`HINT_DECISIONS`."""
        self._hint_at: int | None = None
        self._hint_age = self._hint_ends = 0
        """Decisions, and ends of episodes, since what the hint is about has happened."""
        self._other_decisions = 0
        latest = self._latest
        self._old_episode = latest.episode if latest and latest.driver == "program" else None
        self._old_networks = frozenset(self._networks)
        self._following.see(self._page)
        if self._scene is not None:
            self._following.see(self._scene)
        self.version += 1

    @property
    def is_step_done(self) -> bool:
        """True if the present step is done."""
        return self._following.is_done

    @property
    def is_done(self) -> bool:
        """True if the last step is done."""
        return self.is_step_done and self.index == len(self.mission.steps) - 1

    @property
    def words(self) -> str:
        """Progress of the step in words; empty if there is nothing to say."""
        return self._following.words

    @property
    def stars(self) -> list[bool]:
        """True for each star that is earned; the first one is for the end."""
        return [self.is_done, *(self.is_done and star.is_done for star in self._stars)]

    def counts(self, agent: str) -> bool:
        """Return True if the decisions of an agent count now."""
        return self.is_here and not self.is_watching and self.agent in ("", agent)

    def see(self, event: Event) -> None:
        """Let step, hints and stars see an event."""
        before = self._shown()
        if isinstance(event, SeenPage):
            self._page = event
        elif isinstance(event, Decision):
            self._latest = event
            self._note_first(event)
            self._decisions += 1
            self._networks.add(event.network)
        if not isinstance(event, Decision) or self._is_asked_driver(event):
            self._following.see(event)
            for star in self._stars:
                star.see(event)
            self._see_hints(event)
        self.version += self._shown() != before

    def see_scene(self, scene: SceneDescription) -> None:
        """See the present scene, which may be another mission's."""
        self.version += self.is_here != (scene.name == self.mission.scene)
        self.is_here = scene.name == self.mission.scene
        if self.is_here:
            self._scene = scene
            self.see(scene)

    def see_answer(self, text: str, now: Decision | None = None) -> None:
        """See an answer to the question of the step.

        Args:
            text: the answer.
            now: what the robot senses at this moment; by default at the latest decision.
        """
        self.see(PersonAnswer(text, now or self._latest))
        self.version += 1  # the same wrong answer is told again

    def _see_hints(self, event: Event) -> None:
        if self.is_step_done:
            self.hint = ""
            return
        if self.step.by == "program" and self._is_old_episode():
            return  # the program of the step before still runs, while the person changes it
        if isinstance(event, Decision):
            self._hint_age += 1
            self._hint_ends += bool(event.outcome)
            if self._is_hint_over(event):
                self.hint = ""
        for place, hint in enumerate(self.step.hints):
            self._hints[place].see(event)
            if self._hints[place].is_done:
                self.hint, self._hint_age, self._hint_ends = hint.say, 0, 0
                self._count_hint()
                self._hints[place] = Following(hint.when)  # it may happen again

    def _is_hint_over(self, decision: Decision) -> bool:
        """Return True if the hint is about an episode before this one, or no longer so."""
        starts: int | None = getattr(self.step.check, "of", None)
        if starts is not None:  # a test of many starts is over before anybody has read it
            return self._hint_ends >= starts
        return bool(decision.outcome) or self._hint_age > HINT_SHOWN_DECISIONS

    def _note_first(self, decision: Decision) -> None:
        first = self._first
        if decision.step <= 1:
            self._first = decision
        elif first is not None and (
            decision.outcome or (first.episode, first.driver) != (decision.episode, decision.driver)
        ):
            self._first = None

    def _is_old_episode(self) -> bool:
        return self._latest is not None and self._latest.episode == self._old_episode

    def _count_hint(self) -> None:
        if self._hint_at is None or self._decisions - self._hint_at >= HINT_DECISIONS:
            self.hints += 1
            self._hint_at = self._decisions

    def _is_asked_driver(self, decision: Decision) -> bool:
        """Return True if the step asks for the driver of a decision; note it otherwise."""
        by = self.step.by
        if by == "new network":
            is_asked = decision.driver == "network" and decision.network not in self._old_networks
        else:
            is_asked = by in ("anyone", decision.driver)
        if is_asked or self.is_step_done:
            self._other_decisions, self.driver = 0, ""
            return True
        self._other_decisions += abs(decision.speed) > MOVING_M_PER_S
        if self._other_decisions >= OTHER_DRIVER_DECISIONS:
            self.driver = join([DOES_DRIVE[decision.driver], HAS_TO_DRIVE[by]])
        return False

    def _shown(self) -> tuple[object, ...]:
        stars = tuple(star.is_done for star in self._stars)
        return self.is_step_done, self.words, self.hint, self.hints, self.driver, stars
