"""What the time does, and what the colours mean, as HTML for the panel."""

from html import escape

from ai4u_edu.runtime.stall_monitor import Stall
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, group_colours
from ai4u_edu.viewer.panel.bars import number
from ai4u_edu.viewer.panel.readings import block

MOST_GROUPS = 12
"""So many groups are explained at most."""
BEHIND = 0.9
"""What runs at less than this share of the speed it should have can't keep up."""
MANY_CONTACTS = 6
"""So many contacts a body has at most where bodies lie beside each other."""


def speed_name(speed: float) -> str:
    """What a time scale is called.

    >>> speed_name(0.25), speed_name(float("inf"))
    ('0.25x', 'as fast as it goes')
    """
    return "as fast as it goes" if speed == float("inf") else f"{speed:g}x"


def legend(static_scene: StaticScene) -> str:
    """The colours of groups, and so of what rays met."""
    groups = dict(tuple(group_colours(static_scene).items())[:MOST_GROUPS])
    groups |= {"other": UNKNOWN_GROUP, "nothing": RAY_MISS}
    dots = [
        f'<span><i style="background: rgb{colour}"></i>{escape(group)}</span> '
        for group, colour in groups.items()
    ]
    return "".join(dots)


def status(snapshot: Snapshot, stall: Stall | None = None) -> str:
    """Return how far the world is and how fast it goes, as HTML.

    Args:
        snapshot: the latest one.
        stall: what keeps the world from going on, if anything does: then no snapshots come.
    """
    agents = snapshot.agents
    # of several each has its own steps, and they stand in the agents' panel
    steps = f"<span><small>step</small> {agents[0].steps}</span>" if len(agents) == 1 else ""
    place = (
        f"<span><small>Episode</small> {snapshot.episode}</span>{steps}"
        f"<span><small>time</small> {number(snapshot.time)} s</span>"
    )
    pace = _pace(snapshot) if stall is None else f"<strong>{escape(str(stall))}</strong>"
    return block(place, pace, *map(_script, agents), kind="status bare")


def goal(static_scene: StaticScene) -> str:
    """What is to be done."""
    return (
        block(f'<div class="goal">{escape(static_scene.goal)}</div>') if static_scene.goal else ""
    )


def _script(agent: AgentState) -> str:
    """How it stands with the script that drives an agent."""
    remote = agent.remote
    if remote is None:
        return ""
    counts = {
        "decisions": remote.decisions,
        "missing": remote.missing,
        "ignored": remote.ignored,
        "refused": remote.refused,
        "clipped": remote.clipped,
    }
    told = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    here = remote.state == "connected"
    state = remote.state if here else f"<strong>{remote.state}</strong>"
    lines = (
        f"<small>Script of agent {escape(agent.id)}:</small> {state}",
        f"<small>{escape(remote.reason)}</small>" if remote.reason else "",
        f"<small>{told}</small>" if told else "",
    )
    return "".join(f"<br>{line}" for line in lines if line)


def _pace(snapshot: Snapshot) -> str:
    if snapshot.error:
        return f"<strong>Stopped: {escape(snapshot.error)}</strong>"
    if snapshot.past:
        return "<strong>Past</strong>"
    if snapshot.paused:
        return "<strong>Paused</strong>"
    factor = snapshot.real_time_factor
    speed = f"<small>runs at</small> {factor:.1f}x{_slow(snapshot)}"
    wanted = snapshot.time_scale
    if wanted != float("inf") and factor < BEHIND * wanted:
        return f"{speed} <strong>(can't keep up with {speed_name(wanted)})</strong>"
    return speed


def _slow(snapshot: Snapshot) -> str:
    """What is said of a tick that took too long."""
    slow = snapshot.slow_tick
    if slow is None:
        return ""
    many = slow.contacts > len(snapshot.bodies) * MANY_CONTACTS
    why = f" with {slow.contacts} contacts: move bodies out of each other" if many else ""
    return f"<br><strong>a tick took {1000 * slow.seconds:.0f} ms{why}</strong>"
