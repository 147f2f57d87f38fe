"""An actuator that draws on the floor."""

import math
from typing import Annotated, ClassVar, Literal

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.parameters import Metres, quantity
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, WorldView
from ai4u_edu.world.ink import CELL_M, ink_code

LEAST_STROKE_M = 0.8 * CELL_M
"""Way after which a pen that moves draws the next stroke."""
PenColour = Literal[
    "black",
    "orange",
    "sky blue",
    "green",
    "yellow",
    "blue",
    "vermillion",
    "purple",
    "grey",
    "light grey",
    "white",
    "none",
]
"""Colours of ink; "none" wipes ink away."""


class PenActuator(Actuator):
    """A pen that draws on the floor: [down], and where there are several, [down, colour, width].

    Above 0.5 the pen goes down, and it stays down until the number is 0.5 or less; a decision
    without this action changes nothing. While it is down, the pen leaves ink on the floor wherever
    the robot goes. It reaches the floor that the body stands on, and draws nothing in the air, on a
    box or over the void.

    With several ``colours``, the second number chooses one: 0 is the first, 1 the next one. The
    colour "none" wipes ink away. With ``max_width``, the last number chooses the width: 0 is
    ``width``, 1 is ``max_width``.

    Ink stays when the agent begins again, and goes with a new start of the world. A ColourSensor
    and a LineSensor see it.

    Source: ours; after the pen of Logo's turtle.
    """

    action_name: str = "pen"
    colours: Annotated[list[PenColour], Field(min_length=1, max_length=12)] = Field(
        default_factory=lambda: list[PenColour](["black"])
    )
    """Colours to choose from."""
    width: Annotated[float, quantity("m", gt=0, le=2)] = 0.1
    """Width of its line; the narrowest is 0.05 m."""
    max_width: Annotated[float, quantity("m", gt=0, le=2)] | None = None
    """Largest width that an action can choose; left out: all lines have ``width``."""
    ahead: Metres = 0.0
    """Distance of the pen in front of the body's centre; negative: behind it."""

    carried: ClassVar[tuple[str, ...]] = (
        "_is_down",
        "_code",
        "_width",
        "_last",
        "_is_fresh",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        self._codes = [ink_code(colour) for colour in self.colours]
        self._lift()

    def _lift(self) -> None:
        self._is_down = False
        self._code, self._width = self._codes[0], self.width
        self._last: tuple[float, float] | None = None
        """End of the last stroke while the pen is down."""
        self._is_fresh = False
        """True until the first stroke."""

    @property
    def is_down(self) -> bool:
        """True while it draws."""
        return self._is_down

    def space(self) -> Box:
        """Return the range of each number."""
        high = [1.0]
        if len(self.colours) > 1:
            high.append(len(self.colours) - 1.0)
        if self.max_width is not None:
            high.append(1.0)
        return Box(np.zeros(len(high), np.float32), np.array(high, np.float32))

    def slots(self) -> tuple[str, ...]:
        """Return the names of the numbers."""
        colour = ("colour",) if len(self.colours) > 1 else ()
        return ("down", *colour, *(("width",) if self.max_width is not None else ()))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Find the colours' codes."""
        self._codes = [ink_code(colour) for colour in self.colours]

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Lift the pen."""
        self._lift()

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        """Put the pen down or lift it, and choose colour and width."""
        self._is_down = action[0] > 0.5
        if len(self.colours) > 1:
            self._code = self._codes[round(action[1])]
        if self.max_width is not None:
            self._width = self.width + action[-1] * (self.max_width - self.width)
        if self._is_down and self._last is None:
            self._last, self._is_fresh = self._point(body), True
        elif not self._is_down and self._last is not None:
            self._draw(body, self._point(body))
            self._last = None

    def on_tick(self, body: Body, view: WorldView) -> None:
        """Draw the way of this tick."""
        if not self._is_down or self._last is None:
            return
        here = self._point(body)
        if not body.on_ground:  # it draws again where it lands
            self._last, self._is_fresh = here, True
            return
        # a stroke takes as long for a few millimetres as for a cell
        if self._is_fresh or math.dist(self._last, here) >= LEAST_STROKE_M:
            self._draw(body, here)

    def _draw(self, body: Body, here: tuple[float, float]) -> None:
        if self._last is not None:
            body.draw(self._last, here, width=self._width, code=self._code)
        self._last, self._is_fresh = here, False

    def _point(self, body: Body) -> tuple[float, float]:
        (x, y), ahead = body.position, self.ahead
        if not ahead:
            return x, y
        heading = body.heading
        return x + math.cos(heading) * ahead, y + math.sin(heading) * ahead
