"""Missions in the page of a running world: their part, their commands, and the map."""

import asyncio
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Literal, NamedTuple
from weakref import WeakKeyDictionary, WeakSet

import msgspec
from msgspec import Meta, Struct

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.lessons.built import BUILT, judge_built
from ai4u_edu.lessons.calls import Judged, RemoteCalls, function_name, starting_text
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, translate
from ai4u_edu.missions.checks import (
    Chooses,
    Decision,
    Driver,
    Event,
    Following,
    PersonAnswer,
    Reads,
    SeenPage,
    Solves,
    Verdict,
    decision_of,
)
from ai4u_edu.missions.mission import EMPTY_SCENES, Mission, MissionFolder, Missions
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_pictures import load_by_name
from ai4u_edu.page.messages import Name, Number, PageCommand
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.page.server.start_page import MissionsView, MissionView
from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene, SceneDescription

KEY = "mission"
MAX_ANSWER_CHARS = 200
MAX_SOURCE_CHARS, MAX_VALUE_CHARS = 20_000, 20_000
"""Length of a person's function, and of what it returned, as JSON."""
OTHER_DRIVER_DECISIONS = 24
"""Decisions (2 s) in which another driver than asked moves the robot before the page says so."""
HINT_DECISIONS = 120
"""Decisions (10 s) in which a hint counts once, however often what it is about happens."""
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


class OpenMission(PageCommand, tag="mission_open"):
    """Show a mission's step on this page, and begin to check it."""

    mission: Name
    step: Number = 0
    """From 0."""


class CloseMission(PageCommand, tag="mission_close"):
    """Show no mission on this page."""


class SeeMission(PageCommand, tag="mission_see"):
    """Tell what the person sees and does in this page."""

    tab: Name
    """Name of the open tab of the panel; empty if the panel is folded."""
    is_watching: bool = False
    """True if another page drives the robot: what it does is not this person's."""


class AnswerMission(PageCommand, tag="mission_answer"):
    """Answer the question of the step."""

    answer: Annotated[str, Meta(max_length=MAX_ANSWER_CHARS)]


class JudgeFunction(PageCommand, tag="mission_judge"):
    """Begin to check the function that this page has for the step's exercise, or its robot.

    The answer has the arguments of a call, or the verdict: ``passed``, ``text`` and ``hint``.
    """

    source: Annotated[str, Meta(max_length=MAX_SOURCE_CHARS)]
    """The person's text, from which the numbers are drawn; it is not run here."""


class FunctionReturned(PageCommand, tag="mission_returned"):
    """Tell what the function returned, as the page's Python wrote it; answered as the check is."""

    value: Annotated[str, Meta(max_length=MAX_VALUE_CHARS)]


class MissionQuestion(Struct, frozen=True):
    """A question of a step."""

    text: str
    options: list[str]
    """Answers to choose from; empty if a number has to be typed."""


class MissionExercise(Struct, frozen=True):
    """A function to write, which the page calls and the room judges; or a robot to build."""

    id: str
    function: str
    """Its name; empty for a robot."""
    text: str
    """Program to begin with."""


class MissionStar(Struct, frozen=True):
    """A star of a mission."""

    text: str
    is_earned: bool


class MissionPart(PanelPart, frozen=True, kw_only=True):
    """The mission that the page shows."""

    name: Literal["mission"] = "mission"
    mission: str
    """Its name; empty if the page shows none."""
    title: str = ""
    island: str = ""
    scene: str = ""
    """Name of its scene."""
    scene_title: str = ""
    is_here: bool = True
    """False if the world has another scene."""
    step: int = 0
    """The present step, from 0."""
    steps: int = 0
    """Number of steps."""
    say: str = ""
    """The sentence about what to do; what stands in stars is bold."""
    light: tuple[str, ...] = ()
    """Names of controls; the last one that can be seen is lit."""
    is_done: bool = False
    """True if the step is done."""
    done: str = ""
    """The sentence about what happened; empty before the step is done."""
    words: str = ""
    """Progress of the step in words; empty if there is nothing to say."""
    hint: str = ""
    """Sentence about what went wrong; empty if nothing did."""
    hints: int = 0
    """Hints in this step so far."""
    driver: str = ""
    """Sentence about another driver than the step asks for; empty if there is none."""
    question: MissionQuestion | None = None
    exercise: MissionExercise | None = None
    stars: tuple[MissionStar, ...] = ()
    """The first one is for doing the mission."""
    next: str = ""
    """Name of the mission that follows; empty after the last one."""
    next_title: str = ""


