"""Explanations of a running world's agents, also in a recorded episode that its pages look at."""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Brain, Percept
from ai4u_edu.explain import LIMITS
from ai4u_edu.explain.baseline import mean_of
from ai4u_edu.explain.elsewhere import PoseTrial
from ai4u_edu.explain.live import (
    MAX_MEAN_PERCEPTS,
    MIN_MEAN_PERCEPTS,
    Floats,
    LiveExplainer,
    NamedBaseline,
    Why,
)
from ai4u_edu.explain.live_maps import LiveMaps
from ai4u_edu.explain.map_colours import CIVIDIS, value_range
from ai4u_edu.explain.map_maker import LiveMap, faced_things
from ai4u_edu.explain.page.choice import choice_of
from ai4u_edu.explain.page.commands import WhyCommands
from ai4u_edu.explain.page.compare import CompareCommands
from ai4u_edu.explain.page.policy_maps import PolicyMaps
from ai4u_edu.explain.page.stand_in import StandIns
from ai4u_edu.explain.page.watch import Watching
from ai4u_edu.explain.sentence import MIN_SHARE
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.panel import PanelContext
from ai4u_edu.page.panel.page_view import PageView
from ai4u_edu.page.viewer.backend.part import Part
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.recording.scene_export import export_scene, without_unknown_brains
from ai4u_edu.runtime.frame_budget import MAX_FRAMES_PER_S, SENSES_PER_S
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.snapshot.block_info import in_words

_TOP_SLOTS = 6
"""Most slots in the list of those that matter most."""
_SOURCES = {
    "critic": _("The colours are the points that its critic expects from there; it may be wrong."),
    "rollouts": _("The colours are the points of one try from there; later points count less."),
}
"""The sources of values in words."""


def _why_part(why: Why) -> dict[str, Any]:
    """Return an explanation for the page.

    ``slots`` are in the order of the sensors' numbers; of rays from the leftmost on, row by row.
    ``share`` is the largest movement of any number of the action, as a share of its range.
    """
    sizes = [max(map(abs, shares), default=0.0) for shares in why.shares]
    slots = [
        {
            "key": group.key,
            "name": group.name,
            "sees": group.sees,
            "share": round(size, 4),
            "shares": [round(each, 4) for each in shares],
        }
        for group, size, shares in zip(why.groups, sizes, why.shares, strict=True)
    ]
    order = sorted(range(len(slots)), key=lambda index: -sizes[index])[:_TOP_SLOTS]
    return {
        "type": "part",
        "name": "why",
        "agent": why.agent,
        "problem": why.problem,
        "sentence": why.sentence,
        "baseline": why.baseline,
        "also": why.also,
        "explained": why.explained,
        "limits": LIMITS,
        "components": [in_words(axis.name) for axis in why.axes],
        "slots": slots,
        "top": [slots[index] for index in order if sizes[index] >= MIN_SHARE],
    }


def _maps_part(
    snapshot: Snapshot, agent: AgentState, maps: Sequence[LiveMap | None]
) -> dict[str, Any]:
    """Return the state of an agent's maps; those of which nothing is known yet are left out."""
    found = {each.request.kind: each for each in maps if each is not None}
    return {
        "type": "part",
        "name": "maps",
        "agent": agent.id,
        "problem": next((each.problem for each in found.values() if each.problem), ""),
        "faced": faced_things(snapshot, agent),
        "field": _progress(found.get("field")),
        "values": _values(found.get("values")),
    }


def _progress(told: LiveMap | None) -> dict[str, Any] | None:
    if told is None or told.problem:
        return None
    return {"done": told.done, "count": len(told.poses), "seconds": round(told.time, 2)}


def _values(told: LiveMap | None) -> dict[str, Any] | None:
    progress = _progress(told)
    if told is None or progress is None:
        return None
    low, high = value_range(told.values) or (None, None)
    words = _SOURCES.get(told.source, "")
    return progress | {"low": low, "high": high, "words": words, "colours": CIVIDIS}


EXPORT_TIMEOUT_S = 2.0
"""Time that the world's thread has to describe its world."""


