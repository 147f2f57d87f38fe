"""Missions in the page of a running world: their part, their commands, and the map."""

import asyncio
from collections.abc import Callable, Iterator
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
from ai4u_edu.missions.checks import Chooses, Reads, Solves
from ai4u_edu.missions.events import SeenPage, Verdict, decision_of
from ai4u_edu.missions.mission import EMPTY_SCENES, Mission, MissionFolder, Missions
from ai4u_edu.missions.run import MissionRun
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
from ai4u_edu.scenes import Scene

KEY = "mission"
MAX_ANSWER_CHARS = 200
MAX_WAY_CHARS = 20
MAX_SOURCE_CHARS, MAX_VALUE_CHARS = 20_000, 20_000
"""Length of a person's function, and of what it returned, as JSON."""


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
    way: Annotated[str, Meta(max_length=MAX_WAY_CHARS)] = ""
    """``python`` or ``blocks``, as the program in the tab "Code" is written; empty before."""
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
                run.see(SeenPage(command.tab, command.way))

            await page.result(self._runner.submit(see))
        return Answer()

    async def _answer(self, page: Page, command: AnswerMission) -> Answer:
        chosen = self._chosen(page.view)
        if chosen is None:
            raise SetupError(_("no mission is open in this page; open one on the map"))
        run, check, answer = chosen.run, chosen.run.step.check, command.answer
        if isinstance(check, Chooses):  # the page shows and sends its own language
            shown = {translate(library_text(option)): option for option in check.options}
            answer = shown.get(answer, answer)

        def see() -> None:
            # the page shows numbers before the first decision, too, while it waits for a key
            sim = self._runner.sim
            agents = [agent for agent in sim.agents if run.counts(agent.id)]
            run.see_answer(answer, decision_of(sim, agents[0]) if agents else None)

        await page.result(self._runner.submit(see))
        return Answer()

    async def _judge(self, page: Page, command: JudgeFunction) -> Answer:
        chosen = self._chosen(page.view)
        if chosen is None or not isinstance(chosen.run.step.check, Solves):
            raise SetupError(_("this step has no function to check; open one that has"))
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
            raise SetupError(_("no function is being checked; press Check again"))
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
