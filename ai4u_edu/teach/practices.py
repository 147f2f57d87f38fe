"""The practice of a world's agents: its commands, and what begins, pauses and ends it."""

from collections.abc import Awaitable, Callable, Mapping
from functools import lru_cache, partial
from pathlib import Path
from typing import Protocol

from ai4u_edu.base.errors import SetupError, shown
from ai4u_edu.blocks import LocalBrain, NeuralNetController
from ai4u_edu.locale import Text, library_text, ngettext, unpacked
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel.answers import Answer, change_answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.page import Page
from ai4u_edu.recording import Episode
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.yaml.file import YamlFile
from ai4u_edu.teach import messages as m
from ai4u_edu.teach.networks import MAX_NETWORKS, KeptNetwork, NetworkFolder
from ai4u_edu.teach.practice import FOLDER as PRACTICES
from ai4u_edu.teach.practice import (
    ClassPractice,
    Phase,
    Practice,
    PracticeFolder,
    PracticeProcess,
    PracticeRequest,
    Practising,
)
from ai4u_edu.teach.scene_work import SceneWork

OPPONENTS: Mapping[str | None, str] = {
    None: "",
    "player": _("against the scene's player"),
    "self": _("against itself"),
}
"""Player of the other side in a practice, in words."""


class Teaching(Protocol):
    """The option whose tab has the practice as a section."""

    @property
    def work(self) -> SceneWork:
        """Drives and networks of the present scene."""

    def put(self, task: Callable[[], object]) -> None:
        """Have the option's thread do something."""

    def done(self, task: Callable[[], object]) -> Awaitable[object]:
        """Have the option's thread do something, and return its result."""

    def check_free(self, agent: str) -> None:
        """Check that nothing learns, and that an agent can be taught.

        Raises:
            SetupError: it can't learn now; a sentence about why.
        """

    def keep_network(
        self,
        scene: str,
        network: bytes,
        about: KeptNetwork,
        replays: Mapping[int, bytes],
        *,
        drives: bool,
    ) -> bool:
        """Keep a network that has learned; return False if it can't be kept.

        Args:
            scene: name of the scene.
            network: the network's file.
            about: its origin.
            replays: episodes of its practice.
            drives: True lets it drive.
        """


