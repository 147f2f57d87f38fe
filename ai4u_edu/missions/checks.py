"""The kinds of checks of a mission: each follows what happens in a world until it is satisfied.

A check is data, with parameters. Its :meth:`Check.follow` is a generator: it yields how far it is,
in words, receives what happens, and returns when it is satisfied. It reads nothing else, so the
same events give the same result, whoever drives and wherever the world runs.
"""

import math
from collections import deque
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, StringConstraints, field_validator, model_validator

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.driving_keys import active_brain, has_driving_keys
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.blocks import Block, LinearRayCastingSensor, NeuralNetController, RemoteBrain
from ai4u_edu.blocks.sensors.ray_sensor import spread
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import has_fallen
from ai4u_edu.world.shapes import Description

Driver = Literal["keys", "program", "network", "controller"]
"""Kinds of drivers; blocks are a program, and a controller is one that comes with the package."""
Tab = Literal["drive", "build", "world", "code", "past", "teach"]
"""Tabs of the panel by their names in the page."""
AHEAD_DEG = 20.0
"""Angle (degrees) up to which a ray looks ahead, as in the blocks of programs."""
MAX_TIMES = 1000
MINUS = "\N{MINUS SIGN}"
"""The page writes numbers below 0 with it."""
MAX_TEXT_CHARS = 400
Times = Annotated[int, Field(ge=1, le=MAX_TIMES)]
Text = Annotated[str, StringConstraints(min_length=1, max_length=MAX_TEXT_CHARS)]
Follow = Generator[str, Any, None]
"""Yields how far a check is; receives events of the type that it listens to."""


# -- events ----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Decision:
    """One decision of an agent, when its percept and reward are final."""

    driver: Driver
    episode: int
    """Number of the agent's episode."""
    step: int
    """Number of the decision in it, from 1; 0 for the moment before the first one."""
    seed: int
    seconds: float
    """Time (s) in the world since its reset."""
    x: float
    """Place of the body (m)."""
    y: float
    heading: float
    """Heading (rad), counter-clockwise."""
    speed: float
    """Speed (m/s), above 0 forward."""
    turning: float
    """Turning speed (degrees/s), above 0 to the left."""
    terms: Mapping[str, float]
    """Reward of the decision, by term."""
    outcome: Literal["", "goal", "fell", "time", "over"]
    """End of the episode; empty before it."""
    percept: Mapping[str, Any] = field(repr=False)
    distances: Mapping[str, float] = field(repr=False)
    """Distance (m) to what is nearest, by the side: around, ahead, left, right; empty without a
    flat fan of rays that read distances."""
    network: str = ""
    """File of the network that drives; empty for another driver."""

    def value_of(self, what: str) -> float:
        """Return a quantity, such as ``speed``, ``distance ahead`` or a number of a sensor."""
        if what in ("speed", "turning"):
            return self.speed if what == "speed" else self.turning
        if what.startswith("distance "):
            return self.distances[what.removeprefix("distance ")]
        key, _, part = what.rstrip("]").partition("[")
        return float(np.asarray(self.percept[key]).reshape(-1)[int(part or 0)])


@dataclass(frozen=True)
class SeenPage:
    """The tab that a person has open in the page."""

    tab: str


@dataclass(frozen=True)
class PersonAnswer:
    """An answer that a person has typed or chosen, and the decision before it."""

    text: str
    decision: Decision | None


@dataclass(frozen=True)
class Verdict:
    """The opinion of an exercise's judge on a person's work."""

    passed: bool
    text: str


Event = Decision | SeenPage | PersonAnswer | Verdict | SceneDescription


def decision_of(sim: ControlRequestor, agent: BasicAgent) -> Decision:
    """Return an agent's latest decision, for checks; call it in its event ``percept_ready``."""
    body, percept = agent.body, agent.percept
    (x, y), (vx, vy) = body.position, body.velocity
    outcome: Literal["", "goal", "fell", "time", "over"] = ""
    if agent.done:
        has_succeeded = agent.ledger.episode_terms.get(sim.success, 0.0) > 0
        outcome = "fell" if has_fallen(agent) else "time" if agent.truncated else "over"
        outcome = "goal" if has_succeeded else outcome
    return Decision(
        driver=driver_of(agent),
        episode=agent.episode,
        step=agent.steps,
        seed=sim.world.seeds.seed,
        seconds=sim.world.time,
        x=x,
        y=y,
        heading=body.heading,
        speed=vx * math.cos(body.heading) + vy * math.sin(body.heading),
        turning=math.degrees(body.angular_velocity),
        terms=dict(agent.ledger.terms) if agent.steps else {},
        outcome=outcome,
        percept=percept,
        distances=_distances(agent),
        network=getattr(getattr(active_brain(agent.brain), "controller", None), "model_path", ""),
    )


