"""Teaching in the page of a running world: drives, learning, networks; and the tab's commands."""

import base64
import logging
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from queue import SimpleQueue
from types import MappingProxyType
from typing import TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.base.options import SMALL_TRAINER, OptionTab, load_option
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
from ai4u_edu.teach.drives import Drive, DriveFolder, persons_decisions
from ai4u_edu.teach.learning import Learning
from ai4u_edu.teach.networks import MAX_NETWORKS, KeptNetwork, NetworkFolder
from ai4u_edu.teach.practice import Phase, Practice, PracticeFolder, PracticeRequest
from ai4u_edu.teach.teachable import reason_against_teaching
from ai4u_edu.teach.tries import TryingPages

T = TypeVar("T")

OPPONENTS = {None: "", "player": " against the scene's player", "self": " against itself"}
"""Player of the other side in a practice, in words."""

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
    opponents: Mapping[str, Sequence[m.Opponent]] = field(default_factory=dict)
    """Possible opponents of an agent in a practice, by its id."""
    networks: tuple[KeptNetwork, ...] = ()
    """The latest first."""
    scene_name: str = ""
    scene_text: str = ""
    warning: str = ""


class TeachOption:
    """Teaching of a running world's agents: the tab "Teach", its part and its commands.

    Drives, networks and practices lie in the editor's work folder. A thread of its own reads and
    writes them, and another process learns, so that the world's thread does neither.

    Args:
        runner: runs the world.
        player: shows episodes of a practice.
        editor: has the scene; without one, or without a work folder, there is nothing to teach.
    """

    agent_parts = frozenset({"teach", "tries"})

    def __init__(
        self,
        runner: Runner,
        player: ReplayPlayer,
        editor: SceneEditor | None = None,
    ) -> None:
        self._runner, self._player, self._editor = runner, player, editor
        self.tab: OptionTab | None = None
        self.commands: dict[type[PageCommand], Handler] = {}
        self._work = _SceneWork()
        self._learning: Learning | None = None
        self._practice: Practice | None = None
        self._replays: dict[tuple[Path, int], int] = {}
        """Numbers of episodes in the archive, by their file and its time."""
        self._tasks = SimpleQueue[Callable[[], object] | None]()
        folder = None if editor is None else editor.work_folder
        if editor is None or folder is None:
            return
        self.tab = OptionTab("teach", "Teach", web_folder() / "teach" / "tab.js")
        self.commands = {
            m.LearnFromDrives: self._learn,
            m.StopLearning: self._stop_learning,
            m.PractiseForRewards: self._practise,
            m.PutRewards: self._put_rewards,
            m.PausePractising: self._pause_practising,
            m.GoOnPractising: self._go_on_practising,
            m.StopPractising: self._stop_practising,
            m.ForgetDrive: self._forget_drive,
            m.DriveNetwork: self._drive_network,
            m.RenameNetwork: self._rename_network,
            m.DeleteNetwork: self._delete_network,
            m.DownloadNetwork: self._download_network,
            m.ReplayPractice: self._replay_practice,
        }
        self._tries = TryingPages(runner, editor, self._done)
        self.commands |= self._tries.commands
        self._drives = DriveFolder(folder / "drives")
        self._networks = NetworkFolder(folder / "networks")
        self._practices = PracticeFolder(folder / "practices")
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
        work, learning, agent = self._work, self._learning, view.agent
        with suppress(AI4UError):  # the world has other agents already
            driver = self._editor.driver_of(agent)
            practice = self._practice
            progress = None if learning is None else (len(learning.errors), learning.is_over)
            reached = None if practice is None else (practice.progress, practice.phase)
            key = "teach", work.version, agent, driver, learning, progress, practice, reached
            yield (
                "teach",
                context.cache.by_key(key, lambda: self._part(work, agent, driver)),
            )
            yield from self._tries.parts(context, agent)

    def picture_parts(self, pages: ViewerClients) -> list[tuple[Part, float]]:  # noqa: ARG002 - an option without a picture needs none
        """Return nothing: it draws nothing."""
        return []

    def ray_weights(self, page: ViewerClient) -> None:
        """Leave the rays as they are."""

    def stop(self) -> None:
        """End the learning and the thread; a practice can go on later."""
        if self._learning is not None:
            self._learning.stop()
        if self.tab is not None:
            self._tries.stop()
        self._tasks.put(self._leave_practice)
        self._tasks.put(None)

    # -- in the server's event loop ----------------------------------------------------------------

    async def _learn(self, page: Page, command: m.LearnFromDrives) -> Answer:
        await self._done(lambda: self._begin_learning(page.view.agent, command.drives))
        return Answer("It learns.")

    async def _stop_learning(self, _page: Page, _command: m.StopLearning) -> Answer:
        learning = self._learning
        if learning is None or learning.is_over:
            return Answer("Nothing learns now.")
        learning.stop()
        return Answer("The learning is stopped.")

    async def _practise(self, page: Page, command: m.PractiseForRewards) -> Answer:
        await self._done(lambda: self._begin_practice(page.view.agent, command))
        return Answer("It practises.")

    async def _put_rewards(self, page: Page, command: m.PutRewards) -> Answer:
        factors = {name: factor for name, factor in command.weights.items() if factor != 1.0}
        if not factors:
            raise SetupError("all factors are 1, as the scene has them; choose another one first")
        editor = self._required_editor()
        result = await page.result(editor.scale_rewards(page.view.agent, factors))
        return change_answer("The scene pays so now.", result)

    async def _pause_practising(self, _page: Page, _command: m.PausePractising) -> Answer:
        if self._practice is None or self._practice.phase is not Phase.RUNNING:
            return Answer("Nothing practises now.")
        self._practice.pause()
        return Answer("The practice is paused.")

    async def _go_on_practising(self, _page: Page, _command: m.GoOnPractising) -> Answer:
        await self._done(self._go_on)
        return Answer("It practises.")

    async def _stop_practising(self, _page: Page, _command: m.StopPractising) -> Answer:
        practice = self._practice
        if practice is None or practice.phase is Phase.OVER:
            return Answer("Nothing practises now.")
        await self._done(practice.stop)
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

    async def _replay_practice(self, page: Page, command: m.ReplayPractice) -> Answer:
        player = self._player
        file = self._networks.replay(self._scene, command.network, command.decisions)
        if player.archive is None or not file.is_file():
            raise SetupError("this episode of the practice is not kept any more")
        key = file, file.stat().st_mtime_ns
        number = self._replays.get(key)
        if number is None or player.archive.find(number) is None:
            episode = await page.in_thread(lambda: Episode.load(file))
            source = f"network {command.network} after {command.decisions:,} decisions"
            number = self._replays[key] = player.archive.append(episode, source).number
        player.open(number, page.view.agent)
        player.play()
        return Answer()

    async def _changed(self, change: Callable[[str], object]) -> None:
        """Have the thread change something of the present scene, and look again."""

        def task() -> None:
            change(self._scene)
            self._look()

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
        learning, practice = self._learning, self._practice

        def is_driving(network: KeptNetwork) -> bool:
            with suppress(SetupError):
                return driver == f"{NETWORK}{self._networks.file(self._scene, network.number).name}"
            return False

        return m.TeachPart(
            agent=agent,
            problem=work.problems.get(agent, ""),
            drives=list(work.drives.get(agent, ())),
            learning=None if learning is None or learning.agent != agent else _state_of(learning),
            rewards=list(work.rewards.get(agent, ())),
            opponents=list(work.opponents.get(agent, ())),
            practice=None if practice is None else self._practice_state(practice, work, agent),
            decisions_per_s=None if practice is None else practice.decisions_per_s,
            networks=[
                m.TaughtNetwork(
                    network.number,
                    network.title,
                    network.how,
                    network.made_at,
                    list(network.facts),
                    list(network.replays),
                    is_driving(network),
                )
                for network in work.networks
            ],
            max_networks=MAX_NETWORKS,
            warning=work.warning,
        )

    def _practice_state(
        self, practice: Practice, work: _SceneWork, agent: str
    ) -> m.PracticeState | None:
        progress, request, speed = practice.progress, practice.request, practice.decisions_per_s
        is_here = (request.agent, request.scene_name) == (agent, work.scene_name)
        if practice.phase is Phase.OVER and not is_here:
            return None
        return m.PracticeState(
            phase=practice.phase.value,
            problem=practice.problem,
            elsewhere="" if is_here else f"agent {request.agent} of {request.scene_name}",
            is_scene_changed=is_here and request.scene != work.scene_text,
            hint=practice.hint,
            seconds_left=speed and (progress.total - progress.decisions) / speed,
            decisions=progress.decisions,
            total=progress.total,
            rewards=[round(point.reward, 3) for point in progress.curve],
            success=progress.curve[-1].success if progress.curve else None,
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
        self._tries.look()
        scene = editor.scene
        sim = scene.build()
        sim.reset(0)
        described = export_scene(sim, scene.description)
        drives = list(reversed(self._drives.drives(scene.description.name)))
        kinds_of_opponents = load_option(SMALL_TRAINER, "teaching").kinds_of_opponents
        self._work = _SceneWork(
            version=self._work.version + 1,
            problems={agent.id: reason_against_teaching(agent) for agent in sim.agents},
            drives={agent.id: tuple(_shown(drives, agent, described)) for agent in sim.agents},
            rewards={agent.id: reward_names(editor.state.agent(agent.id)) for agent in sim.agents},
            opponents=kinds_of_opponents(scene, sim),
            networks=tuple(reversed(self._networks.networks(scene.description.name))),
            scene_name=scene.description.name,
            scene_text=scene.dumps(),
            warning=self._work.warning,
        )
        if self._scene == scene.description.name:  # else another one was opened meanwhile
            self._find_practice(scene.description.name)

    def _find_practice(self, scene: str) -> None:
        """Offer to go on with a practice of the present scene that an earlier process began."""
        practice = self._practice
        if practice is not None and (
            practice.phase is Phase.RUNNING or practice.request.scene_name == scene
        ):
            return
        self._leave_practice()
        self._practice = self._practices.find(scene, self._make_practice)

    def _leave_practice(self) -> None:
        practice, self._practice = self._practice, None
        if practice is not None and practice.phase is not Phase.OVER:
            practice.leave()

    def _keep_network(
        self,
        scene: str,
        network: bytes,
        about: KeptNetwork,
        replays: Mapping[int, bytes] = MappingProxyType({}),
        *,
        drives: bool = True,
    ) -> None:
        """Keep a network that has learned, and let it drive."""
        try:
            kept = self._networks.add(scene, network, about, replays)
        except (OSError, SetupError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            self._work = replace(self._work, warning=f"The network could not be kept: {reason}.")
            self._look()
            return
        self._work = replace(self._work, warning="")
        self._look()
        if self._scene == scene and drives:
            file = self._networks.file(scene, kept.number)
            self._required_editor().set_driver(about.agent, f"{NETWORK}{file.name}")

    def _check_free(self, agent: str) -> None:
        is_practising = self._practice is not None and self._practice.phase is Phase.RUNNING
        if is_practising or (self._learning is not None and not self._learning.is_over):
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
        if self._practice is not None and self._practice.phase is Phase.PAUSED:
            raise SetupError("a practice is paused; go on with it, or stop it first")
        if len(self._work.networks) >= MAX_NETWORKS:
            raise SetupError(
                f"this scene has {MAX_NETWORKS} networks already; delete one that you do not need"
            )
        against, opponent = self._opponent(agent, command)
        scene = editor.scene
        request = PracticeRequest(
            scene=scene.dumps(),
            scene_name=scene.description.name,
            place=str(scene.folder or ""),
            agent=agent,
            steps=command.steps,
            seed=0,
            weights={name: each for name, each in command.weights.items() if each != 1.0},
            begin_with=begin_with,
            against=against,
            opponent=opponent,
        )
        try:
            folder, request = self._practices.add(scene.description.name, request)
        except OSError as error:
            raise SetupError(f"the practice could not be begun: {error.strerror}") from None
        self._practice = self._make_practice(folder, request)
        self._practice.go_on()

    def _make_practice(self, folder: Path, request: PracticeRequest) -> Practice:
        return Practice(
            folder, request, on_progress=self._on_practised, on_end=self._on_practice_end
        )

    def _go_on(self) -> None:
        practice = self._practice
        if practice is None or practice.phase is not Phase.PAUSED:
            raise SetupError("there is no practice that could go on; begin another one")
        self._check_free(practice.request.agent)
        practice.go_on()

    def _opponent(self, agent: str, command: m.PractiseForRewards) -> tuple[str, str]:
        """Return who plays the other side, for the practice and in words."""
        if command.against and command.against not in self._work.opponents.get(agent, ()):
            raise SetupError("nobody can play against this robot in that way here; choose another")
        if command.against != "file":
            return command.against or "", OPPONENTS[command.against]
        number = command.opponent
        if number is None:
            raise SetupError("expected the network to play against; choose one")
        path = self._networks.file(self._scene, number).absolute()
        titles = {each.number: each.title for each in self._work.networks}
        return str(path), f" against {titles.get(number, f'Network {number}')}"

    def _begin_learning(self, agent: str, numbers: list[int]) -> None:
        self._check_free(agent)
        good = {each.number for each in self._work.drives.get(agent, ()) if not each.reason}
        if missing := sorted(set(numbers) - good):
            raise SetupError(f"expected drives that this robot can learn from, got {missing}")
        scene = self._scene
        files = [self._drives.file(scene, number) for number in sorted(set(numbers))]
        self._learning = Learning(
            files,
            agent,
            seed=0,
            on_done=lambda learning, out: self._on_learned(scene, learning, out),
        )

    # -- in the thread of the learning -------------------------------------------------------------

    def _on_learned(self, scene: str, learning: Learning, out: Path) -> None:
        note = learning.note
        drives = f"{learning.drives} drive{'s' if learning.drives != 1 else ''}"
        about = KeptNetwork(
            number=0,
            title="",
            agent=learning.agent,
            how=f"learned from {drives} with {note.decisions} decisions",
            alike=note.alike,
            facts=(
                f"Alike in {note.alike:.0%} of {note.held_out} moments that it had not seen.",
                "Seed: 0.",
            ),
        )
        self._tasks.put(partial(self._keep_network, scene, out.read_bytes(), about))

    # -- in the thread of the practice -------------------------------------------------------------

    def _on_practised(self, practice: Practice) -> None:
        """Let the network drive as it is now; whoever has taken over keeps the agent."""
        if practice.controller is not None:
            practice.controller.reload()
            return
        path = practice.run.watched_network.absolute()
        practice.controller = controller = NeuralNetController(model_path=str(path))
        brain = LocalBrain(controller=controller, **controller.network.rhythm)

        def drive() -> None:
            if self._scene == practice.request.scene_name:
                self._runner.sim.agent(practice.request.agent).use_brain(brain)

        self._runner.submit(drive)

    def _on_practice_end(self, practice: Practice) -> None:
        best = practice.run.best_network
        network = best.read_bytes() if best.is_file() and practice.progress.curve else b""
        replays = practice.replays()
        practice.remove()
        if not network:
            return
        checks = practice.progress.curve
        share = max((each.success or 0.0 for each in checks), default=0.0)
        reached = "" if checks[-1].success is None else f", goal reached from {share:.0%} of starts"
        how = (
            f"practised for {practice.progress.decisions} decisions"
            f"{practice.request.opponent}{reached}"
        )
        about = KeptNetwork(0, "", practice.request.agent, how, facts=practice.facts)
        brains = [agent.brain for agent in self._runner.sim.agents if agent.id == about.agent]
        # whoever has taken over goes on driving
        drives = any(getattr(brain, "controller", 0) is practice.controller for brain in brains)
        scene = practice.request.scene_name
        self._tasks.put(partial(self._keep_network, scene, network, about, replays, drives=drives))

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


def _state_of(learning: Learning) -> m.LearningState:
    note = learning.note
    return m.LearningState(
        is_over=learning.is_over,
        problem=note.problem,
        errors=[round(error, 4) for _, error in learning.errors],
        drives=learning.drives,
        decisions=note.decisions,
        alike=round(note.alike, 3),
        commonest=round(note.commonest, 3),
        remarks=list(note.remarks),
    )
