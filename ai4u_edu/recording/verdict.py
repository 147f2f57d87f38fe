"""Comparison of a recorded episode with its replay."""

from dataclasses import dataclass

from ai4u_edu.recording.episode import ENDED, AgentRecord, Episode
from ai4u_edu.recording.episode_builder import VERSIONS


@dataclass(frozen=True)
class Verdict:
    """Result of comparing an episode with its replay."""

    exact: bool
    """True if the whole episode can be replayed exactly."""
    exact_until: int
    """Tick up to which the replay is exact; later moments can't be shown."""
    why: str
    """Sentence about the first difference; empty if there is none."""


def compare(there: Episode, here: Episode, problem: str) -> Verdict:
    """Compare a recording with what happened when it was replayed.

    Args:
        there: the recorded episode.
        here: the replayed episode.
        problem: an error that ended the replay; empty if there was none.
    """
    hint = _other_versions(there)
    steps = [0] * len(there.agents)
    changed = there.changed
    for number in there.order.tolist():
        if number < 0:
            continue
        step, steps[number] = steps[number], steps[number] + 1
        one, other = there.agents[number], here.agents[number]
        begin = int(one.begin[step])
        if changed is not None and begin >= changed:
            break
        if step >= len(other) or one.begin[step] != other.begin[step]:
            why = problem or "it took no decision there"
            return Verdict(False, begin, f"agent {one.id!r}, decision {step}: {why}{hint}")
        if changed is not None and (one.end[step] > changed or not one.flags[step] & ENDED):
            continue
        if one.worlds[step] != other.worlds[step]:
            why = "the bodies were in other places, or moved otherwise"
            return Verdict(False, begin, f"agent {one.id!r}, decision {step}: {why}{hint}")
        why = _difference(one, other, step)
        if why:
            return Verdict(False, begin + 1, f"agent {one.id!r}, decision {step}: {why}{hint}")
    if changed is not None:
        return Verdict(False, changed, "the world was changed by hand there")
    for one, other in zip(there.agents, here.agents, strict=True):
        if one.firsts.tolist() != other.firsts.tolist():
            return Verdict(False, 0, f"agent {one.id!r} began with another percept{hint}")
    return Verdict(True, there.ticks + 1, "")


def _difference(one: AgentRecord, other: AgentRecord, step: int) -> str:
    if one.percepts[step] != other.percepts[step]:
        return "what it sensed after it was something else"
    then, now = one[step], other[step]
    if then == now:
        return ""
    for name in dict.fromkeys((*then.reward_terms, *now.reward_terms)):
        paid, pays = then.reward_terms.get(name), now.reward_terms.get(name)
        if paid != pays:
            return f"reward term {name!r}: paid {_amount(paid)} then, and {_amount(pays)} now"
    return f"it ended at tick {then.end} then, and at {now.end} now"


def _amount(paid: float | None) -> str:
    return "nothing" if paid is None else repr(paid)


def _other_versions(episode: Episode) -> str:
    others = [
        f"{name} {then} (here {VERSIONS[name]})"
        for name, then in episode.versions.items()
        if name in VERSIONS and VERSIONS[name] != then
    ]
    return f"; it was recorded with {', '.join(others)}" if others else ""