def driver_of(agent: BasicAgent) -> Driver:
    """Return the kind of driver that decides for an agent now."""
    if has_driving_keys(agent):
        return "keys"
    brain = active_brain(agent.brain)
    if isinstance(brain, RemoteBrain):
        return "program"
    controller = getattr(brain, "controller", None)
    return "network" if isinstance(controller, NeuralNetController) else "controller"


def _distances(agent: BasicAgent) -> dict[str, float]:
    """Return the nearest distance (m) of each side, by the agent's first flat fan of rays."""
    sensor = ray_sensor_of(agent)
    if sensor is None:
        return {}
    width = 1 + sensor.return_code
    numbers = np.asarray(agent.percept[sensor.perception_key]).reshape(-1, width)[:, -1]
    metres = np.where(numbers == 0, 1.0, numbers / sensor.farthest) * sensor.vision_max_distance
    angles = np.degrees(spread(sensor.number_of_rays, sensor.field_of_view))
    angles = angles - sensor.horizontal_shift
    sides = {
        "around": np.full(len(angles), fill_value=True),
        "ahead": np.abs(angles) <= AHEAD_DEG,
        "left": angles > AHEAD_DEG,
        "right": angles < -AHEAD_DEG,
    }
    return {side: float(metres[rays].min()) for side, rays in sides.items() if rays.any()}


def ray_sensor_of(agent: BasicAgent) -> LinearRayCastingSensor | None:
    """Return the sensor by which a check knows distances; None if the agent has none."""
    for sensor in agent.sensors:
        if isinstance(sensor, LinearRayCastingSensor) and sensor.stacked_observations == 1:
            return sensor if sensor.return_distance else None
    return None


# -- checks ----------------------------------------------------------------------------------------


class Check(Description):
    """The base of all kinds of checks."""

    listens: ClassVar[type[Event]] = Decision
    """The type of events that it follows."""
    begins_with_latest: ClassVar[bool] = False
    """True if it compares the first decision with the latest one before it."""

    def follow(self) -> Follow:
        """Follow events until the check is satisfied."""
        raise NotImplementedError

    def quantities(self) -> Sequence[str]:
        """Return the quantities that it reads, to be looked for in a scene."""
        return ()

    def fit(self, agent: BasicAgent) -> None:
        """Check that an agent has what it reads.

        Raises:
            SetupError: it has not; the text suggests what it has.
        """
        for what in self.quantities():
            _find(what, agent)


class Drives(Check):
    """The robot drives some metres; pushed or carried ones do not count."""

    begins_with_latest = True
    type: Literal["drives"] = "drives"
    metres: Annotated[float, Field(gt=0, le=1000)]
    way: Literal["forward", "backward", "any"] = "any"

    def follow(self) -> Follow:
        """Add the distances between decisions of an episode, along the heading."""
        driven, before = 0.0, None
        while driven < self.metres:
            now: Decision = yield f"{driven:.1f} of {self.metres:g} m"
            if before is not None and before.episode == now.episode:
                dx, dy = now.x - before.x, now.y - before.y
                along = dx * math.cos(before.heading) + dy * math.sin(before.heading)
                ways = {"forward": along, "backward": -along, "any": abs(along)}
                driven += max(0.0, ways[self.way])
            before = now


class Turns(Check):
    """The robot turns by some degrees; turning back is taken off."""

    begins_with_latest = True
    type: Literal["turns"] = "turns"
    degrees: Annotated[float, Field(gt=0, le=36000)]
    way: Literal["left", "right", "any"] = "any"

    def follow(self) -> Follow:
        """Add the changes of the heading between decisions of an episode."""
        turned, before, best = 0.0, None, 0.0
        while best < self.degrees:
            now: Decision = yield f"{best:.0f} of {self.degrees:g} degrees"
            if before is not None and before.episode == now.episode:
                turned += math.degrees(math.remainder(now.heading - before.heading, 2 * math.pi))
                ways = {"left": turned, "right": -turned, "any": abs(turned)}
                best = max(best, ways[self.way])
            else:
                turned = 0.0
            before = now


