"""A trained network that drives for a while, and races between it and a person."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, Protocol

from msgspec import Struct

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks import Brain, LocalBrain, NeuralNetController, RemoteBrain
from ai4u_edu.explain.live_maps import MapChoice
from ai4u_edu.explain.map_maker import faced_things
from ai4u_edu.explain.page import messages as m
from ai4u_edu.explain.page.choice import OPTION, HasChoices, choice_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.drivers import Driver
from ai4u_edu.page.editing.dry_run import IdleBrain
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.answers import Answer
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.gallery import driver_title
from ai4u_edu.page.panel.page import Page
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.recording import ArchiveEntry, Episode, Ghosts, Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene, SceneDescription

WATCH_S = 8.0
"""Time (s) that a watched drive lasts at least: a shorter one is shown in slow motion."""
MIN_TIME_SCALE = 0.1
MAX_DRIVE_S = 600.0
"""World time (s) after which a network's drive counts as endless."""
LIST_S = 1.0
"""Time for which the list of an agent's networks is kept."""

HANDICAP_S = 4.0
"""Time (s) that a person's hands need on top of a network's, which turns and drives at once."""
NO_HANDICAP_S = 10.0
"""Time (s) of a network's drive from which on its ghost is not slowed any more."""

NO_NETWORK = _("there is no trained network for this scene; teach the robot in the tab Teach first")
PROGRAM_DRIVES = _("a program drives this robot now; stop it first")


class WatchableNetwork(Struct, frozen=True):
    """A network that can drive."""

    name: str
    """Name of the driver."""
    title: str


class NetworkRace(Struct, frozen=True):
    """A race against a ghost, which has finished already."""

    ghost: Literal["network", "drive"]
    """The ghost: the network's, or that of a person's drive against which the network races."""
    seed: str
    """Seed of the start, a whole number as text; an episode with another one is no race."""
    is_won: bool | None
    """True if the ghost reached the goal; null in a scene without a goal."""
    seconds: float
    """Time (s) that the ghost takes."""
    full_speed_s: float
    """Time (s) that it took at its full speed: less where it is slowed, so that keys can win."""
    score: float
    """Reward of the ghost's agent."""


class WatchPart(PanelPart, frozen=True, kw_only=True):
    """The networks that can drive the page's agent, and the one that is watched."""

    name: Literal["watch"] = "watch"
    agent: str
    networks: list[WatchableNetwork]
    """Networks of the scene, and a person's own; the first one is the usual choice."""
    watching: str
    """Name of the network that drives for a while; empty for none."""
    has_drive: bool
    """True if a drive of a person is kept against which the network can race."""
    race: NetworkRace | None
    """The race that pages see; null for none."""


class ShowsAgent(HasChoices, Protocol):
    """A page's panel or its picture, which shows an agent."""

    @property
    def agent(self) -> str:
        """Id of the agent."""


@dataclass(eq=False)
class _Watch:
    """A network that drives an agent in place of its own brain."""

    agent: BasicAgent
    brain: Brain
    name: str
    time_scale: float
    """Time scale of the world before."""
    slow: float
    """Time scale for the watch."""


@dataclass(frozen=True, eq=False)
class _Race:
    episode: Episode
    """The ghost's episode."""
    agent: str
    view: NetworkRace


