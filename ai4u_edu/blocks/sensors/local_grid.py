"""A sensor that reads an image of the surroundings from above."""

from typing import Annotated, Any, ClassVar

import numpy as np
from gymnasium.spaces import Box
from pydantic import Field

from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.parameters import Name, PositiveMetres
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.groups import check_groups
from ai4u_edu.blocks.sensors.pictures import ChannelLegend
from ai4u_edu.blocks.sensors.sensor import Array, Sensor, check_memory
from ai4u_edu.blocks.sensors.top_view import VOID, TopView
from ai4u_edu.world import BodyView, WorldView

Size = Annotated[int, Field(ge=1, le=512)]


class LocalGridSensor(Sensor):
    """An image of the surroundings from above that turns with the agent.

    The agent is in the middle and faces up: row 0 is farthest ahead, column 0 farthest left. Each
    cell is a square of side ``cell_size``, sampled at its centre. Each channel is a group: 255 in
    the cells that hold a body, floor or area with that tag, else 0. The channel ``void`` shows
    where there is no floor. A body thinner than a cell is drawn one cell thick, so that no wall has
    gaps. Height has no effect; a body that fell out of the world is not drawn.

    With the defaults it sees 8 m to each side::

        row 0     . . . . . . . . .        . nothing of this group: 0
                  . . . # # . . . .        # something of this group: 255
                  . . . # # . . . .
                  . . . . A . . . .        A the agent, looking up (not drawn itself)
        last row  . . . . . . . . .

    Reading: (height, width, channels), uint8, 0 or 255 (0 or 1 with ``normalized``): channels last,
    as image policies expect. When stacked, older images' channels come first: (height, width,
    stacked_observations * channels).

    Source: ours; it replaces the cameras of AI4U (Camera, Camera3DSensor, ScreenSensor) and needs
    no renderer.
    """

    width: Size = 64
    """Columns of the image."""
    height: Size = 64
    """Rows of the image."""
    cell_size: PositiveMetres = 0.25
    """Side length of a cell."""
    channels: Annotated[list[Name], Field(min_length=1, max_length=64)] = Field(
        default_factory=lambda: ["floor", "void", "wall", "target", "agent"]
    )
    """Groups (tags) that are shown, one channel each; ``void`` shows where there is no floor."""
    self_exclude: bool = True
    """True leaves out the agent's own body."""

    own_groups: ClassVar[tuple[str, ...]] = (VOID,)

    @property
    def kind(self) -> str:  # type: ignore[override]  # depends on a parameter here
        """An image, or an array of floats if normalized."""
        return "sfloatarray" if self.normalized else "simage"

    def __post_init__(self) -> None:
        super().__post_init__()
        check_memory(self, (self.height, self.width, len(self.channels)))
        for index, channel in enumerate(self.channels):
            if channel in self.channels[:index]:
                raise BlockError(
                    f"{type(self).__name__} {self.perception_key!r}: channels: expected each "
                    f"group once, got {channel!r} twice"
                )

    def space(self) -> Box:
        """Return the space of one image."""
        return Box(0, 255, (self.height, self.width, len(self.channels)), np.uint8)

    def observation_space(self) -> Box:
        """Return the space of the stacked images, joined along the channels."""
        count = len(self.channels) * self.stacked_observations
        shape = (self.height, self.width, count)
        return Box(0.0, 1.0, shape) if self.normalized else Box(0, 255, shape, np.uint8)

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Look up the groups and prepare the drawing."""
        check_groups(self, "channels", view)
        self._top_view = TopView(
            self.width, self.height, self.cell_size, self.channels, self.self_exclude
        )

    def write(self, out: Array, body: BodyView, view: WorldView) -> None:
        """Draw one image."""
        planes = self._top_view.draw(body, view)
        # the negative of 1 in 8 bits is 255
        np.negative(planes.transpose(1, 2, 0), out=out, casting="unsafe")

    def legend(self) -> ChannelLegend:
        """Return the group of each channel."""
        return ChannelLegend(tuple(self.channels))

    def _unstack(self) -> None:
        count = len(self.channels)
        self._out[..., count:] = self._out[..., :-count].copy()

    def _stack(self, reading: Any) -> None:
        out, count = self._out, len(self.channels)
        if self.stacked_observations == 1:
            out[...] = reading
        elif self._fresh:
            out[...] = np.tile(reading, self.stacked_observations)
        else:
            out[..., :-count] = out[..., count:]
            out[..., -count:] = reading