NO_MISSION = msgspec.json.encode(MissionPart(mission=""))


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
        self._following = Following(self.step.check, self._latest)
        self._hints = [Following(hint.when, self._latest) for hint in self.step.hints]
        self.hint = self.driver = ""
        """Sentences about what went wrong, and about another driver; empty if there is none."""
        self.hints = 0
        """Hints in this step so far; see :data:`HINT_DECISIONS`."""
        self._hint_at: int | None = None
        self._other_decisions = 0
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

    def see_answer(self, text: str) -> None:
        """See an answer to the question of the step."""
        self.see(PersonAnswer(text, self._latest))
        self.version += 1  # the same wrong answer is told again

    def _see_hints(self, event: Event) -> None:
        if self.is_step_done:
            self.hint = ""
            return
        for place, hint in enumerate(self.step.hints):
            self._hints[place].see(event)
            if self._hints[place].is_done:
                self.hint = hint.say
                self._count_hint()
                self._hints[place] = Following(hint.when)  # it may happen again

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
            self.driver = f"{DOES_DRIVE[decision.driver]} {HAS_TO_DRIVE[by]}"
        return False

    def _shown(self) -> tuple[object, ...]:
        stars = tuple(star.is_done for star in self._stars)
        return self.is_step_done, self.words, self.hint, self.hints, self.driver, stars


class _Chosen(NamedTuple):
    """The mission of a page, by its name: its file may be saved again."""

    name: str
    run: MissionRun


