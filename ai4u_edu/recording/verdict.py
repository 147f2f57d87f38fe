"""Comparison of a recorded episode with its replay."""

from dataclasses import dataclass

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.recording.agent_record import ENDED, AgentRecord
from ai4u_edu.recording.episode import Episode
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
    versions = _other_versions(there)
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
            why = problem or _("it took no decision there")
            return Verdict(False, begin, _told(one, step, why, versions))
        if changed is not None and (one.end[step] > changed or not one.flags[step] & ENDED):
            continue
        if one.worlds[step] != other.worlds[step]:
            why = _("the bodies were in other places, or moved otherwise")
            return Verdict(False, begin, _told(one, step, why, versions))
        why = _difference(one, other, step)
        if why:
            return Verdict(False, begin + 1, _told(one, step, why, versions))
    if changed is not None:
        return Verdict(False, changed, _("the world was changed by hand there"))
    for one, other in zip(there.agents, here.agents, strict=True):
        if one.firsts.tolist() != other.firsts.tolist():
            began = _("agent {id!r} began with another percept", id=one.id)
            return Verdict(False, 0, join([began, *versions], "; "))
    return Verdict(True, there.ticks + 1, "")


def _told(record: AgentRecord, step: int, why: str, versions: list[str]) -> str:
    what = _("agent {id!r}, decision {step}: {why}", id=record.id, step=step, why=why)
    return join([what, *versions], "; ")


def _difference(one: AgentRecord, other: AgentRecord, step: int) -> str:
    if one.percepts[step] != other.percepts[step]:
        return _("what it sensed after it was something else")
    then, now = one[step], other[step]
    if then == now:
        return ""
    for name in dict.fromkeys((*then.reward_terms, *now.reward_terms)):
        paid, pays = then.reward_terms.get(name), now.reward_terms.get(name)
        if paid != pays:
            return _(
                "reward term {name!r}: paid {then} then, and {now} now",
                name=name,
                then=_amount(paid),
                now=_amount(pays),
            )
    return _("it ended at tick {then} then, and at {now} now", then=then.end, now=now.end)


def _amount(paid: float | None) -> str:
    return _("nothing") if paid is None else repr(paid)


def _other_versions(episode: Episode) -> list[str]:
    others = [
        _("{name} {version} (here {here})", name=name, version=then, here=VERSIONS[name])
        for name, then in episode.versions.items()
        if name in VERSIONS and VERSIONS[name] != then
    ]
    if not others:
        return []
    return [_("it was recorded with {versions}", versions=join(others, ", "))]