class Watching:
    """Lets networks drive for a while and race; the scene stays as it is.

    The server's event loop calls the handlers and :meth:`parts`; brains are replaced in the
    world's thread, and :meth:`is_on` may be called in any thread.

    Args:
        runner: runs the world.
        editor: knows the networks; without one there is nothing to watch.
    """

    def __init__(self, runner: Runner, editor: SceneEditor | None) -> None:
        self._runner, self._editor = runner, editor
        self._watches: dict[str, _Watch] = {}
        """Watches by the id of their agent; replaced, never changed."""
        self._race: _Race | None = None
        self._scene: SceneDescription | None = None
        self._task = ("", "")
        """Task of a person's drives in that scene."""
        self._listed: dict[str, tuple[float, list[Driver]]] = {}
        self.handlers: Mapping[type[PageCommand], Handler] = {
            m.WatchNetwork: self._watch,
            m.StopWatching: self._stop,
            m.RaceNetwork: self._race_network,
        }
        """Handlers by the type of their command."""
        if editor is not None:
            editor.listeners.append(lambda _scene: self._forget_gone())

    def is_on(self, agent_id: str) -> bool:
        """Return True while a network that is watched drives an agent."""
        watch = self._watches.get(agent_id)
        return watch is not None and self._drives(watch)

    def is_watched_by(self, page: ShowsAgent) -> bool:
        """Return True while a page watches the network that drives its agent."""
        return choice_of(page).watched is not None and self.is_on(page.agent)

    def shown_maps(self, page: ShowsAgent) -> MapChoice:
        """Return the maps that a page's picture shows: those chosen there, or those of a watch."""
        choice = choice_of(page)
        if choice.watched is None or choice.maps.has_field or choice.maps.has_values:
            return choice.maps
        return choice.watched if self.is_on(page.agent) else choice.maps

    def parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield what the page's agent can be watched with."""
        editor = self._editor
        if editor is None:
            return
        try:
            networks = self._networks(editor, view.agent, context.clock())
        except AI4UError:  # the world has other agents already
            return
        watching = self._watches[view.agent].name if self.is_on(view.agent) else ""
        drive = self._persons_drive()
        race = self._race
        is_shown = race is not None and _is_shown(context.ghosts, race) and race.agent == view.agent
        shown = race.view if race is not None and is_shown else None
        names = tuple(networks)
        key = "watch", view.agent, names, watching, drive is not None, shown
        yield (
            "watch",
            context.cache.by_key(
                key,
                lambda: WatchPart(
                    agent=view.agent,
                    networks=[WatchableNetwork(each.name, driver_title(each)) for each in networks],
                    watching=watching,
                    has_drive=drive is not None,
                    race=shown,
                ),
            ),
        )

    # -- in the server's event loop ----------------------------------------------------------------

    async def _watch(self, page: Page, command: m.WatchNetwork) -> Answer:
        context, agent_id = page.context, page.view.agent
        editor = context.required_editor()
        network = self._chosen(editor, agent_id, command.network, context.clock())
        drive = self._persons_drive() if command.against_my_drive else None
        if command.against_my_drive and drive is None:
            raise SetupError(_("no drive of yours is kept in this scene; drive first"))
        runner = self._runner
        seed = runner.sim.world.seeds.seed if drive is None else drive.episode.seed

        def prepared() -> tuple[Brain, float]:
            """Return the network's brain, and how long its drive lasts (s)."""
            lasts = _driven(editor, agent_id, network.name, seed).seconds
            brain = editor.driver_brain(agent_id, network.name)
            if isinstance(brain, LocalBrain) and isinstance(brain.controller, NeuralNetController):
                brain.controller.repeat = False  # pages say how it ended, and what to do next
            return brain, lasts

        brain, lasts = await page.in_thread(prepared)
        context.player.cancel()
        self._race = None
        if drive is None:
            context.ghosts.race(None)
        else:
            context.ghosts.race(drive.episode, _("your drive"), _("you"))
            self._race = _race_of(drive.episode, agent_id, "drive")
        await page.result(runner.submit(lambda: self._begin(agent_id, network.name, brain, lasts)))
        await page.result(runner.reset(seed))
        runner.start_episode()
        await page.result(runner.resume())
        faced = _first_faced(runner, agent_id)
        choice = choice_of(page.view)._replace(watched=MapChoice(True, True, faced))
        page.view.choose(OPTION, choice, "why", "watch")
        return Answer(_("The network drives."))

    async def _stop(self, page: Page, _command: m.StopWatching) -> Answer:
        agent_id = page.view.agent
        await self._end(page, agent_id)
        page.context.ghosts.race(None)
        self._race = None
        await page.result(self._runner.try_again())
        return Answer(_("It is yours again."))

    async def _race_network(self, page: Page, command: m.RaceNetwork) -> Answer:
        context, agent_id = page.context, page.view.agent
        editor, runner = context.required_editor(), self._runner
        network = self._chosen(editor, agent_id, command.network, context.clock())
        seed = runner.sim.world.seeds.seed
        episode = await page.in_thread(lambda: _driven(editor, agent_id, network.name, seed))
        await self._end(page, agent_id)
        context.player.cancel()
        stretch = _stretch(episode)
        label = _("network") if stretch == 1.0 else _("network, slowed")
        context.ghosts.race(episode, _("the network"), label, stretch=stretch)
        self._race = _race_of(episode, agent_id, "network", stretch)
        await page.result(runner.reset(seed))
        await page.result(runner.resume())
        return Answer(_("Race the network: it starts as you do."))

    async def _end(self, page: Page, agent_id: str) -> None:
        """Give an agent back to the driver that the scene names, if it is watched."""
        watch = self._watches.get(agent_id)
        if watch is None:
            return
        if self._drives(watch):
            await page.result(page.context.required_editor().restore_driver(agent_id))
        await page.result(self._runner.submit(lambda: self._forget(watch)))

    def _chosen(self, editor: SceneEditor, agent_id: str, name: str, now: float) -> Driver:
        networks = self._networks(editor, agent_id, now)
        chosen = next((each for each in networks if name in ("", each.name)), None)
        if chosen is None:
            raise SetupError(
                NO_NETWORK if not networks else _("this network is not there any more")
            )
        return chosen

    def _networks(self, editor: SceneEditor, agent_id: str, now: float) -> list[Driver]:
        """Return the networks that can drive an agent."""
        listed_at, networks = self._listed.get(agent_id, (0.0, None))
        if networks is None or now - listed_at >= LIST_S:
            drivers = editor.drivers(agent_id)
            networks = [each for each in drivers if each.title.startswith("Network ")]
            self._listed[agent_id] = now, networks
        return networks

    def _persons_drive(self) -> ArchiveEntry | None:
        """Return a person's best drive of the present scene, or else the last one, or None."""
        recorder = self._runner.recorder
        scene = None if recorder is None else recorder.current_scene
        if recorder is None or scene is None:
            return None
        if scene is not self._scene:
            self._scene, self._task = scene, (scene.task_key(), "keys")
        drives = [
            each
            for each in recorder.episodes.entries
            if not each.source and each.episode.changed is None and each.task == self._task
        ]
        won = [each for each in drives if each.success]
        if won:
            return min(won, key=lambda each: each.episode.seconds)
        return drives[-1] if drives else None

    # -- in the world's thread ---------------------------------------------------------------------

    def _begin(self, agent_id: str, name: str, brain: Brain, lasts: float) -> None:
        """Let a network drive from the next decision on.

        Raises:
            SetupError: the network does not fit the agent, or a program drives it.
        """
        runner = self._runner
        agent = runner.sim.agent(agent_id)
        if isinstance(agent.brain, RemoteBrain):
            raise SetupError(PROGRAM_DRIVES)
        before = self._watches.get(agent_id)
        agent.use_brain(brain)
        if before is not None:
            self._forget(before)
        scale = runner.time_scale
        slow = round(min(scale, max(MIN_TIME_SCALE, lasts / WATCH_S)), 2)
        watch = _Watch(agent, brain, name, scale, slow)
        self._watches = self._watches | {agent_id: watch}
        agent.begin_of_step.connect(self._look_who_drives)
        runner.set_time_scale(slow)

    def _look_who_drives(self, agent: BasicAgent) -> None:
        """End a watch whose agent has another driver: a person who has pressed a key."""
        watch = self._watches.get(agent.id)
        if watch is not None and agent.brain is not watch.brain:
            self._forget(watch)

    def _forget_gone(self) -> None:
        """Forget watches of agents that are not there any more, after another scene was opened."""
        for watch in self._watches.values():
            if not self._is_there(watch):
                self._forget(watch)

    def _forget(self, watch: _Watch) -> None:
        """Forget a watch that is over; the world runs as fast as before."""
        if self._watches.get(watch.agent.id) is not watch:
            watches = self._watches
        else:
            watches = {key: each for key, each in self._watches.items() if each is not watch}
        self._watches = watches
        if self._look_who_drives in watch.agent.begin_of_step.handlers:
            watch.agent.begin_of_step.disconnect(self._look_who_drives)
        if watch.agent.brain is not watch.brain:
            # else the person's release of the keys would hand it back to the network
            brains = watch.agent.brains
            brains[:] = [brain for brain in brains if brain is not watch.brain]
        if self._runner.time_scale == watch.slow:  # nobody has chosen another one meanwhile
            self._runner.set_time_scale(watch.time_scale)

    def _drives(self, watch: _Watch) -> bool:
        return watch.agent.brain is watch.brain and self._is_there(watch)

    def _is_there(self, watch: _Watch) -> bool:
        return any(agent is watch.agent for agent in self._runner.sim.agents)


