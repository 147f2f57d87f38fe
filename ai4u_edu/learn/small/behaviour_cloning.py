"""Behaviour cloning: a network learns to do in each moment what a driver did.

Before: :mod:`~ai4u_edu.learn.small.actor_critic`. New here is a loss. For a moment that was driven,
the network's action and the driver's are compared; the gradient says how to make the difference
smaller; 2,000 such steps take a second. There is no reward in it: who drives badly teaches badly.

How good is the clone? Its error on moments that it learned from says little, since it may know
them by heart. So some moments are held out, the network learns from the others, and then it is
asked what it would have done in those. Two decisions in a row are nearly equal, so a single one
can't be held out: it would be known from its neighbours. Whole drives can, or blocks of two
seconds.

A person's drives need three things more, without which a clone of five drives by keys reached the
box from three of four starts; with them, from nearly all:

- **It chooses among the keys' actions.** A mean of "left" and "right" is "rest", and then the robot
  stands still. So the network doesn't compute an action: it has one output for each action that
  occurs, as for choices, and the largest one wins.
- **It answers sooner.** A key is pressed about two decisions after what it answers was seen. So
  what was seen is put beside the keys of two decisions later.
- **It makes no pauses.** Who paused saw the same before and after it, and a robot that rests where
  it always sees the same rests for ever.

>>> from gymnasium import spaces
>>> generator = np.random.default_rng(0)
>>> drives = []
>>> for _ in range(5):  # someone always drives towards the light, whose bearing is the only reading
...     bearing = generator.uniform(-1, 1, (60, 1)).astype(np.float32)
...     drives.append(DriveData(bearing, np.sign(bearing)))
>>> space = spaces.Box(-1, 1, (1,))
>>> clone = clone_drives(drives, space, space, updates=300)
>>> clone.alike > 0.9, clone.commonest < 0.7
(True, True)
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.learn.small.actor_critic import LAYERS, ActorCritic
from ai4u_edu.learn.small.neural_network import Adam, Floats
from ai4u_edu.locale import gettext as _

Array = npt.NDArray[Any]

UPDATES = 2000
"""Gradient steps; a handful of drives is learned by then."""
BATCH = 128
"""Moments in a gradient step."""
RATE = 1e-3
MEASURE_EVERY = 100
"""Gradient steps between two measures of the error."""
HELD_OUT_SHARE = 0.2
"""Share of the drives, or of the blocks, that is held out."""
MIN_DRIVES_TO_HOLD_OUT = 5
"""Count of drives from which whole ones are held out; of fewer, one would be too much to lose."""
DEFAULT_BLOCK = 24
"""Decisions of a block that is held out: two seconds at twelve decisions a second."""
THIRDS = 3
"""Parts into which the range that was used of a number is cut, to say if two actions are alike:
backwards, about still and forwards, or left, straight and right."""
SMALL_ERROR = 0.1
"""Error, in units of a number's range, up to which its square counts; beyond it, its size."""
MAX_KEY_ACTIONS = 32
"""Different actions in drives up to which they are taken for those of keys."""
MOMENTS_A_KEY_ACTION = 4
"""Moments for each different action from which they are taken for those of keys."""
REST = 1e-3
"""Size below which all numbers of an action are, if it is called rest."""
SAME_VIEW = 0.25
"""Distance of two moments' readings, in units of their range (the root of the mean square), up to
which a person who paused between them is said to have seen the same."""
DISCOUNT = 0.98
"""Worth of a reward a decision later, compared with now."""
STILL_SHARE = 0.98
"""Share of moments at rest from which somebody is said to have stood still."""
TWIN_DISTANCE = 0.1
"""Distance of two moments' readings, in standard deviations a reading, up to which they count as
the same."""
TWIN_SAMPLE = 400
"""Moments for which a twin is searched."""
MIN_TWINS = 20
"""Fewest twins from which contradictions are spoken of."""
CONTRADICTION_SHARE = 0.35
"""Share of twins with unlike actions from which drives are said to contradict each other."""

ONE_DRIVE = _(
    "This is one drive only: the robot knows one way from one start. Drive again from other starts."
)
STOOD_STILL = _(
    "In these drives the robot hardly moved, so it has learned to stand still. "
    "Drive again, and move."
)
ONE_CHOICE = _(
    "In these drives the robot always did the same, so it has learned nothing "
    "else. Drive again, and do all that it should be able to."
)
CONTRADICTION = _(
    "These drives contradict each other: where the robot sensed the same, it "
    "was driven in different ways. Leave out the drives in which you tried "
    "something, or give the robot another sensor."
)


