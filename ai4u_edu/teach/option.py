"""Teaching in the page of a running world: drives, learning, networks; and the tab's commands."""

import base64
import logging
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from queue import SimpleQueue
from typing import TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.base.options import OptionTab
from ai4u_edu.blocks import LocalBrain, NeuralNetController
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.page.editing.state import reward_names
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.answers import Answer, change_answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.server.loop_queue import result_of
from ai4u_edu.page.server.web_files import web_folder
from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.recording import Episode
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.teach import messages as m
from ai4u_edu.teach.drives import FOLDER as DRIVES
from ai4u_edu.teach.drives import Drive, DriveFolder, persons_decisions
from ai4u_edu.teach.learning import ClassLearner, Learned, Learner, LocalLearner
from ai4u_edu.teach.networks import FOLDER as NETWORKS
from ai4u_edu.teach.networks import MAX_NETWORKS, KeptNetwork, NetworkFolder
from ai4u_edu.teach.practice import Practice, PracticeRequest
from ai4u_edu.teach.teachable import reason_against_teaching

T = TypeVar("T")

_logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class _SceneWork:
    """Drives and networks of one scene; replaced with every change."""

    version: int = 0
    problems: Mapping[str, str] = field(default_factory=dict)
    """Sentence about why an agent can't be taught, by its id; empty if it can."""
    drives: Mapping[str, tuple[m.TaughtDrive, ...]] = field(default_factory=dict)
    """Drives by the agent, the latest first."""
    rewards: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Names of an agent's reward terms, by its id."""
    networks: tuple[KeptNetwork, ...] = ()
    """The latest first."""
    warning: str = ""


