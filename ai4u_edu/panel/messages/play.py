"""Commands for the running world, the view of one page, and recorded episodes."""

from typing import Annotated, Literal

from msgspec import Meta

from ai4u_edu.panel.messages.base import Command, Name, Number, Seed


class Pause(Command, tag="pause"):
    """Pause the world."""


class Resume(Command, tag="resume"):
    """Let the world run."""


class Tick(Command, tag="tick"):
    """Pause, and tick once."""


class Decision(Command, tag="decision"):
    """Pause, and run until the agent's decision is over."""


class TryAgain(Command, tag="try_again"):
    """Begin an episode with the same start."""


class NewStart(Command, tag="new_start"):
    """Begin an episode with a new start."""


class SetSeed(Command, tag="seed"):
    """Begin an episode with a seed."""

    seed: Seed


class LockSeed(Command, tag="lock_seed"):
    """Begin each episode with the same seed from now on, or with new ones."""

    on: bool


class SetSpeed(Command, tag="speed"):
    """Set the time scale; 1 is real time."""

    speed: Annotated[float, Meta(gt=0, le=1000)] | Literal["max"]


class ShowAgent(Command, tag="agent"):
    """Show another agent."""

    agent: Name


CameraMode = Literal["arena", "follow", "turn", "eyes"]
"""Position of a page's camera: over the arena, over the agent, turning with it, in its eye."""


class Camera(Command, tag="camera"):
    """Put the camera somewhere."""

    mode: CameraMode


class ShowSensor(Command, tag="sensor"):
    """Draw a sensor in the picture, or hide it."""

    key: Name
    on: bool


class ShowTrail(Command, tag="trail"):
    """Draw the agent's trail, or hide it."""

    on: bool


class Dark(Command, tag="dark"):
    """Draw the picture in dark colours, or light ones."""

    on: bool


class ReduceMotion(Command, tag="reduce_motion"):
    """Leave out motion that nothing in the world makes, or not."""

    on: bool


class OpenEpisode(Command, tag="episode"):
    """Choose a recorded episode; 0 is the one that runs."""

    number: Number


class GoToStep(Command, tag="step"):
    """Show a decision of the chosen episode, counted from 0."""

    step: Number


class Play(Command, tag="play"):
    """Play the chosen episode."""


class Stop(Command, tag="stop"):
    """Stop playing."""


class SetPlaySpeed(Command, tag="play_speed"):
    """Set the speed of playing; 1 is the recorded speed."""

    speed: Annotated[float, Meta(ge=0.1, le=16)]


class BackToLive(Command, tag="back_to_live"):
    """Show the present again."""


class ContinueHere(Command, tag="continue"):
    """Let the world run on from the shown decision."""


class Race(Command, tag="race"):
    """Begin an episode with the same start, against a ghost of the chosen one."""


class RemoveGhost(Command, tag="remove_ghost"):
    """Remove the ghost."""


class Pin(Command, tag="pin"):
    """Keep an episode however many others come, or no longer."""

    number: Number
    on: bool


class OpenRecording(Command, tag="open_recording"):
    """Open the recording that was sent in binary messages before."""

    name: Name
    size: Number
