"""Teaching in the page of a running world: drives, learning, networks; and the tab's commands."""

import asyncio
import base64
import logging
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from queue import SimpleQueue
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import TypeVar

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError, SetupError, shown, text_of
from ai4u_edu.base.options import OptionTab
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, ngettext
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.driver_options import OWN_BRAIN
from ai4u_edu.page.editing.drivers import NETWORK
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
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.teach import messages as m
from ai4u_edu.teach.drives import FOLDER as DRIVES
from ai4u_edu.teach.drives import DriveFolder, persons_decisions
from ai4u_edu.teach.learning import ClassLearner, Learned, Learner, LocalLearner
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.networks import FOLDER as NETWORKS
from ai4u_edu.teach.networks import (
    HANDED_OUT,
    MAX_NETWORKS,
    MAX_TITLE_CHARS,
    KeptNetwork,
    NetworkFolder,
)
from ai4u_edu.teach.opened_network import MAX_WALL_S, OpenRequest, open_network
from ai4u_edu.teach.practices import Practices
from ai4u_edu.teach.scene_work import SceneWork
from ai4u_edu.teach.tasks import FOLDER as TASKS
from ai4u_edu.teach.tasks import ClassTask, LocalTask, TaskWork
from ai4u_edu.teach.tries import TryingPages
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES

T = TypeVar("T")

