"""The state of the simulation, and the legend of colours, as HTML for the panel."""

from html import escape

from ai4u_edu.runtime.tick_monitor import Stall
from ai4u_edu.snapshot import AgentState, Snapshot, StaticScene
from ai4u_edu.snapshot.numbers import number
from ai4u_edu.snapshot.theme import RAY_MISS, UNKNOWN_GROUP, Rgb, group_colours
from ai4u_edu.viewer.panel.html_parts import section

MAX_LEGEND_GROUPS = 12
"""Most groups in the legend."""
MIN_SPEED_SHARE = 0.9
"""Share of the wanted speed below which the status says that the world can't keep up."""
MAX_USUAL_CONTACTS = 6
"""Contacts for each body above which bodies must overlap; side by side they have fewer."""


def speed_name(speed: float) -> str:
    """Return the label of a time scale.

    >>> speed_name(0.25), speed_name(float("inf"))
    ('0.25x', 'as fast as it goes')
    """
    return "as fast as it goes" if speed == float("inf") else f"{speed:g}x"


def legend(static_scene: StaticScene) -> str:
    """Return the legend of the groups' colours, which rays have too; it names each colour once."""
    groups = dict(tuple(group_colours(static_scene).items())[:MAX_LEGEND_GROUPS])
    groups |= {"other": UNKNOWN_GROUP, "nothing": RAY_MISS}
    names: dict[Rgb, list[str]] = {}
    for group, colour in groups.items():
        names.setdefault(colour, []).append(escape(group))
    dots = [
        f'<span><i style="background: rgb{colour}"></i>{", ".join(alike)}</span> '
        for colour, alike in names.items()
    ]
    return "".join(dots)


def status(snapshot: Snapshot, stall: Stall | None = None) -> str:
    """Return how far the world is and how fast it goes, as HTML.

    Args:
        snapshot: the latest one.
        stall: what keeps the world from going on, if anything does: then no snapshots come.
    """
    agents = snapshot.agents
    # several agents have steps of their own, which their tab shows
    steps = f"<span><small>step</small> {agents[0].steps}</span>" if len(agents) == 1 else ""
    progress = (
        f"<span><small>Episode</small> {snapshot.episode}</span>{steps}"
        f"<span><small>time</small> {number(snapshot.episode_time)} s</span>"
    )
    speed = _speed(snapshot) if stall is None else f"<strong>{escape(str(stall))}</strong>"
    return section(progress, speed, *map(_script, agents), kind="status bare")


def goal(static_scene: StaticScene) -> str:
    """Return the scene's goal; empty if it has none."""
    return (
        section(f'<div class="goal">{escape(static_scene.goal)}</div>') if static_scene.goal else ""
    )


def _script(agent: AgentState) -> str:
    """Return the state of the script that drives an agent; empty without a remote brain."""
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
    totals = ", ".join(f"{count} {name}" for name, count in counts.items() if count)
    is_connected = remote.state == "connected"
    state = remote.state if is_connected else f"<strong>{remote.state}</strong>"
    lines = (
        f"<small>Script of agent {escape(agent.id)}:</small> {state}",
        f"<small>{escape(remote.reason)}</small>" if remote.reason else "",
        f"<small>{totals}</small>" if totals else "",
    )
    return "".join(f"<br>{line}" for line in lines if line)


def _speed(snapshot: Snapshot) -> str:
    if snapshot.error:
        return f"<strong>Stopped: {escape(snapshot.error)}</strong>"
    if snapshot.past:
        return "<strong>Past</strong>"
    if snapshot.paused:
        return "<strong>Paused</strong>"
    if snapshot.waiting:
        return "<strong>Waits for a key</strong>"
    factor = snapshot.real_time_factor
    speed = f"<small>runs at</small> {factor:.1f}x{_slow_tick(snapshot)}"
    wanted = snapshot.time_scale
    if wanted != float("inf") and factor < MIN_SPEED_SHARE * wanted:
        return f"{speed} <strong>(can't keep up with {speed_name(wanted)})</strong>"
    return speed


def _slow_tick(snapshot: Snapshot) -> str:
    """Return a warning about a slow tick; empty if there was none."""
    slow = snapshot.slow_tick
    if slow is None:
        return ""
    overlap = slow.contacts > len(snapshot.bodies) * MAX_USUAL_CONTACTS
    why = f" with {slow.contacts} contacts: move bodies out of each other" if overlap else ""
    return f"<br><strong>a tick took {1000 * slow.seconds:.0f} ms{why}</strong>"