class MissionOption:
    """Missions of a running world's pages.

    The server's event loop calls it. Decisions come in the world's thread, from the events of the
    agents, which it listens to while some page has a mission.

    Args:
        runner: runs the world.
        editor: has the scene, and a teacher's folder; without one there are no missions.
    """

    agent_parts = ()
    tab = None

    def __init__(self, runner: Runner, editor: SceneEditor | None) -> None:
        self._runner, self._editor = runner, editor
        self.commands: dict[type[PageCommand], Handler] = {}
        self._sim: ControlRequestor | None = None
        """The world whose agents are listened to; of the world's thread."""
        self._runs: WeakSet[MissionRun] = WeakSet()
        """Those of open pages; of the world's thread."""
        self._calls: WeakKeyDictionary[MissionRun, RemoteCalls] = WeakKeyDictionary()
        """Exercises that are being judged; of the event loop's thread."""
        self._folder = MissionFolder(None if editor is None else editor.missions_folder)
        if editor is None:
            return
        self.commands = {
            OpenMission: self._open,
            CloseMission: self._close,
            SeeMission: self._see,
            AnswerMission: self._answer,
            JudgeFunction: self._judge,
            FunctionReturned: self._take_value,
        }
        editor.listeners.append(lambda _: self._follow())

    def panel_parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield the page's mission."""
        if self._editor is None:
            return
        chosen = self._chosen(view)
        if chosen is None:
            yield KEY, NO_MISSION
            return
        if self._sim is not self._runner.sim:  # a world that goes on from a recorded moment
            self._runner.submit(self._follow)
        missions = self._folder.missions()
        mission = missions.by_name.get(chosen.name, chosen.run.mission)
        if mission is not chosen.run.mission:  # its file was saved
            chosen = self._choose(view, chosen.name, mission, chosen.run.index)
        name, run = chosen
        key = KEY, run.token, run.version
        yield KEY, context.cache.by_key(key, lambda: mission_part(name, run, missions))

    def picture_parts(self, pages: ViewerClients) -> list[tuple[Part, float]]:  # noqa: ARG002 - an option without a picture needs none
        """Return nothing: it draws nothing."""
        return []

    def ray_weights(self, page: ViewerClient) -> None:
        """Leave the rays as they are."""

    def stop(self) -> None:
        """Do nothing: it has no thread."""

    async def _open(self, page: Page, command: OpenMission) -> Answer:
        mission = self._folder.missions().get(command.mission)
        chosen = self._chosen(page.view)
        if chosen is not None and chosen.run.mission is mission and command.step:
            run = chosen.run  # its stars are counted from the first step on
            await page.result(self._runner.submit(lambda: run.begin(command.step)))
        else:
            self._choose(page.view, command.mission, mission, command.step)
        return Answer()

    async def _close(self, page: Page, _command: CloseMission) -> Answer:
        chosen = page.view.choices.pop(KEY, None)
        if isinstance(chosen, _Chosen):
            await page.result(self._runner.submit(lambda: self._runs.discard(chosen.run)))
        return Answer()

    async def _see(self, page: Page, command: SeeMission) -> Answer:
        chosen = self._chosen(page.view)
        if chosen is not None:
            run, agent = chosen.run, page.view.agent

            def see() -> None:
                run.agent, run.is_watching = agent, command.is_watching
                run.see(SeenPage(command.tab))

            await page.result(self._runner.submit(see))
        return Answer()

    async def _answer(self, page: Page, command: AnswerMission) -> Answer:
        chosen = self._chosen(page.view)
        if chosen is None:
            raise SetupError("no mission is open in this page; open one on the map")
        run, check, answer = chosen.run, chosen.run.step.check, command.answer
        if isinstance(check, Chooses):  # the page shows and sends its own language
            shown = {translate(library_text(option)): option for option in check.options}
            answer = shown.get(answer, answer)
        await page.result(self._runner.submit(lambda: run.see_answer(answer)))
        return Answer()

    async def _judge(self, page: Page, command: JudgeFunction) -> Answer:
        chosen = self._chosen(page.view)
        if chosen is None or not isinstance(chosen.run.step.check, Solves):
            raise SetupError("this step has no function to check; open one that has")
        exercise = chosen.run.mission.exercise
        # it imports the lesson, and some judges drive a robot
        if exercise in BUILT and self._editor is not None:
            scene = Scene(self._editor.state.description)
            judged = await asyncio.to_thread(judge_built, exercise, lambda: scene.build().agents[0])
            return await self._tell(page, chosen.run, judged)
        calls = await asyncio.to_thread(RemoteCalls, exercise, command.source)
        self._calls[chosen.run] = calls
        return await self._called(page, chosen.run, calls)

    async def _take_value(self, page: Page, command: FunctionReturned) -> Answer:
        chosen = self._chosen(page.view)
        calls = None if chosen is None else self._calls.get(chosen.run)
        if chosen is None or calls is None or not calls.arguments:
            raise SetupError("no function is being checked; press Check again")
        await asyncio.to_thread(calls.answer, command.value)
        return await self._called(page, chosen.run, calls)

    async def _called(self, page: Page, run: MissionRun, calls: RemoteCalls) -> Answer:
        """Answer with the next call; or with the verdict, which the mission sees, too."""
        if calls.arguments:
            return Answer(more={"arguments": calls.arguments})
        return await self._tell(page, run, calls.judged)

    async def _tell(self, page: Page, run: MissionRun, judged: Judged) -> Answer:
        verdict = Verdict(judged.passed, judged.text)
        await page.result(self._runner.submit(lambda: run.see(verdict)))
        more = {"passed": judged.passed, "text": judged.text, "hint": judged.hint}
        return Answer(more=more)

    def _chosen(self, view: PageView) -> _Chosen | None:
        chosen = view.choices.get(KEY)
        return chosen if isinstance(chosen, _Chosen) else None

    def _choose(self, view: PageView, name: str, mission: Mission, step: int) -> _Chosen:
        run, agent = MissionRun(mission, step), view.agent
        # the first part already says so, as the page then opens the scene
        if self._editor is not None:
            run.is_here = self._editor.state.description.name == mission.scene
        chosen = _Chosen(name, run)
        view.choose(KEY, chosen, KEY)

        def begin() -> None:
            run.agent = agent
            self._runs.add(run)
            self._follow()

        self._runner.submit(begin)
        return chosen

    # -- in the world's thread ---------------------------------------------------------------------

    def _follow(self) -> None:
        """Listen to the agents of the present world, and show the scene to all missions."""
        if self._editor is None:
            return
        runs, sim, scene = list(self._runs), self._runner.sim, self._editor.state.description
        if sim is not self._sim or not runs:
            self._listen_to(sim if runs else None)
        for run in runs:
            run.see_scene(scene)

    def _listen_to(self, sim: ControlRequestor | None) -> None:
        for agent in () if self._sim is None else self._sim.agents:
            if self._on_percept in agent.percept_ready.handlers:
                agent.percept_ready.disconnect(self._on_percept)
        self._sim = sim
        for agent in () if sim is None else sim.agents:
            agent.percept_ready.connect(self._on_percept)

    def _on_percept(self, agent: BasicAgent) -> None:
        sim, runs = self._sim, list(self._runs)
        if sim is None or not runs:
            self._listen_to(None)
            return
        runs = [run for run in runs if run.counts(agent.id)]
        if runs:
            decision = decision_of(sim, agent)
            for run in runs:
                run.see(decision)