@dataclass(frozen=True)
class DriveData:
    """One drive from a start to its end, n decisions long."""

    observations: Array
    """(n, r) or (n + 1, r): flat observations, the first one before the first decision. What came
    after the last decision teaches nothing and may be missing."""
    actions: Array
    """(n, numbers) within the action space; (n,) for choices."""
    rewards: Array | None = None
    """(n,) of each decision; with them, the critic learns what this driver's way is worth."""
    is_shown: Array | None = None
    """(n,) True for the moments to learn from; None for all. In the others somebody else drove."""

    def __len__(self) -> int:
        return len(self.actions) if self.is_shown is None else int(self.is_shown.sum())


@dataclass(frozen=True)
class CloningResult:
    """Result of a cloning."""

    network: ActorCritic
    alike: float
    """Share of held-out moments, 0 to 1, in which a network that never saw them acts like the
    driver: each number of the action in the same third of the range that the driver used of it,
    or the same choice."""
    commonest: float
    """The same share for always doing what was done most often."""
    held_out: int
    """Count of held-out moments."""
    errors: tuple[tuple[int, float], ...]
    """Gradient steps so far, and the error on held-out moments after them; where the network
    chooses, it is the share of certainty, 0 to 1, that it has in other choices than the driver's.
    """
    remarks: tuple[str, ...]
    """Sentences about what is wrong with the drives; empty if nothing is."""


def clone_drives(
    drives: Sequence[DriveData],
    observation_space: spaces.Space[Any],
    action_space: spaces.Space[Any],
    *,
    seed: int = 0,
    updates: int = UPDATES,
    block: int = DEFAULT_BLOCK,
    layers: Sequence[int] = LAYERS,
    person_delay: int | None = None,
    on_error: Callable[[int, float], None] | None = None,
) -> CloningResult:
    """Return a network that drives as these drives do.

    Two networks learn. The first one doesn't see the held-out moments: it is measured, and says
    after how many steps its error on them was least. The second one learns from all moments, for as
    many steps, and is the clone: to lose a drive of five is too much. A network that chooses takes
    all steps: one drive of five is too few to say when to stop, and it drove better so.

    The same drives and the same seed give the same network on the same machine.

    Args:
        drives: of one agent, with the same sensors and actuator.
        observation_space: (r,) of a flat observation.
        action_space: a Box (n,) whose numbers have bounds, or a Discrete.
        seed: of the weights, and of which moments are held out.
        updates: gradient steps of each of the two networks at most.
        block: decisions in two seconds; if there are too few drives, blocks of this length are held
            out.
        layers: neurons of the hidden layers.
        person_delay: decisions that pass until a person's keys answer what was seen, where they
            make numbers; None for drives that no person drove. They are learned as they are.
        on_error: called with the count of steps so far and the error on held-out moments.

    Raises:
        SetupError: there is nothing to learn from, or such actions can't be learned.
    """
    plain = ActorCritic(observation_space, action_space, layers)
    key_actions = None if person_delay is None else _key_actions(plain, drives)
    # of somebody with a stick, who steers all the time, a delay made clones worse
    delay = 0 if key_actions is None else person_delay or 0
    parts = [
        _moments(drive, delay, None if person_delay is None else plain.size) for drive in drives
    ]
    parts = [part for part in parts if len(part.readings)]
    count = sum(len(part.readings) for part in parts)
    if count < 2:
        raise SetupError(_("expected drives of at least 2 decisions, got {count}", count=count))
    generator = np.random.default_rng(checked_seed(seed))
    readings = np.concatenate([part.readings for part in parts]).astype(np.float32)
    actions = np.concatenate([part.actions for part in parts])
    first = ActorCritic(observation_space, action_space, layers, key_actions)
    wanted = _as_targets(first, actions)
    is_held_out = _held_out([len(part.readings) for part in parts], block, generator)
    seen, unseen = np.flatnonzero(~is_held_out), np.flatnonzero(is_held_out)

    done = _in_units(first, actions)
    spans = _spans(done)
    kinds = _kinds(first, done, spans)
    errors: list[tuple[int, float]] = []
    alike: list[float] = []

    def measure(update: int) -> None:
        errors.append((update, _error(first, readings[unseen], wanted[unseen])))
        acts = _in_units(first, first.act(readings[unseen]))
        alike.append(_share_alike(_kinds(first, acts, spans), kinds[unseen]))
        if on_error is not None:
            on_error(*errors[-1])

    first.draw(generator)
    _imitate(first, readings[seen], wanted[seen], updates, generator, measure)
    best = len(errors) - 1
    if not first.chooses:
        best = min(range(1, len(errors)), key=lambda index: errors[index][1])
    most_often, _count = Counter(map(tuple, kinds[seen].tolist())).most_common(1)[0]

    network = ActorCritic(observation_space, action_space, layers, key_actions)
    network.draw(generator)
    _imitate(network, readings, wanted, errors[best][0], generator)
    worth = [part.worth for part in parts if part.worth is not None]
    if len(worth) == len(parts):
        _judge(network, readings, np.concatenate(worth), generator)
    else:
        network.critic.parameters[:] = 0.0  # it knows nothing, so it says 0 and not any number
    return CloningResult(
        network=network,
        alike=alike[best],
        commonest=_share_alike(np.array([most_often]), kinds[unseen]),
        held_out=len(unseen),
        errors=tuple(errors),
        remarks=tuple(_remarks(len(parts), network, readings, done)),
    )