class ReachesGoal(Check):
    """The scene's goal is reached in whole episodes, each driven from its start."""

    type: Literal["reaches_goal"] = "reaches_goal"
    times: Times = 1
    of: Times | None = None
    """Number of the latest starts among which it counts, all of them different; null for any."""
    seconds: Annotated[float, Field(gt=0, le=3600)] | None = None
    """Longest time (s) in the world."""
    decisions: Times | None = None
    """Most decisions of an episode."""

    @model_validator(mode="after")
    def _can_be_reached(self) -> Self:
        if self.of is not None and self.times > self.of:
            raise ValueError(f"expected times of at most {self.of}, as in of, got {self.times}")
        return self

    def follow(self) -> Follow:
        """Count the ends of episodes whose first decision was seen."""
        ends: deque[tuple[int, bool]] = deque(maxlen=self.of)
        begun = None
        while sum(is_goal for _, is_goal in ends) < self.times:
            now: Decision = yield self._words(ends)
            if now.step <= 1:
                begun = now.episode
            if not now.outcome or begun != now.episode:
                continue
            begun = None
            is_goal = now.outcome == "goal" and self._is_fast(now)
            if self.of is not None:  # a start that is tried again takes the place of the one before
                same = [end for end in ends if end[0] == now.seed]
                for end in same:
                    ends.remove(end)
            ends.append((now.seed, is_goal))

    def _is_fast(self, end: Decision) -> bool:
        is_in_time = self.seconds is None or end.seconds <= self.seconds
        return is_in_time and (self.decisions is None or end.step <= self.decisions)

    def _words(self, ends: "deque[tuple[int, bool]]") -> str:
        goals = sum(is_goal for _, is_goal in ends)
        if self.of is not None:
            return f"goal from {goals} of the last {len(ends)} starts; {self.times} are needed"
        return f"{goals} of {self.times} times" if self.times > 1 else ""


class IsPaid(Check):
    """A reward term is paid, several times in one episode."""

    type: Literal["is_paid"] = "is_paid"
    reward: Annotated[str, StringConstraints(max_length=80)] = ""
    """Name of the term; empty for any."""
    times: Times = 1

    def follow(self) -> Follow:
        """Count the decisions that pay more than 0."""
        count, episode = 0, None
        while count < self.times:
            now: Decision = yield f"{count} of {self.times}" if self.times > 1 else ""
            if now.episode != episode:
                count, episode = 0, now.episode
            paid = now.terms.values() if not self.reward else [now.terms.get(self.reward, 0.0)]
            count += max(paid, default=0.0) > 0

    def fit(self, agent: BasicAgent) -> None:
        """Check that the agent is paid such a reward."""
        names = [reward.name for reward in agent.rewards]
        if self.reward and self.reward not in names:
            raise SetupError(
                f"the robot gets no reward {self.reward!r}; {suggest(self.reward, names)}"
            )


class Range(Description):
    """A quantity that lies in a range."""

    what: Annotated[str, StringConstraints(min_length=1, max_length=80)]
    """``speed`` (m/s), ``turning`` (degrees/s, left above 0), ``distance ahead`` (m; or left,
    right, around), a sensor's name, or one of its numbers such as ``bearing[1]``."""
    above: float | None = None
    below: float | None = None

    @model_validator(mode="after")
    def _has_a_limit(self) -> Self:
        if self.above is None and self.below is None:
            raise ValueError("expected above, below or both, got none")
        return self

    def has(self, decision: Decision) -> bool:
        """Return True if the quantity lies in the range; a robot may not sense it yet."""
        try:
            value = decision.value_of(self.what)
        except (KeyError, IndexError):
            return False
        is_above = self.above is None or value > self.above
        return is_above and (self.below is None or value < self.below)


class Holds(Check):
    """Quantities lie in ranges at the same time, for some decisions in a row."""

    type: Literal["holds"] = "holds"
    ranges: Annotated[list[Range], Field(min_length=1, max_length=8)]
    decisions: Times = 12
    share: Annotated[float, Field(gt=0, le=1)] = 1.0
    """Share of the latest decisions in which they have to."""
    word: Annotated[str, StringConstraints(max_length=80)] = ""
    """A name for what is counted, such as ``beside the wall``."""

    def follow(self) -> Follow:
        """Look at the latest decisions of an episode."""
        latest: deque[bool] = deque(maxlen=self.decisions)
        needed = math.ceil(self.share * self.decisions)
        episode = None
        while sum(latest) < needed:
            count = f"{sum(latest)} of {needed} decisions"
            now: Decision = yield f"{self.word}: {count}" if self.word else count
            if now.episode != episode:
                latest.clear()
                episode = now.episode
            has_all = all(each.has(now) for each in self.ranges)
            if not has_all and self.share == 1.0:
                latest.clear()
            else:
                latest.append(has_all)

    def quantities(self) -> Sequence[str]:
        """Return those of the ranges."""
        return [each.what for each in self.ranges]


