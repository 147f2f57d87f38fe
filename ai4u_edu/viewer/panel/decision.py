"""The decision cycle as a strip: sense, decide, act for some ticks, get the reward."""

from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.viewer.panel.html_parts import section

MAX_TICKS = 24
"""Most ticks that are drawn; of longer decisions only the first ones."""
MAX_VISIBLE_SPEED = 0.25
"""Largest time scale at which the current tick is marked; faster, nobody could follow."""


def decision(agent: AgentState, snapshot: Snapshot) -> str:
    """Return the parts of an agent's decision as HTML, with the current one marked when slow."""
    tick, ticks, repeats = agent.phase
    visible = snapshot.paused or snapshot.time_scale <= MAX_VISIBLE_SPEED
    is_over = tick >= ticks or not tick
    acts = "".join(
        _tick(number, tick if visible else -1, acts=repeats or number == 1)
        for number in range(1, min(ticks, MAX_TICKS) + 1)
    )
    rest = f"&hellip;{ticks}" if ticks > MAX_TICKS else ""
    parts = [
        ("", "sense", visible and is_over),
        ("", "decide", False),
        ("act", f"act {acts}{rest}", visible and not is_over),
        ("", "reward", visible and is_over and tick > 0),
    ]
    strip = "".join(
        f'<span class="{kind}{" now" if now else ""}">{text}</span>' for kind, text, now in parts
    )
    return section(
        f'<div class="decision">{strip}</div>', f"<small>{_caption(agent, snapshot)}</small>"
    )


def _tick(number: int, current: int, *, acts: bool) -> str:
    kinds = [
        *(["coasts"] if not acts else []),
        *(["done"] if number <= current else []),
        *(["now"] if number == current else []),
    ]
    return f'<em class="{" ".join(kinds)}"></em>' if kinds else "<em></em>"


def _caption(agent: AgentState, snapshot: Snapshot) -> str:
    """Return the decision in words."""
    tick, ticks, repeats = agent.phase
    seconds = ticks / snapshot.static_scene.settings.ticks_per_second
    count = f"{ticks} ticks" if ticks > 1 else "1 tick"
    how = "" if ticks == 1 else "; it acts at each" if repeats else "; it acts at the first only"
    if not (snapshot.paused or snapshot.time_scale <= MAX_VISIBLE_SPEED):
        return f"{count}, {seconds:.2g} s{how}. Slow down to watch."
    if 0 < tick < ticks:
        return f"Tick {tick} of {ticks}{how}."
    return f"{'Rewarded, and sensed' if tick else 'Sensed'}: decides next."
