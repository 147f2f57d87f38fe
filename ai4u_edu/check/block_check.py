"""The checks that are the same for every kind of block."""

import json
import random
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.blocks.groups import missing_groups, names_groups
from ai4u_edu.blocks.rewards.eval_value import EvalValue
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Rollout, RolloutStep, Script, standard_scene
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, listed
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import from_plain, is_serializable, to_plain
from ai4u_edu.world import WorldView

DEFAULT_DECISIONS = 120
"""Default length of a run."""

MAX_VALUE_CHARS = 120
"""Maximum length of a value in a message."""


_KINDS: tuple[type[Block], ...] = (Sensor, Actuator, RewardFunc, Brain, Controller)

_HINT = _("are all parameters declared as annotated fields, and left as they were given?")


@dataclass
class Options:
    """The scene, script, seed and length of the runs."""

    scene: Scene | str | None = None
    script: Script | None = None
    seed: int = 0
    decisions: int = DEFAULT_DECISIONS

    def the_scene(self) -> Scene:
        """Return the scene that was given, or the standard one."""
        if isinstance(self.scene, str):
            return Scene.load(self.scene)
        return self.scene or standard_scene()


class BlockCheck:
    """Runs a block several times and checks that it is deterministic and resets cleanly.

    Args:
        report: receives the findings.
        make: returns a new rollout, each time with new blocks.
        options: the seed and the length of the runs.
        of: returns the value to compare from a record, such as a sensor's reading.
        words: the name of these values in messages, such as "readings".
    """

    def __init__(
        self,
        report: Report,
        make: Callable[[], Rollout],
        options: Options,
        *,
        of: Callable[[RolloutStep], Any],
        words: str,
    ) -> None:
        self.report = report
        self._make, self._of, self._words = make, of, words
        self._seed, self._decisions = options.seed, options.decisions
        self.records: list[RolloutStep] = []
        """The records of the first run."""

    def run(self, *, reset_exemption: str = "") -> bool:
        """Run the checks; return False if the first run failed.

        Args:
            reset_exemption: why the block may keep state across a reset; empty if it may not.
        """
        before = _global_generator_states()
        try:
            rollout = self._make()
        except Exception as error:  # whatever it is, the report says it
            self.report.add(
                _("setup"),
                _(
                    "expected a setup without an error, got {error}",
                    error=format_error(error),
                ),
            )
            return False
        self.report.add(_("setup"))
        self.view = rollout.agent.view  # the world that was built for the first run
        try:
            self.records = self.drive(rollout)
        except Exception as error:  # whatever it is, the report says it
            text = _(
                "expected {decisions} decisions without an error, got {error}",
                decisions=self._decisions,
                error=format_error(error),
            )
            self.report.add(_("runs"), text)
            return False
        self.report.add(_("runs"))
        drawn = [
            name for name, state in _global_generator_states().items() if state != before[name]
        ]
        self.report.add(
            _("global chance"),
            _(
                "expected no draw from a global generator, got one from {names}; take "
                "view.random(name), which grows from the world's seed",
                names=listed(drawn),
            )
            if drawn
            else "",
        )
        self._same_twice()
        self._check_reset(rollout, reset_exemption)
        return True

    def drive(self, rollout: Rollout) -> list[RolloutStep]:
        """Run a rollout with the check's seed and length."""
        return rollout.run(self._seed, self._decisions)

    def values(self) -> list[Any]:
        """Return the compared value of each record of the first run."""
        return [self._of(record) for record in self.records]

    def changes(self, *, warning: bool) -> None:
        """Check that the value changes at some time.

        Args:
            warning: a value that never changes is a warning, not a failure.
        """
        # right after a reset there is no reward and no answer yet
        values = [value for value in self.values() if value is not None]
        same = all(frozen(value) == frozen(values[0]) for value in values)
        got: str = _("none")
        if values:
            got = _("{value} all {count} times", value=short(values[0]), count=len(values))
        self.report.add(
            _("changes"),
            _(
                "expected {words} that change while the agent drives about, got {got}; if there "
                "is nothing here to make them change, check it in another scene, by scene=...",
                words=self._words,
                got=got,
            )
            if same
            else "",
            outcome=Outcome.WARNING if same and warning else None,
        )

    def only_looks(self, without: Rollout) -> None:
        """Check that the first episode runs as it does without the block."""
        problem: str = ""
        for number, (one, other) in enumerate(zip(self.records, self.drive(without), strict=False)):
            moved = [name for name in one.poses if one.poses[name] != other.poses[name]]
            if moved:
                problem = _(
                    "expected the world to go on as it does without it, got body {name!r} at "
                    "another place after decision {number}; what only looks must not move anything",
                    name=moved[0],
                    number=number,
                )
            if moved or one.done or other.done:
                break  # a reward may end the episode; after that the runs can't be compared
        self.report.add(_("only looks"), problem)

    def _same_twice(self) -> None:
        problem = self._difference(lambda: self.drive(self._make()))
        self.report.add(
            _("same twice"),
            _(
                "expected the same {words} from the same seed, got {problem}; take chance from "
                "view.random(name), and go through no set",
                words=self._words,
                problem=problem,
            )
            if problem
            else "",
        )

    def _check_reset(self, rollout: Rollout, why_not: str) -> None:
        if self.report.findings[-1].outcome is Outcome.FAILED:
            why_not = _("it differs even without a reset")
        if why_not:
            self.report.add(_("forgets"), why_not, outcome=Outcome.NOT_APPLICABLE)
            return
        problem = self._difference(lambda: self.drive(rollout))
        self.report.add(
            _("forgets"),
            _(
                "expected the same {words} again after a reset, got {problem}; put back in "
                "on_reset whatever changes in an episode",
                words=self._words,
                problem=problem,
            )
            if problem
            else "",
        )

    def _difference(self, run: Callable[[], list[RolloutStep]]) -> str:
        """Return where another run first differs from the first one; empty if nowhere."""
        try:
            others = run()
        except Exception as error:  # whatever it is, the report says it
            return format_error(error)
        for number, (one, other) in enumerate(zip(self.records, others, strict=False)):
            expected, got = self._of(one), self._of(other)
            if frozen(expected) != frozen(got):
                return _(
                    "{got} in place of {expected} after decision {number}",
                    got=short(got),
                    expected=short(expected),
                    number=number,
                )
        return "" if len(others) == len(self.records) else _("episodes of other lengths")