class Starts(Check):
    """Episodes begin, after the present one."""

    begins_with_latest = True
    type: Literal["starts"] = "starts"
    times: Times = 1
    place: Literal["any", "same", "other"] = "any"
    """``same`` for the same start again, ``other`` for another one."""

    def follow(self) -> Follow:
        """Count first moments of episodes, by their seeds."""
        count, before = 0, None
        while count < self.times:
            now: Decision = yield f"{count} of {self.times}" if self.times > 1 else ""
            if before is not None and now.episode != before.episode:
                is_same = now.seed == before.seed
                count += self.place == "any" or is_same == (self.place == "same")
            before = now


class Ends(Check):
    """An episode ends in some way."""

    type: Literal["ends"] = "ends"
    outcome: Literal["goal", "fell", "time", "over", "any"] = "any"
    times: Times = 1

    def follow(self) -> Follow:
        """Count the ends of episodes."""
        count, episode = 0, None
        while count < self.times:
            now: Decision = yield f"{count} of {self.times}" if self.times > 1 else ""
            is_new = now.episode != episode
            if now.outcome and is_new:
                episode = now.episode
                count += self.outcome in ("any", now.outcome)


class Decides(Check):
    """The driver that the step asks for takes some decisions."""

    type: Literal["decides"] = "decides"
    decisions: Times

    def follow(self) -> Follow:
        """Count decisions."""
        count = 0
        while count < self.decisions:
            now: Decision = yield f"{count} of {self.decisions} decisions"
            count += now.step > 0


class Opens(Check):
    """The person opens a tab."""

    listens = SeenPage
    type: Literal["opens"] = "opens"
    tab: Tab

    def follow(self) -> Follow:
        """Wait for the tab."""
        view: SeenPage = yield ""
        while view.tab != self.tab:
            view = yield ""


class Reads(Check):
    """The person types the number that a quantity has at this moment."""

    listens = PersonAnswer
    type: Literal["reads"] = "reads"
    question: Text
    what: Annotated[str, StringConstraints(min_length=1, max_length=80)]
    within: Annotated[float, Field(gt=0)]
    """Largest difference that is still right."""

    def follow(self) -> Follow:
        """Compare answers with the quantity."""
        words = ""
        while True:
            answer: PersonAnswer = yield words
            if answer.decision is None:
                words = "Drive a little first."
                continue
            try:
                number = float(answer.text.strip().replace(MINUS, "-").replace(",", "."))
            except ValueError:
                words = f"Type a number, such as 0.5, not “{answer.text[:20]}”."
                continue
            try:
                value = answer.decision.value_of(self.what)
            except (KeyError, IndexError):
                words = f"The robot senses no {self.what} yet."
                continue
            if abs(number - value) <= self.within:
                return
            words = f"Not {number:g}. Look at the number again."

    def quantities(self) -> Sequence[str]:
        """Return the quantity."""
        return [self.what]


class Chooses(Check):
    """The person chooses the right one of several answers."""

    listens = PersonAnswer
    type: Literal["chooses"] = "chooses"
    question: Text
    options: Annotated[list[Text], Field(min_length=2, max_length=6)]
    right: Text

    @field_validator("right")
    @classmethod
    def _is_an_option(cls, right: str, info: Any) -> str:
        options = info.data.get("options", [right])
        if right not in options:
            hint = suggest(right, options)
            raise ValueError(f"expected one of the options, got {right!r}; {hint}")
        return right

    def follow(self) -> Follow:
        """Compare answers with the right one."""
        words = ""
        while True:
            answer: PersonAnswer = yield words
            if answer.text == self.right:
                return
            shown = library_text(answer.text[:80])
            words = _("Not “{answer}”. Try it in the world.", answer=shown)