class Practices:
    """The section "By rewards" of the tab Teach: its commands, and the practice.

    There is at most one. The option's thread begins it and goes on with it; its own thread lets the
    network drive.

    Args:
        runner: runs the world.
        player: shows episodes of a practice.
        editor: has the scene.
        networks: of all scenes.
        folder: of the work.
        teaching: the option.
    """

    def __init__(
        self,
        runner: Runner,
        player: ReplayPlayer,
        editor: SceneEditor,
        networks: NetworkFolder,
        folder: Path,
        teaching: Teaching,
    ) -> None:
        self._runner, self._player, self._editor = runner, player, editor
        self._networks, self._teaching = networks, teaching
        self._practices = PracticeFolder(folder / PRACTICES)
        self._practice: Practice | None = None
        self._found_for = ""
        """Name of the scene that is open; what is paused there stays on offer there."""
        self._replays: dict[tuple[Path, int], int] = {}
        """Numbers of episodes in the archive, by their file and its time."""
        self.commands: Mapping[type[PageCommand], Handler] = {
            m.PractiseForRewards: self._practise,
            m.PutRewards: self._put_rewards,
            m.PausePractising: self._pause,
            m.GoOnPractising: self._go_on,
            m.StopPractising: self._stop,
            m.ReplayPractice: self._replay,
        }

    @property
    def is_running(self) -> bool:
        """True while a network practises."""
        return self._practice is not None and self._practice.phase is Phase.RUNNING

    @property
    def key(self) -> object:
        """Changes, and can be hashed, whenever the answer of :meth:`state` may change."""
        practice = self._practice
        if practice is None:
            return None
        return practice, practice.progress, practice.phase, practice.waiting

    @property
    def decisions_per_s(self) -> float | None:
        """Decisions that the practice learns from in a second; None before its first check."""
        return None if self._practice is None else self._practice.decisions_per_s

    def state(self, agent: str) -> m.PracticeState | None:
        """Return the state of the practice: any that is not over, or an agent's own."""
        practice, work = self._practice, self._teaching.work
        if practice is None:
            return None
        progress, request, speed = practice.progress, practice.request, practice.decisions_per_s
        is_here = (request.agent, request.scene_name) == (agent, work.scene_name)
        if practice.phase is Phase.OVER and not is_here:
            return None
        return m.PracticeState(
            phase=practice.phase.value,
            problem=practice.problem,
            waiting=practice.waiting,
            elsewhere="" if is_here else _robot_of(request.scene, request.agent),
            is_scene_changed=is_here and request.scene != work.scene_text,
            hint=practice.hint,
            seconds_left=speed and (progress.total - progress.decisions) / speed,
            decisions=progress.decisions,
            total=progress.total,
            rewards=[round(point.reward, 3) for point in progress.curve],
            success=progress.curve[-1].success if progress.curve else None,
            easy_starts=progress.easy_starts,
            is_game=bool(request.against),
        )

    # -- in the server's event loop ----------------------------------------------------------------

    async def _practise(self, page: Page, command: m.PractiseForRewards) -> Answer:
        await self._teaching.done(lambda: self._begin(page.view.agent, command))
        return Answer(_("It practises."))

    async def _put_rewards(self, page: Page, command: m.PutRewards) -> Answer:
        factors = {name: factor for name, factor in command.weights.items() if factor != 1.0}
        if not factors:
            raise SetupError(
                _("all factors are 1, as the scene has them; choose another one first")
            )
        result = await page.result(self._editor.scale_rewards(page.view.agent, factors))
        return change_answer(_("The scene pays so now."), result)

    async def _pause(self, _page: Page, _command: m.PausePractising) -> Answer:
        if self._practice is None or not self.is_running:
            return Answer(_("Nothing practises now."))
        self._practice.pause()
        return Answer(_("The practice is paused."))

    async def _go_on(self, _page: Page, _command: m.GoOnPractising) -> Answer:
        await self._teaching.done(self._begin_again)
        return Answer(_("It practises."))

    async def _stop(self, _page: Page, _command: m.StopPractising) -> Answer:
        practice = self._practice
        if practice is None or practice.phase is Phase.OVER:
            return Answer(_("Nothing practises now."))
        await self._teaching.done(practice.stop)
        return Answer(_("The practice is stopped."))

    async def _replay(self, page: Page, command: m.ReplayPractice) -> Answer:
        player = self._player
        file = self._networks.replay(self._scene, command.network, command.decisions)
        if player.archive is None or not file.is_file():
            raise SetupError(_("this episode of the practice is not kept any more"))
        key = file, file.stat().st_mtime_ns
        number = self._replays.get(key)
        if number is None or player.archive.find(number) is None:
            episode = await page.in_thread(lambda: Episode.load(file))
            source = _(
                "network {network} after {decisions:,} decisions",
                network=command.network,
                decisions=command.decisions,
            )
            number = self._replays[key] = player.archive.append(episode, source).number
        player.open(number, page.view.agent)
        player.play()
        return Answer()

    # -- in the option's thread --------------------------------------------------------------------

    def find(self, scene: str) -> None:
        """Offer to go on with a practice of the present scene that an earlier process began."""
        practice, is_known = self._practice, scene == self._found_for
        self._found_for = scene
        if practice is not None and (
            is_known or self.is_running or practice.request.scene_name == scene
        ):
            return
        self.leave()
        self._practice = practice = self._practices.find(scene, self._make)
        if practice is not None and practice.is_under_way:
            practice.go_on()

    def leave(self) -> None:
        """Let the practice wait for another process."""
        practice, self._practice = self._practice, None
        if practice is not None and practice.phase is not Phase.OVER:
            practice.leave()

    def _begin(self, agent: str, command: m.PractiseForRewards) -> None:
        self._teaching.check_free(agent)
        work, begin_with = self._teaching.work, ""
        names = work.rewards.get(agent, ())
        if not names:
            raise SetupError(_("it gets no reward to practise for; add one in Build"))
        if wrong := sorted(set(command.weights) - set(names)):
            raise SetupError(
                _(
                    "expected reward terms of {names}, got {wrong}",
                    names=", ".join(names),
                    wrong=shown(wrong),
                )
            )
        if command.begin_with is not None:
            begin_with = str(self._networks.file(self._scene, command.begin_with).absolute())
        if self._practice is not None and self._practice.phase is Phase.PAUSED:
            raise SetupError(_("a practice is paused; go on with it, or stop it first"))
        if len(work.networks) >= MAX_NETWORKS:
            raise SetupError(
                _(
                    "this scene has {number} networks already; delete one that you do not need",
                    number=MAX_NETWORKS,
                )
            )
        against, opponent = self._opponent(agent, command)
        scene = self._editor.scene
        request = PracticeRequest(
            scene=scene.dumps(),
            scene_name=scene.description.name,
            place=str(scene.folder or ""),
            agent=agent,
            steps=command.steps,
            seed=0,
            weights={name: factor for name, factor in command.weights.items() if factor != 1.0},
            begin_with=begin_with,
            against=against,
            opponent=opponent,
        )
        try:
            folder, request = self._practices.add(scene.description.name, request)
            self._practice = self._make(folder, request)
            self._practice.go_on()
        except OSError as error:
            raise SetupError(
                _("the practice could not be begun: {reason}", reason=error.strerror or "")
            ) from None

    def _begin_again(self) -> None:
        practice = self._practice
        if practice is None or practice.phase is not Phase.PAUSED:
            raise SetupError(_("there is no practice that could go on; begin another one"))
        self._teaching.check_free(practice.request.agent)
        practice.go_on()

    def _opponent(self, agent: str, command: m.PractiseForRewards) -> tuple[str, str]:
        """Return who plays the other side, for the practice and in words."""
        work = self._teaching.work
        if command.against and command.against not in work.opponents.get(agent, ()):
            raise SetupError(
                _("nobody can play against this robot in that way here; choose another")
            )
        if command.against != "file":
            return command.against or "", OPPONENTS[command.against]
        number = command.opponent
        if number is None:
            raise SetupError(_("expected the network to play against; choose one"))
        path = self._networks.file(self._scene, number).absolute()
        titles = {network.number: network.title for network in work.networks}
        return str(path), _(
            "against {network}", network=titles.get(number, _("Network {number}", number=number))
        )

    def _make(self, folder: Path, request: PracticeRequest) -> Practice:
        return Practice(
            folder,
            request,
            start=self._start,
            on_progress=self._on_progress,
            on_end=self._on_end,
        )

    def _start(self, folder: Path, request: PracticeRequest) -> Practising:
        trainings = self._editor.class_trainings
        if trainings is None:
            return PracticeProcess(request)
        return ClassPractice(trainings, folder)

    # -- in the thread of the practice -------------------------------------------------------------

    def _on_progress(self, practice: Practice) -> None:
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

    def _on_end(self, practice: Practice) -> None:
        best = practice.run.best_network
        network = best.read_bytes() if best.is_file() and practice.progress.curve else b""
        replays, score = practice.replays(), practice.score()
        practice.remove()
        if not network:
            return
        checks = practice.progress.curve
        share = max((check.success or 0.0 for check in checks), default=0.0)
        agent, against = practice.request.agent, unpacked(practice.request.opponent)
        practised = ngettext(
            "practised for {n} decision", "practised for {n} decisions", practice.progress.decisions
        )
        how: str = practised
        if against:
            how = _(
                "{practised} {against}, won {share:.0%} of its games",
                practised=practised,
                against=against,
                share=share,
            )
        elif checks[-1].success is not None:
            how = _(
                "{practised}, goal reached from {share:.0%} of starts",
                practised=practised,
                share=share,
            )
        about = KeptNetwork(0, "", agent, how, facts=practice.facts, score=score)
        brains = [agent.brain for agent in self._runner.sim.agents if agent.id == about.agent]
        # whoever has taken over goes on driving
        drives = any(getattr(brain, "controller", 0) is practice.controller for brain in brains)
        scene = practice.request.scene_name
        keep = partial(self._teaching.keep_network, scene, network, about, replays, drives=drives)
        self._teaching.put(keep)

    @property
    def _scene(self) -> str:
        """Name of the present scene."""
        return self._editor.state.description.name


@lru_cache(4)
def _robot_of(scene: str, agent: str) -> Text:
    """Return an agent and its scene in words, after "The ...".

    Args:
        scene: text of the scene.
        agent: id of the agent.
    """
    data = YamlFile(scene, "scene").data
    title = library_text(data.get("title") or data.get("name") or "")
    if len(data["agents"]) == 1:
        return _("robot of “{title}”", title=title)
    return _("robot {agent} of “{title}”", agent=agent, title=title)