def _driven(editor: SceneEditor, agent_id: str, network: str, seed: int) -> Episode:
    """Return the episode of a network from a start, driven as fast as it can be.

    Raises:
        AI4UError: the network does not fit the agent.
    """
    if reason := editor.reason_against_driver(agent_id, network):
        raise SetupError(_("this network can't drive this robot: {reason}", reason=reason))
    scene, brain = editor.scene, editor.driver_brain(agent_id, network)
    sim = scene.build(brains=_brains(scene, agent_id, brain))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(seed)
    agent = sim.agent(agent_id)
    while not agent.done and sim.world.time < MAX_DRIVE_S:
        sim.tick()
    episode = recorder.current_episode()
    if episode is None:
        raise SetupError(recorder.problem or _("the drive could not be recorded"))
    return episode


def _brains(scene: Scene, agent_id: str, brain: Brain) -> Callable[[BasicAgent], Brain | None]:
    """Return the brains of a copy of a scene: the network's, and none that waits for a script."""
    described = {str(each.get("id", "0")): each["brains"] for each in scene.description.agents}

    def brain_of(agent: BasicAgent) -> Brain | None:
        if agent.id == agent_id:
            return brain
        is_local = all(
            each["type"] == "LocalBrain"
            for each in described[agent.id]
            if each.get("enabled", True)
        )
        return None if is_local else IdleBrain()

    return brain_of


