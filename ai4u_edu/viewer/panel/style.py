"""CSS for the HTML in the panel, and for viser's widgets.

Text has a contrast of 4.5 or more to its background, light and dark. Shapes or words repeat what
colours say. Empty ``.ai4u.mark`` elements select the widget after them: viser's widgets can't be
given classes of their own.
"""

MAX_MAIN_PANEL_HEIGHT = "25em"
"""Largest height of the main panel; the tabs below it get the rest."""

_COLOURS = """
:root[data-mantine-color-scheme=light] {--mantine-color-dimmed: #566270;
  --mantine-color-blue-filled: #1971c2; --mantine-primary-color-filled: #1971c2;
  --mantine-color-blue-outline: #1864ab}
:root[data-mantine-color-scheme=dark] {--mantine-color-dimmed: #a9b4c0}
[data-mantine-color-scheme=dark] [role=tab][aria-selected=true] {color: #74c0fc !important}
.ai4u {--soft: #566270; --accent: #0072b2; --on: #fff; --warn: #a83f00; --line: #ced4da;
  --well: #e9edf1; --good: #009e7366}
[data-mantine-color-scheme=dark] .ai4u {--soft: #a9b4c0; --accent: #56b4e9; --on: #0b1720;
  --warn: #f39c5a; --line: #4a525c; --well: #363c43; --good: #009e7399}
"""

_TEXT = """
.ai4u {margin: 0 .9em .7em; font-size: .8em; line-height: 1.5; overflow-wrap: anywhere;
  font-variant-numeric: tabular-nums}
.ai4u p {margin: .5em 0 .2em; font-weight: 600}
.ai4u small, .ai4u th {color: var(--soft)}
.ai4u small {font-size: .87em}
.ai4u p > small {font-weight: 400}
.ai4u strong {color: var(--warn)}
.ai4u span {white-space: nowrap; margin-right: .8em}
.ai4u i {display: inline-block; width: .7em; height: .7em; border-radius: 50%; margin-right: .3em}
.ai4u .goal {line-height: 1.4; display: -webkit-box; -webkit-box-orient: vertical;
  -webkit-line-clamp: 2; overflow: hidden}
.ai4u .goal:hover {-webkit-line-clamp: unset}
.ai4u table {width: 100%; border-collapse: collapse}
.ai4u th {font-weight: 450; text-align: left; vertical-align: top; padding-right: 1em}
.ai4u th b {font-weight: 700; color: var(--mantine-color-text)}
.ai4u td {text-align: right}
.ai4u tr.sum > * {border-top: 1px solid var(--line)}
.ai4u pre {display: inline-block; margin: .1em .5em .2em 0; padding: 0 .15em; font-size: .85em;
  line-height: 1.1; font-family: monospace; background: var(--well)}
.ai4u svg {display: block; margin: .2em .5em .2em 0; max-width: 100%; background: var(--well)}
"""

_BARS = """
.ai4u .bars {display: grid; grid-template-columns: minmax(4.5em, auto) 1fr minmax(3.4em, auto);
  gap: .15em .6em; align-items: center}
.ai4u .bars > span {margin: 0; color: var(--soft)}
.ai4u .bars > b {font-weight: 500; text-align: right}
.ai4u .bar {position: relative; height: .8em; border-radius: 3px; background: var(--well);
  overflow: hidden}
.ai4u .bar > s {position: absolute; left: 0; top: .15em; bottom: .15em; background: var(--accent)}
.ai4u .bar > u {position: absolute; top: 0; bottom: 0; background: var(--good)}
.ai4u .bar > u.zero {width: 1px; background: var(--soft)}
.ai4u .past {grid-column: 2; display: flex; height: 1em; gap: 1px; align-items: flex-end}
.ai4u svg.strip {width: 100%; height: 2.6em; fill: var(--accent)}
.ai4u svg.strip.old {height: 1em; opacity: .75}
.ai4u .row {display: flex; flex-wrap: wrap; align-items: flex-end}
"""

_DECISION = """
.ai4u .decision {display: flex; align-items: stretch; gap: 3px; margin-bottom: .25em}
.ai4u .decision > span {flex: 0 0 auto; margin: 0; padding: .1em .45em; border-radius: 4px;
  background: var(--well); border: 1px solid transparent; color: var(--soft)}
.ai4u .decision > .act {flex: 1 1 auto; display: flex; gap: 3px; align-items: center;
  min-width: 0}
.ai4u .decision > .now {border-color: var(--accent); color: var(--mantine-color-text);
  font-weight: 700}
.ai4u .act > em {flex: 1 1 0; max-width: 1.1em; height: .75em; border-radius: 2px;
  border: 1px solid var(--accent)}
.ai4u .act > em.coasts {height: .3em}
.ai4u .act > em.done {background: var(--accent)}
.ai4u .act > em.now {outline: 2px solid var(--mantine-color-text); outline-offset: 1px}
"""

_WIDGETS = f"""
[data-dock-scroll] > :first-child:not(:only-child):has(.ai4u.status)
  {{max-height: {MAX_MAIN_PANEL_HEIGHT} !important}}
[data-dock-scroll] > :first-child:has(.ai4u.status) ~ :last-child {{flex-grow: 1 !important}}
.ai4u.mark {{display: none}}
div:has(> .ai4u.bare) + div > div > div:first-child {{display: none}}
div:has(> .ai4u.bare) + div button {{padding-inline: .5em}}
div:has(> .ai4u.mark[data-on="1"]) + div button:nth-of-type(1),
div:has(> .ai4u.mark[data-on="2"]) + div button:nth-of-type(2),
div:has(> .ai4u.mark[data-on="3"]) + div button:nth-of-type(3),
div:has(> .ai4u.mark[data-on="4"]) + div button:nth-of-type(4)
  {{background: var(--mantine-primary-color-filled); color: #fff; font-weight: 700}}
div:has(> .ai4u.fold) + div > button {{height: 1.9em !important; padding: 0 .6em; background: none;
  font-size: .8em; color: var(--mantine-color-text);
  border: 1px solid var(--mantine-color-default-border)}}
div:has(> .ai4u.fold) + div > button .mantine-Button-inner {{justify-content: flex-start}}
div:has(> button):has(+ div > .ai4u.sense)
  {{margin: .35em .75em .15em !important; padding: 0 !important}}
div:has(+ div > .ai4u.sense) > button {{height: 1.65em !important; padding: 0 .45em;
  font-size: .8em; color: var(--mantine-color-text); background: none;
  border: 1px solid var(--mantine-color-default-border)}}
div:has(+ div > .ai4u.sense.lit) > button {{border-color: var(--mantine-primary-color-filled);
  box-shadow: inset 3px 0 0 var(--mantine-primary-color-filled)}}
div:has(+ div > .ai4u.sense) > button .mantine-Button-inner {{justify-content: flex-start}}
.ai4u.sense {{margin-bottom: .35em}}
"""

STYLE = f"<style>{_COLOURS}{_TEXT}{_BARS}{_DECISION}{_WIDGETS}</style>"
"""The style element, added once to each page's panel."""