def run_static_checks(report: Report, block: Block, says: str) -> None:
    """Check that a block has a docstring and survives being written to a scene file and read back.

    Args:
        report: receives the findings.
        block: the block.
        says: what its docstring should say, for the message.
    """
    cls = type(block)
    written = (cls.__dict__.get("__doc__") or "").strip()
    report.add(
        _("documented"),
        ""
        if written
        else _(
            "expected a docstring that says {says}, got none; write one under the class line",
            says=says,
        ),
    )
    plain = to_plain(block)
    if not is_serializable(cls) or _holds_a_function(plain):
        why = _("it holds a Python function, which no file can say")
        report.add(_("scene file"), why, outcome=Outcome.NOT_APPLICABLE)
        return
    report.add(_("scene file"), _lost(block, plain))


def _lost(block: Block, plain: Any) -> str:
    """Return the difference after writing and reading a block; empty if there is none."""
    kind = next(kind for kind in _KINDS if isinstance(block, kind))
    try:
        again = to_plain(from_plain(kind, json.loads(json.dumps(plain))))
    except (AI4UError, TypeError, ValueError) as error:
        return _(
            "expected {plain} to make the same block, got {error}; {hint}",
            plain=str(plain),
            error=text_of(error),
            hint=_HINT,
        )
    if again == plain:
        return ""
    return _(
        "expected {plain} back, got {again}; {hint}",
        plain=str(plain),
        again=str(again),
        hint=_HINT,
    )


def _holds_a_function(plain: Any) -> bool:
    if isinstance(plain, dict):
        return any(map(_holds_a_function, plain.values()))
    if isinstance(plain, list):
        return any(map(_holds_a_function, plain))
    return callable(plain)


def warn_of_groups(report: Report, blocks: Iterable[tuple[str, Block]], view: WorldView) -> None:
    """Add a warning for groups that no body carries; add nothing if no block names a group.

    Args:
        report: receives the finding.
        blocks: pairs of a prefix that names the block (may be empty) and the block.
        view: the blocks' world.
    """
    looking = [(words, block) for words, block in blocks if names_groups(block)]
    if not looking:
        return
    missing = [
        join([words, text], "") for words, block in looking for text in missing_groups(block, view)
    ]
    report.add(
        _("groups"),
        join(missing, "; ") if missing else "",
        outcome=Outcome.WARNING if missing else None,
    )


def warn_of_no_end(report: Report, rewards: Iterable[tuple[str, RewardFunc]]) -> None:
    """Add a warning for rewards that are meant to end the episode and cannot.

    Args:
        report: receives the finding; nothing is added if no reward is meant to end the episode.
        rewards: pairs of a prefix that names the reward (may be empty) and the reward.
    """
    ending = [(words, reward) for words, reward in rewards if reward.cause_episode_to_end]
    if not ending:
        return
    vain = [
        join([words, why], "") for words, reward in ending if (why := _why_it_never_ends(reward))
    ]
    report.add(
        _("ends"), join(vain, "; ") if vain else "", outcome=Outcome.WARNING if vain else None
    )


def _why_it_never_ends(reward: RewardFunc) -> str:
    """Return why a reward can't end an episode, as a sentence; empty if it can."""
    if isinstance(reward, EvalValue):
        return _(
            "expected a condition inside an AndRewardFunc or OrRewardFunc, with "
            "cause_episode_to_end there: alone it pays nothing, so the episode never ends by it"
        )
    if type(reward).ends is not RewardFunc.ends:  # the class overrides when it ends the episode
        return ""
    amounts = [name for name in reward.parameters() if ("_" + name).endswith("_reward")]
    if not amounts or any(getattr(reward, name) for name in amounts):
        return ""
    return _(
        "expected an amount other than 0 in {names}, got 0: the episode ends only where something "
        "is paid, so it never ends by it",
        names=" or ".join(amounts),
    )


def _global_generator_states() -> dict[str, str]:
    """Return the states of Python's and numpy's global random generators."""
    _name, state, *rest = np.random.get_state(legacy=True)
    return {
        "random": repr(random.getstate()),
        "numpy.random": repr((np.asarray(state).tobytes(), rest)),
    }


def frozen(value: Any) -> Any:
    """Return a value that compares equal only for bit-identical values."""
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    return repr(value)


def short(value: Any) -> str:
    """Return a value as text that fits on one line."""
    text = str(value.tolist()) if isinstance(value, np.ndarray) else str(value)
    return text if len(text) <= MAX_VALUE_CHARS else text[: MAX_VALUE_CHARS - 3] + "..."


def format_error(error: Exception) -> str:
    """Return an error's type, message and notes as one line."""
    told = join([type(error).__name__, text_of(error)], ": ")
    return join([told, *getattr(error, "__notes__", [])], "; ")
