"""A reward for touching targets in their order."""

from typing import Annotated, ClassVar

from pydantic import Field

from ai4u_edu.base.parameters import Number
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.reward_func import RewardFunc, Stages
from ai4u_edu.world import BodyView, WorldView


class CheckpointsReward(RewardFunc):
    """Pays ``reward`` for each target touched in order, and ``lap_reward`` for the whole route.

    The targets (bodies, or areas, which the agent touches with its centre) form a route. Only the
    next one counts, and each counts once: going back and forth earns nothing, and a short cut that
    leaves one out earns nothing more. Contacts are checked in every tick, so a fast agent does not
    miss them.

    With ``loop`` the route is a lap: it begins with whichever target is touched first, goes on in
    order, and ends where it began. To pay only for whole laps, set ``reward`` to 0. Example: a lap
    of a track with four marks, which ends the episode =
    ``CheckpointsReward(targets=["1", "2", "3", "4"], loop=True, reward=0, lap_reward=10,
    cause_episode_to_end=True)``.

    Source: ours.
    """

    targets: Annotated[list[str], Field(min_length=1)]
    """Names of bodies or areas, in the order in which they must be touched."""
    reward: Number = 1.0
    """Amount for each target that is touched in order."""
    lap_reward: Number = 0.0
    """Amount that the last target pays in addition."""
    loop: bool = False
    """True for a lap that may begin at any target and ends where it began."""
    repeats: bool = False
    """True begins the route again at its first target when the last one was touched, as for loads
    that are fetched and brought home."""

    carried: ClassVar[tuple[str, ...]] = ("_under_way", "_ahead", "_due", "_is_done", "_finished")

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the targets."""
        for target in self.targets:
            view.check_target(target)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Start the route again."""
        self._under_way = not self.loop
        self._ahead = list(self.targets)
        self._due = 0.0
        self._is_done = self._finished = False

    def on_tick(self, body: BodyView, view: WorldView) -> None:
        """Check if the next target is touched."""
        awaited = self._ahead[:1] if self._under_way else self._ahead
        for target in awaited:
            if view.touching(body, target):
                self._due += self.reward
                self._pass(target)
                break

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward of the decision."""
        due, self._due = self._due, 0.0
        self._finished, self._is_done = self._is_done, False
        return due

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the whole route was completed in this decision."""
        return self._finished

    def stages(self) -> Stages:
        """Return how many targets were touched; a lap ends at its first one, which counts twice."""
        total = len(self.targets) + self.loop
        passed = total - len(self._ahead) if self._under_way else 0
        ahead = tuple(self._ahead)
        return Stages(
            passed, total, tuple(self.targets), ahead, ahead[:1] if self._under_way else ahead
        )

    def _pass(self, target: str) -> None:
        if self._under_way:
            self._ahead = self._ahead[1:]
        else:
            first = self.targets.index(target)
            self._ahead = [*self.targets[first + 1 :], *self.targets[: first + 1]]
            self._under_way = True
        if not self._ahead:
            self._due += self.lap_reward
            self._is_done = True
            if self.repeats:
                self._ahead, self._under_way = list(self.targets), not self.loop