_logger = logging.getLogger(__name__)


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
        self.work = SceneWork()
        """Drives and networks of the present scene."""
        self._opened: tuple[str, TaskWork | None] = "", None
        """Name of the file that another process opens now, and its work once it has begun."""
        self._openings: set[asyncio.Task[object]] = set()
        self._tasks = SimpleQueue[Callable[[], object] | None]()
        folder = None if editor is None else editor.work_folder
        if editor is None or folder is None:
            return
        self.tab = OptionTab("teach", _("Teach"), web_folder() / "teach" / "tab.js")
        self.commands = {
            m.LearnFromDrives: self._learn,
            m.StopLearning: self._stop_learning,
            m.ForgetDrive: self._forget_drive,
            m.DriveNetwork: self._drive_network,
            m.RenameNetwork: self._rename_network,
            m.DeleteNetwork: self._delete_network,
            m.DownloadNetwork: self._download_network,
            m.OpenNetwork: self._open_network,
        }
        self._drives = DriveFolder(folder / DRIVES)
        self._networks = NetworkFolder(folder / NETWORKS)
        self._learner: Learner
        self._practices = Practices(runner, player, editor, self._networks, folder, self)
        self.commands |= self._practices.commands
        self._tries = TryingPages(runner, editor, folder, self.done)
        self.commands |= self._tries.commands
        self._tasks_folder = folder / TASKS
        trainings = editor.class_trainings
        if trainings is None:
            self._learner = LocalLearner(lambda learned: self.put(partial(self._take, learned)))
        else:
            self._learner = ClassLearner(trainings, folder, self._take)
            trainings.listeners.append(lambda: self.put(self._collect))
        self._handed_out = NetworkFolder(folder / HANDED_OUT)
        editor.offer(self._offered)
        editor.listeners.append(lambda _: self.put(self._look))
        if runner.recorder is not None:
            runner.recorder.done_listeners.append(self._on_done)
        self.put(self._tries.find)
        self.put(self._look)
        threading.Thread(target=self._run, name="teach", daemon=True).start()

    def panel_parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield what the page's agent can learn from, and its networks."""
        if self.tab is None or self._editor is None:
            return
        work, agent = self.work, view.agent
        with suppress(AI4UError):  # the world has other agents already
            driver = self._editor.driver_of(agent)
            reached = self._learner.key, self._practices.key, self._opening_sentence
            key = "teach", work.version, agent, driver, *reached
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
        if self.tab is not None:
            self._learner.close()
            self._tries.leave()
            _, work = self._opened
            if work is not None:
                work.leave()
            self.put(self._practices.leave)
        self._tasks.put(None)

    def put(self, task: Callable[[], object]) -> None:
        """Have the option's thread do something."""
        self._tasks.put(task)

    async def done(self, task: Callable[[], T]) -> T:
        """Have the option's thread do something, and return its result."""
        future: Future[T] = Future()

        def run() -> None:
            try:
                future.set_result(task())
            except Exception as error:
                future.set_exception(error)

        self.put(run)
        return await result_of(future)

    # -- in the server's event loop ----------------------------------------------------------------

    async def _learn(self, page: Page, command: m.LearnFromDrives) -> Answer:
        await self.done(lambda: self._begin_learning(page.view.agent, command.drives))
        return Answer(_("It learns."))

    async def _stop_learning(self, _page: Page, _command: m.StopLearning) -> Answer:
        is_stopped = await self.done(self._learner.stop)
        return Answer(_("The learning is stopped.") if is_stopped else _("Nothing learns now."))

    async def _forget_drive(self, _page: Page, command: m.ForgetDrive) -> Answer:
        await self._changed(lambda scene: self._drives.remove(scene, command.drive))
        return Answer(_("Drive {drive} is deleted.", drive=command.drive))

    async def _drive_network(self, page: Page, command: m.DriveNetwork) -> Answer:
        editor, scene = self._required_editor(), self._scene
        file = self._networks.file(scene, command.network)
        result = await page.result(editor.set_driver(page.view.agent, f"{NETWORK}{file.name}"))
        return change_answer(_("The network drives."), result)

    async def _rename_network(self, _page: Page, command: m.RenameNetwork) -> Answer:
        number, title = command.network, command.title
        await self._changed(lambda scene: self._networks.rename(scene, number, title))
        return Answer(_("The name is changed."))

    async def _delete_network(self, page: Page, command: m.DeleteNetwork) -> Answer:
        file, editor = self._networks.file(self._scene, command.network), self._required_editor()
        agents = [agent.id for agent in self._runner.latest.agents]
        driven = [agent for agent in agents if editor.driver_of(agent) == f"{NETWORK}{file.name}"]
        if driven and not command.even_if_driving:
            raise SetupError(_("this network drives an agent; choose another driver first"))
        for agent in driven:
            await page.result(editor.set_driver(agent, f"{OWN_BRAIN}0"))
        await self._changed(lambda scene: self._networks.remove(scene, command.network))
        return Answer(_("The network is deleted."))

    async def _open_network(self, page: Page, command: m.OpenNetwork) -> Answer:
        data, agent = page.upload.take(command.size), page.view.agent
        scene = self._scene
        if self._opened[0]:
            raise SetupError(_("another file is being opened; wait until that is done"))
        self._opened = command.name, None
        how = _("opened from the file {name}", name=command.name)
        about = KeptNetwork(0, Path(command.name).stem[:MAX_TITLE_CHARS], agent, how)

        async def open_and_keep() -> None:
            try:
                score = await asyncio.to_thread(self._score_opened, command.name, data, agent)
            finally:
                self._opened = "", None
            kept = replace(about, score=score)
            if not await self.done(lambda: self.keep_network(scene, data, kept, drives=False)):
                raise SetupError(self.work.warning)

        # a page that closes, or comes back, while others are before it does not end it
        task = asyncio.create_task(open_and_keep())
        self._openings.add(task)
        task.add_done_callback(self._note_opened)
        await asyncio.shield(task)
        return Answer(_("Opened {title}.", title=about.title))

    def _note_opened(self, task: asyncio.Task[object]) -> None:
        self._openings.discard(task)
        if not task.cancelled():
            task.exception()  # its page has heard of it, or is gone

    def _score_opened(self, name: str, data: bytes, agent: str) -> NetworkScore | None:
        """Have another process check a network, and return its score; a thread does it.

        Raises:
            SetupError: it can't drive here; a sentence about why.
        """
        trainings = self._required_editor().class_trainings
        scene = self._required_editor().scene
        try:
            if trainings is not None:
                self._tasks_folder.mkdir(parents=True, exist_ok=True)
            within = None if trainings is None else self._tasks_folder
            with TemporaryDirectory(prefix="open-", dir=within) as folder:

                def start(request: OpenRequest) -> TaskWork:
                    work: TaskWork
                    if trainings is None:
                        work = LocalTask("open", request, MAX_WALL_S)
                    else:
                        work = ClassTask("open", trainings, Path(folder))
                    self._opened = name, work
                    return work

                return open_network(name, data, scene, agent, folder=Path(folder), start=start)
        except OSError as error:
            raise SetupError(
                _(
                    "{name}: it could not be opened: {reason}",
                    name=name,
                    reason=error.strerror or "",
                )
            ) from None

    @property
    def _opening_sentence(self) -> str:
        """Sentence about the file that is being opened; empty if none is."""
        name, work = self._opened
        waiting = "" if work is None else work.waiting
        opens = _("Opens {name}.", name=name)
        return (join([opens, waiting]) if waiting else opens) if name else ""

    async def _download_network(self, page: Page, command: m.DownloadNetwork) -> Answer:
        file = self._networks.file(self._scene, command.network)
        data = base64.b64encode(await page.in_thread(file.read_bytes)).decode()
        return Answer(more={"name": file.name, "data": data})

    async def _changed(self, change: Callable[[str], object]) -> None:
        """Have the thread change something of the present scene, and look again."""

        def task() -> None:
            change(self._scene)
            self._look()
            self._collect()  # there may be a place for a network now

        await self.done(task)

    def _part(self, work: SceneWork, agent: str, driver: str) -> m.TeachPart:
        def is_driving(network: KeptNetwork) -> bool:
            with suppress(SetupError):
                return driver == f"{NETWORK}{self._networks.file(self._scene, network.number).name}"
            return False

        return m.TeachPart(
            agent=agent,
            problem=work.problems.get(agent, ""),
            drives=list(work.drives.get(agent, ())),
            learning=self._learner.state(self._scene, agent),
            rewards=list(work.rewards.get(agent, ())),
            opponents=list(work.opponents.get(agent, ())),
            practice=self._practices.state(agent),
            decisions_per_s=self._practices.decisions_per_s,
            networks=[
                m.TaughtNetwork(
                    network.number,
                    network.title,
                    network.how,
                    network.made_at,
                    [*network.facts, *([network.score.sentence] if network.score else [])],
                    list(network.replays),
                    network.score,
                    is_driving(network),
                )
                for network in work.networks
            ],
            max_networks=MAX_NETWORKS,
            max_network_bytes=MAX_NETWORK_BYTES,
            opening=self._opening_sentence,
            warning=work.warning,
        )

    # -- in the world's thread ---------------------------------------------------------------------

    def _on_done(self, episode: Episode) -> None:
        if not episode.restarts and any(map(persons_decisions, episode.agents)):
            self.put(partial(self._keep, episode))

    def _offered(self) -> Mapping[Path, str]:
        """Return titles of this scene's networks, by their files; any thread calls it."""
        titles = {}
        for each in self.work.networks:
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
            warning = _("The last drive could not be kept: {reason}.", reason=error.strerror or "")
        self.work = replace(self.work, warning=warning)
        self._look()

    def _look(self) -> None:
        """Look at the drives and networks of the present scene again."""
        editor = self._required_editor()
        self._tries.look()
        self.work = self.work.looked_at(editor, self._drives, self._networks)
        # else another scene was opened meanwhile
        if self._scene == self.work.scene_name:
            self._practices.find(self._scene)

    def keep_network(
        self,
        scene: str,
        network: bytes,
        about: KeptNetwork,
        replays: Mapping[int, bytes] = MappingProxyType({}),
        *,
        drives: bool = True,
    ) -> bool:
        """Keep a network that has learned; return False if it can't be kept.

        Args:
            scene: name of the scene.
            network: the network's file.
            about: its origin.
            replays: episodes of its practice.
            drives: True lets it drive.
        """
        try:
            kept = self._networks.add(scene, network, about, replays)
        except (OSError, SetupError) as error:
            reason = error.strerror or "" if isinstance(error, OSError) else text_of(error)
            self.work = replace(
                self.work, warning=_("The network could not be kept: {reason}.", reason=reason)
            )
            self._look()
            return False
        self.work = replace(self.work, warning="")
        self._look()
        if self._scene == scene and drives:
            file = self._networks.file(scene, kept.number)
            self._required_editor().set_driver(about.agent, f"{NETWORK}{file.name}")
        return True

    def _collect(self) -> None:
        """Take networks that have learned elsewhere, or that a teacher gave."""
        self._learner.collect()
        for scene, about in self._handed_out.all():
            with suppress(OSError, SetupError):
                network = self._handed_out.file(scene, about.number).read_bytes()
                if self.keep_network(scene, network, about, drives=False):
                    self._handed_out.remove(scene, about.number)

    def check_free(self, agent: str) -> None:
        """Check that nothing learns, and that an agent can be taught.

        Raises:
            SetupError: it can't learn now; a sentence about why.
        """
        if self._practices.is_running or self._learner.is_busy:
            raise SetupError(_("the robot learns already; wait until it is done, or stop it"))
        if problem := self.work.problems.get(agent, ""):
            raise SetupError(problem)

    def _take(self, learned: Learned) -> bool:
        """Keep a network that has learned from drives; return False if it can't be kept."""
        about = KeptNetwork(
            number=0,
            title="",
            agent=learned.agent,
            how=ngettext(
                "learned from {n} drive with {decisions} decisions",
                "learned from {n} drives with {decisions} decisions",
                learned.drives,
                decisions=learned.decisions,
            ),
            alike=learned.alike,
            score=learned.score,
            facts=(
                _(
                    "Alike in {alike:.0%} of {held_out} moments that it had not seen.",
                    alike=learned.alike,
                    held_out=learned.held_out,
                ),
                _("Seed: {seed}.", seed=0),
            ),
        )
        return self.keep_network(learned.scene, learned.network, about)

    def _begin_learning(self, agent: str, numbers: list[int]) -> None:
        self.check_free(agent)
        good = {each.number for each in self.work.drives.get(agent, ()) if not each.reason}
        if missing := sorted(set(numbers) - good):
            raise SetupError(
                _(
                    "expected drives that this robot can learn from, got {missing}",
                    missing=shown(missing),
                )
            )
        scene = self._scene
        files = [self._drives.file(scene, number) for number in sorted(set(numbers))]
        self._learner.begin(scene, files, agent)

    @property
    def _scene(self) -> str:
        """Name of the present scene."""
        return self._required_editor().state.description.name

    def _required_editor(self) -> SceneEditor:
        assert self._editor is not None  # noqa: S101 - without one there are no commands
        return self._editor