def mission_part(name: str, run: MissionRun, missions: Missions) -> MissionPart:
    """Return what a page shows of its mission.

    Args:
        name: of the mission.
        run: its state.
        missions: all of them.
    """
    mission, step, check = run.mission, run.step, run.step.check
    following = missions.after(name) if name in missions.by_name else ""
    question = None
    if isinstance(check, Chooses):
        options = [library_text(option) for option in check.options]
        question = MissionQuestion(library_text(check.question), [*options])
    elif isinstance(check, Reads):
        question = MissionQuestion(library_text(check.question), [])
    exercise = None
    if isinstance(check, Solves):
        exercise = _exercise(mission.exercise)
    texts = [_("Do the mission."), *(library_text(star.say) for star in mission.stars)]
    return MissionPart(
        mission=name,
        title=library_text(mission.title),
        island=mission.island,
        scene=mission.scene,
        scene_title=library_text(_scene_title(mission.scene)),
        is_here=run.is_here,
        step=run.index,
        steps=len(mission.steps),
        say=library_text(step.say),
        light=tuple(step.light),
        is_done=run.is_step_done,
        done=library_text(step.done) if run.is_step_done else "",
        words=run.words,
        hint=library_text(run.hint),
        hints=run.hints,
        driver=run.driver,
        question=question,
        exercise=exercise,
        stars=tuple(map(MissionStar, texts, run.stars)),
        next=following,
        next_title=library_text(missions.by_name[following].title) if following else "",
    )


def mission_map(folder: Path | None = None) -> Callable[[], MissionsView]:
    """Return a function that lists all missions for the start page.

    Args:
        folder: of a teacher; None for none.
    """
    missions = MissionFolder(folder)

    def view() -> MissionsView:
        known = missions.missions()
        listed = [
            MissionView(
                name=name,
                title=translate(library_text(mission.title)),
                island=mission.island,
                minutes=mission.minutes,
                steps=len(mission.steps),
                stars=1 + len(mission.stars),
                idea=translate(library_text(mission.idea)),
                scene=mission.scene,
            )
            for name, mission in known.by_name.items()
        ]
        return MissionsView(missions=listed, problems=list(known.problems))

    return view


def page_option(runner: Runner, _player: ReplayPlayer, editor: SceneEditor | None) -> MissionOption:
    """Return the missions of a world's pages."""
    return MissionOption(runner, editor)


@cache
def _exercise(exercise_id: str) -> MissionExercise:
    if exercise_id in BUILT:
        return MissionExercise(exercise_id, "", "")
    return MissionExercise(exercise_id, function_name(exercise_id), starting_text(exercise_id))


@cache
def _scene_title(name: str) -> str:
    scene = load_by_name(name)
    if scene is not None and name in EMPTY_SCENES:
        return scene.description.title
    return Scene.load(name).description.title or name
