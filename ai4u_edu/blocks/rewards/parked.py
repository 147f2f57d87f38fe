"""A reward for parking."""

import math
from typing import Annotated, ClassVar

from ai4u_edu.base.parameters import Number, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.body_in_area import check_area
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView

FULL_TURN_RAD = 2 * math.pi


class ParkedRewardFunc(RewardFunc):
    """Pays ``reward``, once an episode, when the agent is parked in an area.

    Parked means: its whole outline is inside the area; its heading is within
    ``heading_tolerance_deg`` of the area's; and its speed is at most ``max_speed`` when the
    decision is over. With ``either_way`` it may also face the opposite way, like a car that was
    backed in.

    The area should be convex (not a ring): only the corners of the outline are checked.

    Source: ours.
    """

    area: str
    """Name of the area to park in."""
    reward: Number = 1.0
    """Amount that is paid, once an episode."""
    heading_tolerance_deg: Annotated[float, quantity("deg", ge=0, le=180)] = 15.0
    """Largest angle between the agent's heading and the area's."""
    max_speed: Annotated[float, quantity("m/s", ge=0, le=100)] = 0.1
    """Largest speed of a car that counts as parked."""
    either_way: bool = True
    """True also accepts the opposite heading."""

    carried: ClassVar[tuple[str, ...]] = ("_paid",)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the area."""
        check_area(self.area, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Allow the payment again."""
        self._paid = False

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """Return the reward, or 0."""
        if self._paid or not self._parked(body, view):
            return 0.0
        self._paid = True
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Return True if the agent is parked, paid already or not."""
        return self._parked(body, view)

    def _parked(self, body: BodyView, view: WorldView) -> bool:
        if not body.on_ground or math.hypot(*body.velocity) > self.max_speed:
            return False
        area = view.areas[self.area]
        turn = FULL_TURN_RAD / 2 if self.either_way else FULL_TURN_RAD
        askew = body.heading - math.radians(area.description.heading_deg)
        if abs(math.remainder(askew, turn)) > math.radians(self.heading_tolerance_deg):
            return False
        (x, y), cos, sin = body.position, math.cos(body.heading), math.sin(body.heading)
        return all(
            area.contains(x + cos * along - sin * left, y + sin * along + cos * left)
            for along, left in body.sampled.shape.outline()
        )