class ExplainOption:
    """Explanations of a running world's agents: parts of the picture and the panel, and commands.

    Any thread may call it. What is computed is computed in threads of its own while somebody looks.

    Args:
        runner: runs the world.
        player: plays the recorded episodes that its pages look at.
        editor: of the scene; without one, no network can be watched.
    """

    agent_parts = frozenset({"why", "maps", "watch"})
    tab = None

    def __init__(
        self,
        runner: Runner,
        player: ReplayPlayer,
        editor: SceneEditor | None = None,
    ) -> None:
        def latest() -> Snapshot:
            return runner.latest

        def brain_of(agent_id: str) -> Brain | None:
            agents = runner.sim.agents
            return next((agent.brain for agent in agents if agent.id == agent_id), None)

        self._runner = runner
        self._rate = rate = runner.frame_budget.senses_per_s
        self.explainer = explainer = LiveExplainer(latest, brain_of, EpisodeBaseline(player))
        thrift = rate / SENSES_PER_S  # less than 1 in a class's rooms
        scenes = SceneSource(runner, player), SceneSource(runner, player)  # one for each thread
        self.maps = LiveMaps(latest, explainer, scenes[0], thrift, lambda: runner.next_tick_at)
        self.pose_trial = PoseTrial(latest, explainer, scenes[1])
        self.watching = Watching(runner, editor)
        self.commands = {
            **WhyCommands(explainer, self.pose_trial).handlers,
            **CompareCommands(explainer).handlers,
            **self.watching.handlers,
        }

    def panel_parts(self, context: PanelContext, view: PageView) -> Iterator[tuple[str, bytes]]:
        """Yield why the page's agent acts as it does, and its maps, if the page shows them."""
        yield from self.watching.parts(context, view)
        snapshot, choice = self._runner.latest, choice_of(view)
        agent = next((each for each in snapshot.agents if each.id == view.agent), None)
        is_watched = self.watching.is_watched_by(view)
        if agent is None or not (is_watched or "agent" in view.show.tabs):
            return
        if (is_watched or choice.is_why_shown) and (
            why := self.explainer.why(agent.id)
        ) is not None:
            yield "why", context.cache.of_snapshot(snapshot, ("why", why), lambda: _why_part(why))
        if requests := choice.maps.requests(agent.id):
            maps = [self.maps.ask(request) for request in requests]
            key = "maps", agent.id, choice.maps, *maps
            yield (
                "maps",
                context.cache.of_snapshot(snapshot, key, lambda: _maps_part(snapshot, agent, maps)),
            )

    def picture_parts(self, pages: ViewerClients) -> list[tuple[Part, float]]:
        """Return the maps over the floor, and the stand-ins for agents at other places."""
        return [
            (PolicyMaps(pages, self.maps, self.watching), self._rate),
            (StandIns(pages), MAX_FRAMES_PER_S),
        ]

    def ray_weights(self, page: ViewerClient) -> Mapping[str, Floats] | None:
        """Return how much each ray matters to the page's agent; None if the page hides it."""
        is_shown = choice_of(page).is_why_shown or self.watching.is_watched_by(page)
        why = self.explainer.why(page.agent) if is_shown else None
        return None if why is None else why.ray_weights

    def stop(self) -> None:
        """End the threads; they are not waited for, as a student's function may not return."""
        self.explainer.stop()
        self.maps.stop()


class SceneSource:
    """Describes the world of a snapshot, so that it can be copied; one thread calls it.

    The same object comes again as long as the world is the same.

    Args:
        runner: runs the world.
        player: has the episode that is shown in a snapshot of the past.
    """

    def __init__(self, runner: Runner, player: ReplayPlayer) -> None:
        self._runner, self._player = runner, player
        self._version: object = None
        self._scene: SceneDescription | None = None

    def __call__(self, snapshot: Snapshot) -> SceneDescription:
        """Return the scene of a snapshot; brains of unknown types are left out.

        Raises:
            AI4UError: the world does not answer, or no file can hold it.
        """
        # blocks that were changed have other descriptions
        agents = tuple((agent.sensor_infos, agent.brain) for agent in snapshot.agents)
        version = snapshot.static_scene, agents
        if self._scene is not None and version == self._version:
            return self._scene
        episode = self._player.frame_cache
        if snapshot.past and episode is not None:
            scene = without_unknown_brains(episode.episode.scene)
        else:
            scene = self._exported()
        # the next episode of the same world is another static scene, of an equal description
        if self._scene is None or scene != self._scene:
            self._scene = scene
        self._version = version
        return self._scene

    def _exported(self) -> SceneDescription:
        def export() -> SceneDescription:
            return without_unknown_brains(export_scene(self._runner.sim))

        if not self._runner.thread_id:
            return export()
        try:
            return self._runner.submit(export).result(EXPORT_TIMEOUT_S)
        except (TimeoutError, CancelledError):
            raise AI4UError(_("The world does not answer: a block of it may not return.")) from None


class EpisodeBaseline:
    """Computes the baseline of the episode that pages look at; one thread calls it.

    Args:
        player: has the episode.
    """

    def __init__(self, player: ReplayPlayer) -> None:
        self._player = player
        self._key: tuple[FrameCache, str] | None = None
        self._found: NamedBaseline | None = None

    def __call__(self, snapshot: Snapshot, agent_id: str) -> NamedBaseline | None:
        """Return the mean of an agent's percepts in the episode of a snapshot.

        Returns:
            None for a snapshot of the present, for an episode of a few decisions, and until the
            whole episode has been replayed.
        """
        frame_cache = self._player.frame_cache
        if not snapshot.past or frame_cache is None:
            return None
        if self._key != (frame_cache, agent_id):
            percepts = _percepts(frame_cache, agent_id)
            if percepts is None:
                return None
            words = _(
                "the mean of {count} percepts of episode {number}",
                count=len(percepts),
                number=frame_cache.number,
            )
            is_long = len(percepts) >= MIN_MEAN_PERCEPTS
            self._found = NamedBaseline(words, mean_of(percepts)) if is_long else None
            self._key = frame_cache, agent_id
        return self._found


def _percepts(frame_cache: FrameCache, agent_id: str) -> list[Percept] | None:
    """Return an agent's percepts in an episode, some of them if it is long; None until then."""
    count, stride = frame_cache.last, frame_cache.stride  # others are not kept
    stride *= max(1, -(-count // (stride * MAX_MEAN_PERCEPTS)))
    found: list[Percept] = []
    # the last one first: until it is there, there is no need to look at the others
    for step in reversed(range(0, count, stride)):
        frame = frame_cache.snapshot(step)
        if frame is None:
            return None
        found += [agent.percept for agent in frame.agents if agent.id == agent_id]
    return found
