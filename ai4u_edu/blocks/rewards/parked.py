"""Pays for a good parking."""

import math
from typing import Annotated

from ai4u_edu.base.parameters import Number, quantity
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.rewards.body_in_area import check_area
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.world import BodyView, WorldView

ROUND = 2 * math.pi


class ParkedRewardFunc(RewardFunc):
    """Pays ``reward``, once an episode, when the agent stands in an area as a parked car should.

    That is: no part of its outline sticks out of the area; its heading is within
    ``heading_tolerance_deg`` of the area's; and it is no faster than ``max_speed`` when the
    decision is over. With ``either_way`` it may as well look the other way, as a car that was
    backed in.

    The area should be a convex one (no ring): then nothing sticks out if no corner does.

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
    """True also takes a car that looks the opposite way."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the area."""
        check_area(self.area, view)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Forgets what was paid."""
        self._paid = False

    def on_update(self, body: BodyView, view: WorldView) -> float:
        """The reward, or 0."""
        if self._paid or not self._parked(body, view):
            return 0.0
        self._paid = True
        return self.reward

    def holds(self, paid: float, body: BodyView, view: WorldView) -> bool:
        """Tell whether the agent stands as it should, paid already or not."""
        return self._parked(body, view)

    def _parked(self, body: BodyView, view: WorldView) -> bool:
        if not body.on_ground or math.hypot(*body.velocity) > self.max_speed:
            return False
        area = view.areas[self.area]
        turn = ROUND / 2 if self.either_way else ROUND
        askew = body.heading - math.radians(area.description.heading_deg)
        if abs(math.remainder(askew, turn)) > math.radians(self.heading_tolerance_deg):
            return False
        (x, y), cos, sin = body.position, math.cos(body.heading), math.sin(body.heading)
        return all(
            area.contains(x + cos * along - sin * left, y + sin * along + cos * left)
            for along, left in body.sampled.shape.outline()
        )
