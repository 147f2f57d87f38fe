"""What the time does, and what the colours mean, as HTML for the panel."""

from html import escape

from ai4u_edu.look import NOTHING, UNKNOWN, group_colours
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.readings import block, number

MOST_GROUPS = 12
"""So many groups are explained at most."""
BEHIND = 0.9
"""What runs at less than this share of the speed it should have can't keep up."""
STYLE = """<style>
.ai4u {margin: 0 .9em .7em; font-size: .8em; line-height: 1.5; overflow-wrap: anywhere;
  font-variant-numeric: tabular-nums}
.ai4u table {width: 100%; border-collapse: collapse}
.ai4u th {font-weight: 450; text-align: left; vertical-align: top; padding-right: 1em;
  color: var(--mantine-color-dimmed)}
.ai4u td {text-align: right}
.ai4u p {margin: .5em 0 .1em; font-weight: 600}
.ai4u pre {display: inline-block; margin: .1em .5em .2em 0; padding: 0 .15em; font-size: .85em;
  line-height: 1.1; font-family: monospace; color: var(--mantine-color-text);
  background: var(--mantine-color-default-hover)}
.ai4u small {color: var(--mantine-color-dimmed)}
.ai4u i {display: inline-block; width: .7em; height: .7em; border-radius: 50%; margin-right: .3em}
.ai4u span {white-space: nowrap; margin-right: .8em}
.ai4u strong {color: #b34700}
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
    steps = max((agent.steps for agent in snapshot.agents), default=0)
    place = (
        f"<span><small>Episode</small> {snapshot.episode}</span>"
        f"<span><small>step</small> {steps}</span>"
        f"<span><small>time</small> {number(snapshot.time)} s</span>"
    )
    return block(place, "<br>", _pace(snapshot))


def _pace(snapshot: Snapshot) -> str:
    if snapshot.error:
        return f"<strong>Stopped: {escape(snapshot.error)}</strong>"
    if snapshot.paused:
        return "<strong>Paused</strong>"
    factor = snapshot.real_time_factor
    speed = f"<small>runs at</small> {factor:.1f}x <small>real time</small>"
    wanted = snapshot.time_scale
    if wanted != float("inf") and factor < BEHIND * wanted:
        return f"{speed} <strong>(can't keep up with {speed_name(wanted)})</strong>"
    return speed
