"""The kinds of checks of a mission: each follows what happens in a world until it is satisfied."""

import math
from collections import deque
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import Field, StringConstraints, field_validator, model_validator

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks import Block
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text
from ai4u_edu.missions.check import Check, Follow
from ai4u_edu.missions.events import Decision, PersonAnswer, SeenPage, Verdict
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world.shapes import Description

Tab = Literal["drive", "build", "world", "code", "past", "teach"]
"""Tabs of the panel by their names in the page."""
MAX_TIMES = 1000
TIME_TOLERANCE_S = 1e-6
"""Times are sums of ticks, which are no round numbers."""
MOVED_M = 0.01
"""Distance (m) between two decisions from which on a robot is on its way."""
COASTING_DECISIONS = 12
"""Decisions (1 s) without an action in which a robot still rolls by itself; later it is pushed."""
MINUS = "\N{MINUS SIGN}"
"""The page writes numbers below 0 with it."""
MAX_TEXT_CHARS = 400
Times = Annotated[int, Field(ge=1, le=MAX_TIMES)]
Text = Annotated[str, StringConstraints(min_length=1, max_length=MAX_TEXT_CHARS)]


class Drives(Check):
    """The robot drives some metres; pushed or carried ones do not count."""

    begins_with_latest = True
    type: Literal["drives"] = "drives"
    metres: Annotated[float, Field(gt=0, le=1000)]
    way: Literal["forward", "backward", "any"] = "any"

    def follow(self) -> Follow:
        """Add the distances between decisions of an episode, along the heading."""
        driven, before, idle = 0.0, None, COASTING_DECISIONS
        while driven < self.metres:
            now: Decision = yield _("{done:.1f} of {metres:g} m", done=driven, metres=self.metres)
            idle = 0 if now.acts else idle + 1
            is_same = before is not None and before.episode == now.episode
            if before is not None and is_same and idle <= COASTING_DECISIONS:
                dx, dy = now.x - before.x, now.y - before.y
                along = dx * math.cos(before.heading) + dy * math.sin(before.heading)
                ways = {"forward": along, "backward": -along, "any": abs(along)}
                driven += max(0.0, ways[self.way])
            before = now


class Covers(Check):
    """The robot drives for some seconds of an episode, and covers some metres on a wide enough way.

    The time begins when the robot begins to move. Whoever has covered too little at its end has to
    begin again, with another episode or after a break.
    """

    begins_with_latest = True
    type: Literal["covers"] = "covers"
    metres: Annotated[float, Field(gt=0, le=1000)]
    seconds: Annotated[float, Field(gt=0, le=3600)]
    width: Annotated[float, Field(ge=0, le=1000)] = 0.0
    """Distance (m) between the farthest two places of the way, at least."""

    def follow(self) -> Follow:
        """Add the distances between decisions in a row."""
        words: str = ""
        way: list[tuple[float, float]] = []
        covered, began, is_over, before = 0.0, 0.0, False, None
        while True:
            now: Decision = yield words
            if before is None or (now.episode, now.step) != (before.episode, before.step + 1):
                way, covered, began, is_over = [(now.x, now.y)], 0.0, now.seconds, False
            before = now
            step = math.dist(way[-1], (now.x, now.y))
            if not covered and step < MOVED_M:
                began = now.seconds  # a person is still reading
                step = 0.0
            if is_over:
                continue
            covered += step
            way.append((now.x, now.y))
            left = self.seconds - (now.seconds - began)
            words = _(
                "{done:.1f} of {metres:g} m; {left:.0f} s are left",
                done=covered,
                metres=self.metres,
                left=max(left, 0.0),
            )
            if left > TIME_TOLERANCE_S or now.outcome == "fell":
                continue
            is_over, widest = True, _width(way)
            if covered >= self.metres and widest >= self.width:
                return
            words = _(
                "{done:.1f} m, on a way {widest:.1f} m wide: {metres:g} m are needed, and "
                "{width:g} m wide. Press New start.",
                done=covered,
                widest=widest,
                metres=self.metres,
                width=self.width,
            )


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
            now: Decision = yield _(
                "{done:.0f} of {degrees:g} degrees", done=best, degrees=self.degrees
            )
            if before is not None and before.episode == now.episode:
                turned += math.degrees(math.remainder(now.heading - before.heading, 2 * math.pi))
                ways = {"left": turned, "right": -turned, "any": abs(turned)}
                best = max(best, ways[self.way])
            else:
                turned = 0.0
            before = now


class ReachesGoal(Check):
    """The scene's goal is reached in whole episodes, each driven from its start."""

    counts_whole_episodes = True
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
            raise ValueError(
                _(
                    "expected times of at most {of}, as in of, got {times}",
                    of=self.of,
                    times=self.times,
                )
            )
        return self

    def follow(self) -> Follow:
        """Count the ends of episodes whose first decision was seen."""
        ends: deque[tuple[int, bool]] = deque(maxlen=self.of)
        begun = None
        while sum(is_goal for _seed, is_goal in ends) < self.times:
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
        goals = sum(is_goal for _seed, is_goal in ends)
        if self.of is None:
            return _counted(goals, self.times)
        if not ends:
            return _("{times} of {of} starts have to reach the goal", times=self.times, of=self.of)
        return _(
            "{goals} of {starts} starts reached the goal; {times} of {of} are needed",
            goals=goals,
            starts=len(ends),
            times=self.times,
            of=self.of,
        )