class TeachOption:
    """Teaching of a running world's agents: the tab "Teach", its part and its commands.

    Drives and networks lie in the editor's work folder. A thread of its own reads and writes them,
    and another process learns, so that the world's thread does neither.

    Args:
        runner: runs the world.
        player: of recorded episodes; it is not needed.
        editor: has the scene; without one, or without a work folder, there is nothing to teach.
    """

    agent_parts = frozenset({"teach"})

    def __init__(
        self,
        runner: Runner,
        player: ReplayPlayer,  # noqa: ARG002 - other options need it
        editor: SceneEditor | None = None,
    ) -> None:
        self._runner, self._editor = runner, editor
        self.tab: OptionTab | None = None
        self.commands: Mapping[type[PageCommand], Handler] = {}
        self._work = _SceneWork()
        self._practice: Practice | None = None
        self._tasks = SimpleQueue[Callable[[], object] | None]()
        folder = None if editor is None else editor.work_folder
        if editor is None or folder is None:
            return
        self.tab = OptionTab("teach", "Teach", web_folder() / "teach" / "tab.js")
        self.commands = {
            m.LearnFromDrives: self._learn,
            m.StopLearning: self._stop_learning,
            m.ForgetDrive: self._forget_drive,
            m.DriveNetwork: self._drive_network,
            m.RenameNetwork: self._rename_network,
            m.DeleteNetwork: self._delete_network,
            m.DownloadNetwork: self._download_network,
        }
        self._drives = DriveFolder(folder / DRIVES)
        self._networks = NetworkFolder(folder / NETWORKS)
        trainings = editor.class_trainings
        self._learner: Learner
        if trainings is None:
            self.commands = {
                **self.commands,
                m.PractiseForRewards: self._practise,
                m.StopPractising: self._stop_practising,
            }
            self._learner = LocalLearner(
                lambda learned: self._tasks.put(partial(self._take, learned))
            )
        else:
            self._learner = ClassLearner(trainings, folder, self._take)
            trainings.listeners.append(lambda: self._tasks.put(self._learner.collect))
        editor.offer(self._offered)
        editor.listeners.append(lambda _: self._tasks.put(self._look))
        if runner.recorder is not None:
            runner.recorder.done_listeners.append(self._on_done)
        self._tasks.put(self._look)
        threading.Thread(target=self._run, name="teach", daemon=True).start()

    def panel_parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield what the page's agent can learn from, and its networks."""
        if self.tab is None or self._editor is None:
            return
        work, learning, agent = self._work, self._learner.key, view.agent
        with suppress(AI4UError):  # the world has other agents already
            driver = self._editor.driver_of(agent)
            practice = self._practice
            reached = None if practice is None else (practice.progress, practice.is_over)
            key = "teach", work.version, agent, driver, learning, practice, reached
            yield (
                "teach",
                context.cache.by_key(key, lambda: self._part(work, agent, driver)),
            )

    def picture_parts(self, pages: ViewerClients) -> list[tuple[Part, float]]:  # noqa: ARG002 - an option without a picture needs none
        """Return nothing: it draws nothing."""
        return []

    def ray_weights(self, page: ViewerClient) -> None:
        """Leave the rays as they are."""

    def stop(self) -> None:
        """End the learning and the thread."""
        if self.tab is not None:
            self._learner.close()
        if self._practice is not None:
            self._practice.stop()
        self._tasks.put(None)

    # -- in the server's event loop ----------------------------------------------------------------

    async def _learn(self, page: Page, command: m.LearnFromDrives) -> Answer:
        await self._done(lambda: self._begin_learning(page.view.agent, command.drives))
        return Answer("It learns.")

    async def _stop_learning(self, _page: Page, _command: m.StopLearning) -> Answer:
        is_stopped = await self._done(self._learner.stop)
        return Answer("The learning is stopped." if is_stopped else "Nothing learns now.")

    async def _practise(self, page: Page, command: m.PractiseForRewards) -> Answer:
        await self._done(lambda: self._begin_practice(page.view.agent, command))
        return Answer("It practises.")

    async def _stop_practising(self, _page: Page, _command: m.StopPractising) -> Answer:
        practice = self._practice
        if practice is None or practice.is_over:
            return Answer("Nothing practises now.")
        practice.stop()
        return Answer("The practice is stopped.")

    async def _forget_drive(self, _page: Page, command: m.ForgetDrive) -> Answer:
        await self._changed(lambda scene: self._drives.remove(scene, command.drive))
        return Answer(f"Drive {command.drive} is deleted.")

    async def _drive_network(self, page: Page, command: m.DriveNetwork) -> Answer:
        editor, scene = self._required_editor(), self._scene
        file = self._networks.file(scene, command.network)
        result = await page.result(editor.set_driver(page.view.agent, f"{NETWORK}{file.name}"))
        return change_answer("The network drives.", result)

    async def _rename_network(self, _page: Page, command: m.RenameNetwork) -> Answer:
        number, title = command.network, command.title
        await self._changed(lambda scene: self._networks.rename(scene, number, title))
        return Answer("The name is changed.")

    async def _delete_network(self, _page: Page, command: m.DeleteNetwork) -> Answer:
        file, editor = self._networks.file(self._scene, command.network), self._required_editor()
        drivers = {editor.driver_of(agent.id) for agent in self._runner.latest.agents}
        if f"{NETWORK}{file.name}" in drivers:
            raise SetupError("this network drives an agent; choose another driver first")
        await self._changed(lambda scene: self._networks.remove(scene, command.network))
        return Answer("The network is deleted.")

    async def _download_network(self, page: Page, command: m.DownloadNetwork) -> Answer:
        file = self._networks.file(self._scene, command.network)
        data = base64.b64encode(await page.in_thread(file.read_bytes)).decode()
        return Answer(more={"name": file.name, "data": data})

    async def _changed(self, change: Callable[[str], object]) -> None:
        """Have the thread change something of the present scene, and look again."""

        def task() -> None:
            change(self._scene)
            self._look()
            self._learner.collect()

        await self._done(task)

    async def _done(self, task: Callable[[], T]) -> T:
        """Have the thread do something, and return its result."""
        future: Future[T] = Future()

        def run() -> None:
            try:
                future.set_result(task())
            except Exception as error:
                future.set_exception(error)

        self._tasks.put(run)
        return await result_of(future)

    def _part(self, work: _SceneWork, agent: str, driver: str) -> m.TeachPart:
        practice = self._practice

        def is_driving(network: KeptNetwork) -> bool:
            with suppress(SetupError):
                return driver == f"{NETWORK}{self._networks.file(self._scene, network.number).name}"
            return False

        return m.TeachPart(
            agent=agent,
            problem=work.problems.get(agent, ""),
            drives=list(work.drives.get(agent, ())),
            learning=self._learner.state(agent),
            rewards=list(work.rewards.get(agent, ())),
            practice=(
                None
                if practice is None or practice.request.agent != agent
                else _practice_state(practice)
            ),
            networks=[
                m.TaughtNetwork(each.number, each.title, each.how, is_driving(each))
                for each in work.networks
            ],
            max_networks=MAX_NETWORKS,
            warning=work.warning,
        )

    # -- in the world's thread ---------------------------------------------------------------------

    def _on_done(self, episode: Episode) -> None:
        if not episode.restarts and any(map(persons_decisions, episode.agents)):
            self._tasks.put(partial(self._keep, episode))

    def _offered(self) -> Mapping[Path, str]:
        """Return titles of this scene's networks, by their files; any thread calls it."""
        titles = {}
        for each in self._work.networks:
            with suppress(SetupError):
                titles[self._networks.file(self._scene, each.number)] = each.title
        return titles

    # -- in the option's thread --------------------------------------------------------------------

    def _run(self) -> None:
        while (task := self._tasks.get()) is not None:
            try:
                task()
            except Exception as error:  # a block of a student's may raise anything
                _logger.warning("teaching: %s", message_of(error))

    def _keep(self, episode: Episode) -> None:
        warning = ""
        try:
            self._drives.add(episode)
        except OSError as error:
            warning = f"The last drive could not be kept: {error.strerror}."
        self._work = replace(self._work, warning=warning)
        self._look()

    def _look(self) -> None:
        """Look at the drives and networks of the present scene again."""
        editor = self._required_editor()
        scene = editor.scene
        sim = scene.build()
        sim.reset(0)
        described = export_scene(sim, scene.description)
        drives = list(reversed(self._drives.drives(scene.description.name)))
        self._work = _SceneWork(
            version=self._work.version + 1,
            problems={agent.id: reason_against_teaching(agent) for agent in sim.agents},
            drives={agent.id: tuple(_shown(drives, agent, described)) for agent in sim.agents},
            rewards={
                agent.id: reward_names(editor.state.agent(agent.id))
                for agent in sim.agents
                if editor.class_trainings is None  # a class lets no network practise yet
            },
            networks=tuple(reversed(self._networks.networks(scene.description.name))),
            warning=self._work.warning,
        )

    def _keep_network(
        self, scene: str, network: bytes, about: KeptNetwork, *, drives: bool = True
    ) -> bool:
        """Keep a network that has learned, and let it drive; return False if it can't be kept."""
        try:
            kept = self._networks.add(scene, network, about)
        except (OSError, SetupError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            self._work = replace(self._work, warning=f"The network could not be kept: {reason}.")
            self._look()
            return False
        self._work = replace(self._work, warning="")
        self._look()
        if self._scene == scene and drives:
            file = self._networks.file(scene, kept.number)
            self._required_editor().set_driver(about.agent, f"{NETWORK}{file.name}")
        return True

    def _take(self, learned: Learned) -> bool:
        """Keep a network that has learned from drives; return False if it can't be kept."""
        drives = f"{learned.drives} drive{'s' if learned.drives != 1 else ''}"
        about = KeptNetwork(
            number=0,
            title="",
            agent=learned.agent,
            how=f"learned from {drives} with {learned.decisions} decisions",
            alike=learned.alike,
        )
        return self._keep_network(learned.scene, learned.network, about)

    def _check_free(self, agent: str) -> None:
        practice = self._practice
        if self._learner.is_busy or (practice is not None and not practice.is_over):
            raise SetupError("the robot learns already; wait until it is done, or stop it")
        if problem := self._work.problems.get(agent, ""):
            raise SetupError(problem)

    def _begin_practice(self, agent: str, command: m.PractiseForRewards) -> None:
        self._check_free(agent)
        editor, begin_with = self._required_editor(), ""
        names = self._work.rewards.get(agent, ())
        if not names:
            raise SetupError("it gets no reward to practise for; add one in Build")
        if wrong := sorted(set(command.weights) - set(names)):
            raise SetupError(f"expected reward terms of {', '.join(names)}, got {wrong}")
        if command.begin_with is not None:
            begin_with = str(self._networks.file(self._scene, command.begin_with).absolute())
        folder = tempfile.TemporaryDirectory(prefix="ai4u-edu-practice-")
        scene = editor.scene
        request = PracticeRequest(
            scene=scene.dumps(),
            place=str(scene.folder or ""),
            agent=agent,
            folder=str(Path(folder.name) / "run"),
            steps=command.steps,
            seed=0,
            weights={name: each for name, each in command.weights.items() if each != 1.0},
            begin_with=begin_with,
        )
        name = scene.description.name
        self._practice = Practice(
            request,
            on_progress=partial(self._on_practised, name),
            on_end=partial(self._on_practice_end, name, folder),
        )

    def _begin_learning(self, agent: str, numbers: list[int]) -> None:
        self._check_free(agent)
        good = {each.number for each in self._work.drives.get(agent, ()) if not each.reason}
        if missing := sorted(set(numbers) - good):
            raise SetupError(f"expected drives that this robot can learn from, got {missing}")
        scene = self._scene
        files = [self._drives.file(scene, number) for number in sorted(set(numbers))]
        self._learner.begin(scene, files, agent)

    # -- in the thread of the practice -------------------------------------------------------------

    def _on_practised(self, scene: str, practice: Practice) -> None:
        """Let the network drive as it is now; whoever has taken over keeps the agent."""
        if practice.controller is not None:
            practice.controller.reload()
            return
        path = practice.run.watched_network.absolute()
        practice.controller = controller = NeuralNetController(model_path=str(path))
        brain = LocalBrain(controller=controller, **controller.network.rhythm)

        def drive() -> None:
            if self._scene == scene:
                self._runner.sim.agent(practice.request.agent).use_brain(brain)

        self._runner.submit(drive)

    def _on_practice_end(
        self, scene: str, folder: tempfile.TemporaryDirectory[str], practice: Practice
    ) -> None:
        best = practice.run.best_network
        network = best.read_bytes() if best.is_file() and practice.progress.curve else b""
        folder.cleanup()
        if not network:
            return
        checks = practice.progress.curve
        share = max((each.success or 0.0 for each in checks), default=0.0)
        reached = "" if checks[-1].success is None else f", goal reached from {share:.0%} of starts"
        how = f"practised for {practice.progress.decisions} decisions{reached}"
        about = KeptNetwork(0, "", practice.request.agent, how)
        brains = [agent.brain for agent in self._runner.sim.agents if agent.id == about.agent]
        # whoever has taken over goes on driving
        drives = any(getattr(brain, "controller", 0) is practice.controller for brain in brains)
        self._tasks.put(partial(self._keep_network, scene, network, about, drives=drives))

    @property
    def _scene(self) -> str:
        """Name of the present scene."""
        return self._required_editor().state.description.name

    def _required_editor(self) -> SceneEditor:
        assert self._editor is not None  # noqa: S101 - without one there are no commands
        return self._editor


def _shown(
    drives: list[Drive], agent: BasicAgent, scene: SceneDescription
) -> Iterator[m.TaughtDrive]:
    for drive in drives:
        record = drive.record(agent.id)
        if record is not None:
            yield m.TaughtDrive(
                number=drive.number,
                result=drive.episode.success,
                seconds=round(drive.episode.seconds, 1),
                decisions=persons_decisions(record),
                share=round(persons_decisions(record) / len(record), 3),
                reason=drive.reason_against(agent, scene),
            )


def _practice_state(practice: Practice) -> m.PracticeState:
    progress = practice.progress
    return m.PracticeState(
        is_over=practice.is_over,
        problem=practice.problem,
        decisions=progress.decisions,
        total=progress.total,
        rewards=[round(point.reward, 3) for point in progress.curve],
        success=progress.curve[-1].success if progress.curve else None,
    )
