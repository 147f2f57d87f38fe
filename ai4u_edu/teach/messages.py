"""Commands of the tab in which an agent is taught, and its part."""

from typing import Annotated, Literal

from msgspec import Meta, Struct

from ai4u_edu.page.messages import Name, Number, PageCommand
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.teach.drives import MAX_DRIVES
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.networks import MAX_TITLE_CHARS

Opponent = Literal["player", "self", "file"]
"""Player of the other side in a practice: the scene's player, the network itself, a network."""
MIN_STEPS, MAX_STEPS = 256, 1_000_000
"""Fewest and most decisions of a practice."""

Factors = Annotated[dict[Name, Annotated[float, Meta(ge=-1000, le=1000)]], Meta(max_length=64)]


class LearnFromDrives(PageCommand, tag="teach_learn"):
    """Have a network learn from drives of the agent that the page shows, and let it drive then."""

    drives: Annotated[list[Number], Meta(min_length=1, max_length=MAX_DRIVES)]
    """Numbers of the drives."""


class StopLearning(PageCommand, tag="teach_stop"):
    """End the learning without a result."""


class PractiseForRewards(PageCommand, tag="teach_practise"):
    """Have a network practise for rewards with the page's agent, and drive it meanwhile."""

    steps: Annotated[int, Meta(ge=MIN_STEPS, le=MAX_STEPS)]
    """Decisions to learn from."""
    weights: Factors
    """Factors of reward terms by name; 1 for one that is left out."""
    begin_with: Number | None = None
    """Number of a network to begin with; null for a new one."""
    against: Opponent | None = None
    """Player of the other side; null if all others are driven as the scene says."""
    opponent: Number | None = None
    """Number of the network that plays the other side; null for none."""


class PutRewards(PageCommand, tag="teach_put_rewards"):
    """Multiply the scene's own rewards of the page's agent by factors."""

    weights: Factors


class PausePractising(PageCommand, tag="teach_pause"):
    """Let the practice wait; it can go on after a restart of the world, too."""


class GoOnPractising(PageCommand, tag="teach_go_on"):
    """Go on with the practice that waits."""


class StopPractising(PageCommand, tag="teach_stop_practising"):
    """End the practice; the best network until then is kept."""


class ForgetDrive(PageCommand, tag="teach_forget_drive"):
    """Delete a drive."""

    drive: Number


class DriveNetwork(PageCommand, tag="teach_drive"):
    """Let a network drive the agent that the page shows."""

    network: Number


class RenameNetwork(PageCommand, tag="teach_rename"):
    """Give a network another title."""

    network: Number
    title: Annotated[str, Meta(max_length=MAX_TITLE_CHARS)]


class DeleteNetwork(PageCommand, tag="teach_delete"):
    """Delete a network."""

    network: Number
    even_if_driving: bool = False
    """True deletes one that drives, too; the scene's own driver takes its place."""


class OpenNetwork(PageCommand, tag="teach_open"):
    """Keep the network in the file that the page has sent."""

    name: Name
    """Name of the file."""
    size: Number


class DownloadNetwork(PageCommand, tag="teach_download"):
    """Return a network's file: its `name`, and its bytes in base64 as `data`."""

    network: Number


class ReplayPractice(PageCommand, tag="teach_replay"):
    """Show an episode of a network's practice in the player of recorded episodes."""

    network: Number
    decisions: Number
    """Decisions that the network had learned from then, one of its replays."""


class TaughtDrive(Struct, frozen=True):
    """A person's finished drive of the agent."""

    number: int
    """Number among those of its scene."""
    result: bool | None
    """True if an agent reached the goal; null for a scene without a goal."""
    seconds: float
    """Duration (s) in world time."""
    decisions: int
    """Decisions that the person took."""
    share: float
    """Share of the agent's decisions that the person took, above 0, up to 1."""
    reason: str
    """Reason why the agent can't learn from it, in a few words; empty if it can."""


class LearningState(Struct, frozen=True):
    """State of the latest learning of the agent."""

    is_over: bool
    """True once it is done, has failed or was stopped."""
    problem: str
    """Sentence about why it brought nothing; empty if it is under way or done."""
    waiting: str
    """Sentence about what it waits for; empty if it learns or is over."""
    errors: list[float]
    """Errors on held-out moments, at equal distances of gradient steps."""
    drives: int
    """Drives that it learns from."""
    decisions: int
    """Decisions that it learned from; 0 until it is done."""
    alike: float
    """Share of held-out moments in which the network acts like the person."""
    commonest: float
    """The same share for always doing what was done most often."""
    remarks: list[str]
    """Sentences about what is wrong with the drives."""


class PracticeState(Struct, frozen=True):
    """State of the latest practice."""

    phase: Literal["running", "paused", "over"]
    problem: str
    """Sentence about why it ended early; empty if it did not."""
    waiting: str
    """Sentence about what it waits for; empty if it learns, is paused or over."""
    elsewhere: str
    """Agent and scene, if they are not what the page shows; empty otherwise."""
    is_scene_changed: bool
    """True if the scene was changed since; it goes on in the scene as it was."""
    hint: str
    """Sentence about what to change if it gets no better; empty if it does."""
    seconds_left: float | None
    """Time (s) until it ends at the latest; null before its first check."""
    decisions: int
    """Decisions that it has learned from."""
    total: int
    """Decisions after which it ends at the latest."""
    rewards: list[float]
    """Mean reward of an episode, by the weights, at each check."""
    success: float | None
    """Share of the episodes of the latest check that reached the goal; null if there was none."""
    easy_starts: float | None
    """Way from easy starts (0) to all starts (1); null in a scene without easy ones."""
    is_game: bool
    """True if these episodes are games against somebody."""


class TaughtNetwork(Struct, frozen=True):
    """A network that learned in this scene."""

    number: int
    """Number among those of its scene."""
    title: str
    how: str
    """Sentence about how it learned."""
    made_at: float
    """Time (s since 1970) at which it was kept; 0 if it is not known."""
    facts: list[str]
    """Sentences about its rewards, drives and settings."""
    replays: list[int]
    """Decisions of its practice after which an episode was kept, ascending."""
    score: NetworkScore | None
    """Starts from which it reaches the goal; null if that is not known."""
    is_driving: bool
    """True if it drives the agent now."""


class TeachPart(PanelPart, frozen=True, kw_only=True):
    """Drives that an agent can learn from, and its networks."""

    name: Literal["teach"] = "teach"
    agent: str
    """Id of the agent that the page shows."""
    problem: str
    """Sentence about why the agent can't be taught; empty if it can."""
    drives: list[TaughtDrive]
    """A person's finished drives of the agent, the latest first."""
    learning: LearningState | None
    """The latest learning of the agent; null if there was none since the start."""
    rewards: list[str]
    """Names of the agent's reward terms."""
    opponents: list[Opponent]
    """Possible players of the other side in a practice; empty in a scene without one."""
    practice: PracticeState | None
    """The practice that runs or is paused, or the agent's latest one; null if there is none."""
    decisions_per_s: float | None
    """Decisions that such a practice learns from in a second; null before the first check."""
    networks: list[TaughtNetwork]
    """Networks of this scene, the latest first."""
    max_networks: int
    """Networks that are kept for a scene."""
    max_network_bytes: int
    """Size of a network's file at most."""
    opening: str
    """Sentence about the file that is being opened; empty if none is."""
    warning: str
    """Sentence about why a drive could not be kept; empty if all could."""