def _stretch(episode: Episode) -> float:
    """Return the factor of a network's time with which a person by keys can win against it.

    A person sees late, and turns or drives with one key at a time. Keys that follow what was seen
    0.4 s before reach the box of box_chase in 2.6 to 4.4 s, its network in 0.3 to 1.3 s; in a long
    drive that counts for less.
    """
    if not episode.success or episode.seconds <= 0:
        return 1.0
    return 1.0 + HANDICAP_S * max(0.0, 1 / episode.seconds - 1 / NO_HANDICAP_S)


def _race_of(
    episode: Episode, agent_id: str, ghost: Literal["network", "drive"], stretch: float = 1.0
) -> _Race:
    record = episode.agent(agent_id)
    view = NetworkRace(
        ghost=ghost,
        seed=str(episode.seed),
        is_won=episode.success,
        seconds=round(stretch * episode.seconds, 2),
        full_speed_s=round(episode.seconds, 2),
        score=round(record.total, 2),
    )
    return _Race(episode, agent_id, view)


def _is_shown(ghosts: Ghosts, race: _Race) -> bool:
    return any(drive.episode is race.episode for drive in ghosts.drives)


def _first_faced(runner: Runner, agent_id: str) -> str:
    """Return the thing to which the agent looks in the maps; empty for its present heading."""
    snapshot = runner.latest
    agent = next((each for each in snapshot.agents if each.id == agent_id), None)
    names = [] if agent is None else faced_things(snapshot, agent)
    return names[0] if names else ""
