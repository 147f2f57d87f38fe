"""What the time does, and what the colours mean, as HTML for the panel."""

from html import escape

from ai4u_edu.look import NOTHING, UNKNOWN, group_colours
from ai4u_edu.snapshot import AgentState, Snapshot, Stage
from ai4u_edu.viewer.readings import block, number

MOST_GROUPS = 12
"""So many groups are explained at most."""
BEHIND = 0.9
"""What runs at less than this share of the speed it should have can't keep up."""
MANY_CONTACTS = 6
"""So many contacts a body has at most where bodies lie beside each other."""
STYLE = """<style>
.ai4u {margin: 0 .9em .7em; font-size: .8em; line-height: 1.5; overflow-wrap: anywhere;
  font-variant-numeric: tabular-nums}
.ai4u table {width: 100%; border-collapse: collapse}
.ai4u th {font-weight: 450; text-align: left; vertical-align: top; padding-right: 1em;
  color: var(--mantine-color-dimmed)}
.ai4u th b {font-weight: 700; color: var(--mantine-color-text)}
.ai4u td {text-align: right}
.ai4u p {margin: .5em 0 .1em; font-weight: 600}
.ai4u pre {display: inline-block; margin: .1em .5em .2em 0; padding: 0 .15em; font-size: .85em;
  line-height: 1.1; font-family: monospace; color: var(--mantine-color-text);
  background: var(--mantine-color-default-hover)}
.ai4u small {color: var(--mantine-color-dimmed)}
.ai4u i {display: inline-block; width: .7em; height: .7em; border-radius: 50%; margin-right: .3em}
.ai4u svg {margin: .2em .5em .2em 0; max-width: 100%;
  background: var(--mantine-color-default-hover)}
.ai4u .need {display: grid; grid-template-columns: 1fr auto; margin: .2em 0 .45em}
.ai4u .need > div {grid-column: 1 / 3; position: relative; height: .8em; border-radius: 3px;
  overflow: hidden; background: var(--mantine-color-default-hover);
  box-shadow: inset 0 0 0 1px var(--mantine-color-default-border)}
.ai4u .need u {position: absolute; top: 0; bottom: 0; background: #009e7366}
.ai4u .need s {position: absolute; top: .2em; bottom: .2em; left: 0; background: #0072b2;
  border-radius: 0 2px 2px 0}
.ai4u .goal {line-height: 1.4}
.ai4u span {white-space: nowrap; margin-right: .8em}
.ai4u strong {color: #b34700}
[data-mantine-color-scheme=dark] .ai4u strong {color: #f39c5a}
</style>"""
"""How all HTML in the panel looks."""


def speed_name(speed: float) -> str:
    """What a time scale is called.

    >>> speed_name(0.25), speed_name(float("inf"))
    ('0.25x', 'as fast as it goes')
    """
    return "as fast as it goes" if speed == float("inf") else f"{speed:g}x"


def legend(stage: Stage) -> str:
    """The colours of groups, and so of what rays met."""
    groups = dict(tuple(group_colours(stage).items())[:MOST_GROUPS])
    groups |= {"other": UNKNOWN, "nothing": NOTHING}
    dots = [
        f'<span><i style="background: rgb{colour}"></i>{escape(group)}</span> '
        for group, colour in groups.items()
    ]
    return block(*dots)


def status(snapshot: Snapshot) -> str:
    """How far the world is, and how fast it goes."""
    agents = snapshot.agents
    # of several each has its own steps, and they stand in the agents' panel
    steps = f"<span><small>step</small> {agents[0].steps}</span>" if len(agents) == 1 else ""
    place = (
        f"<span><small>Episode</small> {snapshot.episode}</span>{steps}"
        f"<span><small>time</small> {number(snapshot.time)} s</span>"
    )
    return block(place, "<br>", _pace(snapshot), *map(_script, agents))


def goal(stage: Stage) -> str:
    """What is to be done."""
    return block(f'<div class="goal">{escape(stage.goal)}</div>') if stage.goal else ""


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
    if snapshot.paused:
        return "<strong>Paused</strong>"
    factor = snapshot.real_time_factor
    speed = f"<small>runs at</small> {factor:.1f}x <small>real time</small>{_slow(snapshot)}"
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
