"""The decision cycle as a strip: sense, decide, act for some ticks, get the reward."""

from ai4u_edu.snapshot import AgentState, Snapshot
from ai4u_edu.viewer.panel.readings import block

MOST_TICKS = 24
"""So many ticks are drawn at most; of more only the first ones."""
SLOW = 0.25
"""Up to this speed one can see where in its decision an agent is."""


def decision(agent: AgentState, snapshot: Snapshot) -> str:
    """How an agent's decision goes; and where in it the world is, if that can be followed."""
    tick, ticks, repeats = agent.phase
    visible = snapshot.paused or snapshot.time_scale <= SLOW
    is_over = tick >= ticks or not tick
    acts = "".join(
        _tick(number, tick if visible else -1, acts=repeats or number == 1)
        for number in range(1, min(ticks, MOST_TICKS) + 1)
    )
    rest = f"&hellip;{ticks}" if ticks > MOST_TICKS else ""
    parts = [
        ("", "sense", visible and is_over),
        ("", "decide", False),
        ("act", f"act {acts}{rest}", visible and not is_over),
        ("", "reward", visible and is_over and tick > 0),
    ]
    strip = "".join(
        f'<span class="{kind}{" now" if now else ""}">{text}</span>' for kind, text, now in parts
    )
    return block(f'<div class="decision">{strip}</div>', f"<small>{_said(agent, snapshot)}</small>")


def _tick(number: int, present: int, *, acts: bool) -> str:
    kinds = [
        *(["coasts"] if not acts else []),
        *(["done"] if number <= present else []),
        *(["now"] if number == present else []),
    ]
    return f'<em class="{" ".join(kinds)}"></em>' if kinds else "<em></em>"


def _said(agent: AgentState, snapshot: Snapshot) -> str:
    """The same in words."""
    tick, ticks, repeats = agent.phase
    seconds = ticks / snapshot.static_scene.settings.ticks_per_second
    many = f"{ticks} ticks" if ticks > 1 else "1 tick"
    how = "" if ticks == 1 else "; it acts at each" if repeats else "; it acts at the first only"
    if not (snapshot.paused or snapshot.time_scale <= SLOW):
        return f"{many}, {seconds:.2g} s{how}. Slow down to watch."
    if 0 < tick < ticks:
        return f"Tick {tick} of {ticks}{how}."
    return f"{'Rewarded, and sensed' if tick else 'Sensed'}: decides next."
