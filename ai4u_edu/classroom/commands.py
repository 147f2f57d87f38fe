"""The teacher's commands, as the page sends them."""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, RootModel

from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.classroom.attention import MAX_SECONDS
from ai4u_edu.classroom.scene_source import LessonOrScene, SceneSource
from ai4u_edu.classroom.tournament.entrants import System
from ai4u_edu.wire.class_link import MAX_MESSAGE_CHARS, MAX_STARTING_PROGRAM_CHARS

MAX_COUNTDOWN_S = 60.0
MAX_TOURNAMENT_SEEDS = 20
MAX_GAMES = 10**6
RoomId = Annotated[str, Field(max_length=40)]
Seed = Annotated[int, Field(ge=0, le=MAX_SEED)]
Seconds = Annotated[float, Field(ge=0, le=MAX_SECONDS, allow_inf_nan=False)]


class _Command(BaseModel):
    model_config = ConfigDict(extra="forbid")


class SeatCommand(_Command):
    """Send a seat out, ban it, or give it another name."""

    do: Literal["kick", "ban", "rename"]
    seat: int
    name: str = Field(default="", max_length=60)
    new_code: bool = False
    """True with a ban to set a new code too, since who knows the old one may join again."""


class MoveCode(_Command):
    """Return a code with which a student takes a seat again, whatever its state is."""

    do: Literal["move code"]
    seat: int


class PlainCommand(_Command):
    """A command without arguments."""

    do: Literal[
        "new code",
        "open",
        "close",
        "end race",
        "cancel tournament",
        "close tournament",
        "forget",
    ]


class Assign(_Command):
    """Give rooms a scene, or a lesson."""

    do: Literal["assign"]
    rooms: list[RoomId] | Literal["all"]
    scene: LessonOrScene
    seed: Seed | None = None
    """Seed of all these worlds."""
    same_seed: bool = False
    """True without a seed: a random one, the same for all."""
    program: str = Field(default="", max_length=MAX_STARTING_PROGRAM_CHARS)
    """Python that students may begin with."""


class Attend(_Command):
    """Ask for attention; without kind and message, end it."""

    do: Literal["attention"]
    kind: Literal["", "pause", "blank"]
    message: str = Field(default="", max_length=MAX_MESSAGE_CHARS)
    seconds: Seconds = 0.0


class StartRace(_Command):
    """Start a race."""

    do: Literal["race"]
    scene: SceneSource
    seed: Seed | None = None
    countdown: float = Field(default=5.0, ge=0, le=MAX_COUNTDOWN_S, allow_inf_nan=False)
    hide_board: bool = False


class BeginTournament(_Command):
    """Begin a tournament: students hand in networks for its scene."""

    do: Literal["tournament"]
    scene: str = Field(max_length=60)
    """Name in the library."""


class StartTournament(_Command):
    """Play the present tournament."""

    do: Literal["start tournament"]
    seeds: int = Field(default=1, ge=1, le=MAX_TOURNAMENT_SEEDS)
    """Seeds of each pair's duels, or of races."""
    system: System = "round-robin"
    own_player: bool = False
    """True if the scene's own player takes part."""


class HideBoard(_Command):
    """Hide the board of the race from students, or show it."""

    do: Literal["board"]
    hide: bool


class Show(_Command):
    """Choose what the projector page shows."""

    do: Literal["show"]
    kind: Literal["join", "room", "race", "tournament", "game", "board"]
    room: RoomId = ""
    game: int = Field(default=0, ge=0, le=MAX_GAMES)
    """Number of a game of the tournament, for its recording."""


class Sleep(_Command):
    """End the process of a room; it starts again when its page is opened."""

    do: Literal["sleep"]
    room: RoomId


AnyCommand = (
    SeatCommand
    | MoveCode
    | PlainCommand
    | Assign
    | Attend
    | StartRace
    | BeginTournament
    | StartTournament
    | HideBoard
    | Show
    | Sleep
)


class Command(RootModel[Annotated[AnyCommand, Field(discriminator="do")]]):
    """Body of a command."""