class _Moments(NamedTuple):
    """Moments of one drive to learn from."""

    readings: Array
    """(m, r)"""
    actions: Array
    """(m, numbers) or (m,) what the driver did, or began to do, on seeing them."""
    worth: Floats | None
    """(m,) discounted reward from each of them on."""


def _moments(drive: DriveData, delay: int, sizes: Floats | None) -> _Moments:
    """Return the moments of a drive to learn from.

    Args:
        drive: the drive.
        delay: decisions between what was seen and the action that answers it.
        sizes: (r,) largest value of each reading, to tell pauses; None keeps them.
    """
    delay = min(delay, len(drive.actions) // 2)  # something has to be left of a short drive
    actions = drive.actions[delay:]
    readings = drive.observations[: len(actions)]
    is_shown = np.ones(len(actions), np.bool_)
    if drive.is_shown is not None:
        is_shown = drive.is_shown[delay:].astype(np.bool_)
    if sizes is not None and actions.ndim == 2:
        is_shown = is_shown & ~_is_pause(readings / sizes, np.abs(actions).max(axis=1) < REST)
    worth = None if drive.rewards is None else _worth(drive.rewards)[: len(actions)][is_shown]
    return _Moments(readings[is_shown], actions[is_shown], worth)


def _is_pause(views: Array, is_rest: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return for each moment if the driver rested there, and then went on from the same view.

    To rest at the end of a drive is no pause, nor is to wait until something is seen.
    """
    is_pause = np.zeros(len(is_rest), np.bool_)
    went_on: Array | None = None
    for moment in reversed(range(len(is_rest))):
        if not is_rest[moment]:
            went_on = views[moment]
        elif went_on is not None:
            distance = np.sqrt(np.mean((views[moment] - went_on) ** 2))
            is_pause[moment] = distance < SAME_VIEW
    return is_pause


def _key_actions(network: ActorCritic, drives: Sequence[DriveData]) -> Array | None:
    """Return the different actions of drives by keys, (k, n); None if they are not by keys."""
    if network.chooses or not drives:
        return None
    shown = (slice(None) if drive.is_shown is None else drive.is_shown for drive in drives)
    actions = np.concatenate(
        [drive.actions[rows] for drive, rows in zip(drives, shown, strict=True)]
    )
    different: Array = np.unique(actions.astype(np.float32), axis=0)
    most = min(MAX_KEY_ACTIONS, len(actions) // MOMENTS_A_KEY_ACTION)
    return different if len(different) <= most else None


def _in_units(network: ActorCritic, actions: Array) -> Array:
    """Return actions (m, n) in units of their ranges, or as numbers of choices, (m,)."""
    if not len(network.unit):
        return actions.astype(np.int64).ravel()
    unit = np.where(network.unit > 0.0, network.unit, 1.0)
    numbers: Array = actions.reshape(len(actions), -1) / unit
    return numbers.astype(np.float32)


def _as_targets(network: ActorCritic, actions: Array) -> Array:
    """Return what the actor should give: numbers in units of their range, or indices of choices."""
    if network.key_actions is not None:
        is_done = (actions.astype(np.float32)[:, None] == network.key_actions).all(axis=2)
        indices: Array = is_done.argmax(axis=1)
        return indices
    targets = _in_units(network, actions)
    return targets - network.first_choice if network.chooses else targets


def _error(network: ActorCritic, readings: Array, wanted: Array) -> float:
    """Return a number that says how wrong the actor is, for people to see it fall."""
    outputs = network.actor.forward(network.scaled(readings))
    if network.chooses:
        # not the loss: it grows with each moment in which a network that has become sure errs
        return float(1.0 - _chances(outputs)[np.arange(len(wanted)), wanted].mean())
    return float(_loss(network, outputs, wanted)[0])


def _imitate(
    network: ActorCritic,
    readings: Array,
    wanted: Array,
    updates: int,
    generator: np.random.Generator,
    measure: Callable[[int], None] | None = None,
) -> None:
    """Have the actor learn to give the wanted actions."""
    # Readings get about the same spread: then all weights matter alike. One that hardly changed in
    # the drives may change more where the clone drives; it may not drown all others then. One that
    # never changed says nothing, and is left out (divided by infinity).
    spread, largest = readings.std(axis=0), network.size
    scaled_spread = np.where(spread > 1e-3 * largest, np.maximum(spread, 0.05 * largest), np.inf)
    network.middle = readings.mean(axis=0).astype(np.float32)
    network.size = scaled_spread.astype(np.float32)
    inputs = network.scaled(readings)
    optimizer = Adam(network.actor.parameters, RATE)
    if measure is not None:
        measure(0)  # else nobody sees how far the error falls in the first steps
    for update in range(1, updates + 1):
        batch = generator.integers(len(inputs), size=min(BATCH, len(inputs)))
        outputs = network.actor.forward(inputs[batch])
        _error, slope = _loss(network, outputs, wanted[batch])
        network.actor.backward(slope)
        optimizer.step(network.actor.gradient)
        if measure is not None and (update % MEASURE_EVERY == 0 or update == updates):
            measure(update)


def _loss(network: ActorCritic, outputs: Floats, wanted: Array) -> tuple[np.floating[Any], Floats]:
    """Return the mean loss of some moments, and its slope for each output."""
    count = len(outputs)
    if network.chooses:
        # Softmax makes probabilities of any numbers, and the loss is how surprised one is by the
        # driver's choice. Its slope is simply the probability, less 1 for what was chosen.
        chances = _chances(outputs)
        chosen = np.arange(count), wanted
        surprise = -np.log(np.maximum(chances[chosen], 1e-12)).mean()
        chances[chosen] -= 1.0
        return surprise, chances / count
    # beyond the end of the range is as good as at it, since it is cut off there
    unit = np.where(network.unit > 0.0, network.unit, 1.0)
    error = np.clip(outputs, network.low / unit, network.high / unit) - wanted
    # Not the square of the error: who drives by keys jumps from one end to the other, and the
    # square is least in between, where nobody drove. The size of the error is least at what was
    # done more often. Near 0 it is the square, so that steps get smaller there.
    size = np.abs(error)
    loss = np.where(size < SMALL_ERROR, 0.5 * error**2 / SMALL_ERROR, size - 0.5 * SMALL_ERROR)
    slope = np.clip(error / SMALL_ERROR, -1.0, 1.0)
    return loss.mean(), (slope / error.size).astype(np.float32)


def _chances(outputs: Floats) -> Floats:
    """Return the probability of each choice, (n, choices): the softmax of the outputs."""
    powers: Floats = np.exp(outputs - outputs.max(axis=1, keepdims=True))
    chances: Floats = powers / powers.sum(axis=1, keepdims=True)
    return chances


def _judge(
    network: ActorCritic, readings: Array, worth: Floats, generator: np.random.Generator
) -> None:
    """Have the critic learn what each moment was worth."""
    inputs = network.scaled(readings)
    middle, spread = float(worth.mean()), max(float(worth.std()), 1e-6)
    wanted = (worth - middle) / spread
    optimizer = Adam(network.critic.parameters, RATE)
    for _number in range(UPDATES // 2):
        batch = generator.integers(len(inputs), size=min(BATCH, len(inputs)))
        error = network.critic.forward(inputs[batch])[:, 0] - wanted[batch]
        network.critic.backward((2.0 * error / len(error))[:, None].astype(np.float32))
        optimizer.step(network.critic.gradient)
    # it has learned worths of about -1 to 1; the last layer turns them into rewards again
    network.critic.weights[-1] *= spread
    network.critic.biases[-1] *= spread
    network.critic.biases[-1] += middle


def _worth(rewards: Array) -> Floats:
    """Return the discounted reward from each moment of a drive on."""
    worth = np.zeros(len(rewards), np.float32)
    later = 0.0
    for moment in reversed(range(len(worth))):
        later = float(rewards[moment]) + DISCOUNT * later
        worth[moment] = later
    return worth


def _held_out(
    lengths: Sequence[int], block: int, generator: np.random.Generator
) -> npt.NDArray[np.bool_]:
    """Return for each moment of drives of these lengths if it is held out; some are, some not."""
    blocks = list(lengths)
    if len(lengths) < MIN_DRIVES_TO_HOLD_OUT:
        # of one short drive, too, something has to be left on both sides
        block = max(1, min(block, sum(lengths) // 2))
        blocks = [
            min(block, length - start) for length in lengths for start in range(0, length, block)
        ]
    count = max(1, round(HELD_OUT_SHARE * len(blocks)))
    chosen = np.zeros(len(blocks), np.bool_)
    chosen[generator.permutation(len(blocks))[:count]] = True
    return np.repeat(chosen, blocks)


def _spans(wanted: Array) -> tuple[Array, Array]:
    """Return the ends of the range that the driver used of each number, with 0 in it.

    A key may move a number by 0.4 alone, of a range of -1 to 1: thirds of that range would put a
    standing robot and a driving one side by side.
    """
    return np.minimum(wanted.min(axis=0), 0.0), np.maximum(wanted.max(axis=0), 0.0)


def _kinds(network: ActorCritic, done: Array, spans: tuple[Array, Array]) -> Array:
    """Return the third of its range that each number lies in, (n, numbers), or the choice, (n, 1).

    Args:
        network: says whether actions have numbers with ranges.
        done: actions as :func:`_in_units` gives them; beyond the range counts as at its end.
        spans: as :func:`_spans` gives them.
    """
    if not len(network.unit):
        return done[:, None]
    low, high = spans
    width = np.where(high > low, high - low, 1.0)
    share = (np.clip(done, low, high) - low) / width
    kinds: Array = np.minimum((THIRDS * share).astype(np.int64), THIRDS - 1)
    return kinds


def _share_alike(kinds: Array, others: Array) -> float:
    """Return the share of moments in which all numbers of two actions are of the same kind."""
    return float((kinds == others).all(axis=1).mean())


def _remarks(count: int, network: ActorCritic, readings: Array, done: Array) -> list[str]:
    """Return a sentence for each fault of so many drives."""
    remarks: list[str] = [ONE_DRIVE] if count == 1 else []
    if not len(network.unit):
        if (done == done[0]).all():
            remarks.append(ONE_CHOICE)
    elif np.mean(np.abs(done).max(axis=1) < REST) >= STILL_SHARE:
        remarks.append(STOOD_STILL)
    if (
        count > 1  # of a single one, none can be left out
        and _contradiction(network.scaled(readings), _kinds(network, done, _spans(done)))
        > CONTRADICTION_SHARE
    ):
        remarks.append(CONTRADICTION)
    return remarks


def _contradiction(inputs: Floats, kinds: Array) -> float:
    """Return the share of moments whose twin was driven in another way; 0 if twins are few.

    The twin of a moment is the one whose readings are closest to its own, if they are nearly equal.
    """
    sample = np.unique(np.linspace(0, len(inputs) - 1, TWIN_SAMPLE).astype(int))
    count = max(1, int(np.any(inputs != 0.0, axis=0).sum()))
    squares = (inputs * inputs).sum(axis=1)
    distance = squares[sample, None] - 2.0 * inputs[sample] @ inputs.T + squares
    distance[np.arange(len(sample)), sample] = np.inf  # nobody is a twin of their own
    nearest = distance.argmin(axis=1)
    is_twin = distance[np.arange(len(sample)), nearest] < count * TWIN_DISTANCE**2
    if is_twin.sum() < MIN_TWINS:
        return 0.0
    return 1.0 - _share_alike(kinds[sample[is_twin]], kinds[nearest[is_twin]])