class IsPaid(Check):
    """A reward term is paid, several times in one episode."""

    type: Literal["is_paid"] = "is_paid"
    reward: Annotated[str, StringConstraints(max_length=80)] = ""
    """Name of the term, since with any term a small reward on the way would do."""
    block: Annotated[str, StringConstraints(max_length=80)] = ""
    """Class of the reward function, such as ``TouchRewardFunc``, in place of the name: a person who
    builds may choose another name."""
    times: Times = 1

    @model_validator(mode="after")
    def _looks_at_one(self) -> Self:
        if bool(self.reward) == bool(self.block):
            raise ValueError(_("expected either a reward or a block"))
        return self

    def follow(self) -> Follow:
        """Count the decisions that pay more than 0."""
        count, episode = 0, None
        while count < self.times:
            now: Decision = yield _counted(count, self.times)
            if now.episode != episode:
                count, episode = 0, now.episode
            names = [name for name, paid in now.terms.items() if paid > 0]
            count += self.reward in names or self.block in map(now.reward_types.get, names)

    def fit(self, agent: BasicAgent) -> None:
        """Check that the agent is paid such a reward."""
        wanted, known = self.reward, [reward.name for reward in agent.rewards]
        if self.block:
            wanted, known = self.block, [type(reward).__name__ for reward in agent.rewards]
        if wanted not in known:
            raise SetupError(
                _(
                    "the robot gets no reward {reward!r}; {hint}",
                    reward=wanted,
                    hint=suggest(wanted, known),
                )
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
            raise ValueError(_("expected above, below or both, got none"))
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
            now: Decision = yield self._words(sum(latest), needed)
            if now.episode != episode:
                latest.clear()
                episode = now.episode
            has_all = all(each.has(now) for each in self.ranges)
            if not has_all and self.share == 1.0:
                latest.clear()
            else:
                latest.append(has_all)

    def _words(self, count: int, decisions: int) -> str:
        if decisions == 1:
            return ""
        numbers = {"count": count, "decisions": decisions}
        if not self.word:
            return _("{count} of {decisions} decisions", **numbers)
        word = library_text(self.word)
        return _("{word}: {count} of {decisions} decisions", word=word, **numbers)

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
            now: Decision = yield _counted(count, self.times)
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
            now: Decision = yield _counted(count, self.times)
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
            now: Decision = yield _(
                "{count} of {decisions} decisions", count=count, decisions=self.decisions
            )
            count += now.step > 0


class Opens(Check):
    """The person opens a tab."""

    listens = SeenPage
    type: Literal["opens"] = "opens"
    tab: Tab
    way: Literal["", "python", "blocks"] = ""
    """Way in which the program in the tab "Code" has to be written; empty for any."""

    def follow(self) -> Follow:
        """Wait for the tab."""
        view: SeenPage = yield ""
        while view.tab != self.tab or self.way not in ("", view.way):
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
        words: str = ""
        while True:
            answer: PersonAnswer = yield words
            if answer.decision is None:
                words = _("Drive a little first.")
                continue
            try:
                number = float(answer.text.strip().replace(MINUS, "-").replace(",", "."))
            except ValueError:
                text = answer.text[:20]
                words = _("Type a number, such as 0.5, not “{text}”.", text=text)
                continue
            try:
                value = answer.decision.value_of(self.what)
            except (KeyError, IndexError):
                words = _("The robot senses no {what} yet.", what=self.what)
                continue
            if abs(number - value) <= self.within:
                return
            words = _("Not {number:g}. Look at the number again.", number=number)

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
            raise ValueError(
                _("expected one of the options, got {right!r}; {hint}", right=right, hint=hint)
            )
        return right

    def follow(self) -> Follow:
        """Compare answers with the right one."""
        words = ""
        while True:
            answer: PersonAnswer = yield words
            if answer.text == self.right:
                return
            shown = library_text(answer.text[:80])
            words = _("Not “{answer}”. Think it over once more.", answer=shown)


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
            raise ValueError(_("expected a tag, a block or a kind of blocks to look for, got none"))
        known = Block.types[self.block].parameters() if self.block in Block.types else self.values
        for name in self.values:
            if name not in known:
                hint = suggest(name, known)
                raise ValueError(
                    _(
                        "{block} has no parameter {name!r}; {hint}",
                        block=self.block,
                        name=name,
                        hint=hint,
                    )
                )
        return self

    def follow(self) -> Follow:
        """Count in each state of the scene."""
        found = 0
        while found < self.count:
            scene: SceneDescription = yield _counted(found, self.count)
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


def _width(way: Sequence[tuple[float, float]]) -> float:
    """Return the distance (m) of the farthest two places of a way."""
    places = [*way[::6], way[-1]]  # twice a second is often enough, and much quicker than all
    return max(math.dist(one, other) for one in places for other in places)


def _counted(count: int, times: int) -> str:
    """Return how often something has happened, if it has to happen more than once."""
    return _("{count} of {times}", count=count, times=times) if times > 1 else ""


def _value_in(block: Mapping[str, Any], name: str) -> Any:
    """Return a parameter of a block as it is in a scene, where defaults are left out."""
    field = Block.types[block["type"]].parameters().get(name)
    if name in block or field is None:
        return block.get(name)
    return default_of(field)


AnyCheck = Annotated[
    Drives
    | Covers
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