class Solves(Check):
    """The person's function is right, as the judge of the mission's exercise says."""

    listens = Verdict
    type: Literal["solves"] = "solves"

    def follow(self) -> Follow:
        """Wait for a verdict that it is."""
        words = ""
        while True:
            verdict: Verdict = yield words
            if verdict.passed:
                return
            words = verdict.text


class Builds(Check):
    """The scene has things with a tag, or the robot has blocks of a kind."""

    listens = SceneDescription
    type: Literal["builds"] = "builds"
    tag: Annotated[str, StringConstraints(max_length=80)] = ""
    """Tag of the things, such as ``wall`` or ``target``."""
    block: Annotated[str, StringConstraints(max_length=80)] = ""
    """Class of the block, such as ``TouchReward``; of a first robot."""
    kind: Literal["", "sensors", "rewards", "actuators"] = ""
    """Kind of blocks, whatever class they have."""
    values: dict[str, bool | float | str] = Field(default_factory=dict)
    """Parameters that the blocks have, such as ``move_amount: 2``."""
    count: Times = 1

    @model_validator(mode="after")
    def _looks_at_something(self) -> Self:
        if not (self.tag or self.block or self.kind):
            raise ValueError("expected a tag, a block or a kind of blocks to look for, got none")
        known = Block.types[self.block].parameters() if self.block in Block.types else self.values
        for name in self.values:
            if name not in known:
                hint = suggest(name, known)
                raise ValueError(f"{self.block} has no parameter {name!r}; {hint}")
        return self

    def follow(self) -> Follow:
        """Count in each state of the scene."""
        found = 0
        while found < self.count:
            scene: SceneDescription = yield f"{found} of {self.count}" if self.count > 1 else ""
            found = self._count(scene)

    def _count(self, scene: SceneDescription) -> int:
        if self.tag:
            return sum(self.tag in body.tags for body in scene.bodies)
        kinds = (self.kind,) if self.kind else ("sensors", "rewards", "actuators")
        blocks = [block for kind in kinds for block in scene.agents[0].get(kind, ())]
        return sum(
            self.block in ("", block.get("type"))
            and all(_value_in(block, name) == value for name, value in self.values.items())
            for block in blocks
        )


def _value_in(block: Mapping[str, Any], name: str) -> Any:
    """Return a parameter of a block as it is in a scene, where defaults are left out."""
    field = Block.types[block["type"]].parameters().get(name)
    if name in block or field is None:
        return block.get(name)
    return field.get_default(call_default_factory=True)


AnyCheck = Annotated[
    Drives
    | Turns
    | ReachesGoal
    | IsPaid
    | Holds
    | Starts
    | Ends
    | Decides
    | Opens
    | Reads
    | Chooses
    | Solves
    | Builds,
    Field(discriminator="type"),
]
"""All kinds of checks."""


class Following:
    """A check that is being followed.

    Args:
        check: the check.
        latest: the latest decision before it; None if there was none.

    >>> following = Following(Opens(tab="code"))
    >>> following.see(SeenPage("drive")); following.is_done
    False
    >>> following.see(SeenPage("code")); following.is_done
    True
    """

    def __init__(self, check: Check, latest: Decision | None = None) -> None:
        self.check = check
        self.is_done = False
        self._events = check.follow()
        self.words = next(self._events)
        """Words on how far it is; empty if there is nothing to say."""
        if latest is not None and check.begins_with_latest:
            self.see(latest)

    def see(self, event: Event) -> None:
        """Let the check see an event."""
        if self.is_done or not isinstance(event, self.check.listens):
            return
        try:
            self.words = self._events.send(event)
        except StopIteration:
            self.is_done, self.words = True, ""


def _find(what: str, agent: BasicAgent) -> None:
    """Check that an agent has a quantity."""
    key, bracket, part = what.rstrip("]").partition("[")
    distances = _distances(agent)
    known = ["speed", "turning", *(f"distance {side}" for side in distances), *agent.percept]
    if key not in known or (bracket and not part.isdigit()):
        raise SetupError(f"the robot senses no {what!r}; {suggest(what, known)}")
    if key not in agent.percept:
        return
    reading = agent.percept[key]
    size = np.asarray(reading).size
    if isinstance(reading, str | tuple) or int(part or 0) >= size or (size > 1 and not part):
        hint = f"write {key}[0] to {key}[{size - 1}]" if size > 1 else "choose another sensor"
        raise SetupError(f"{what!r} is not one number of what the robot senses; {hint}")
