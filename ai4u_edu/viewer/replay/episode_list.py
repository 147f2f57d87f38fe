"""The kept episodes as a table, and links to download one, as HTML."""

from collections.abc import Iterable
from html import escape

from ai4u_edu.recording import ArchiveEntry
from ai4u_edu.snapshot.numbers import number
from ai4u_edu.viewer.panel.html_parts import section

STYLE = """<style>
.ai4u .episodes {max-height: 11em; overflow-y: auto; border: 1px solid var(--line)}
.ai4u .episodes th, .ai4u .episodes td {padding: .05em .45em; white-space: nowrap}
.ai4u .episodes thead th {position: sticky; top: 0; background: var(--well)}
.ai4u .episodes td:last-child {width: 100%; max-width: 0; overflow: hidden; text-align: left;
  text-overflow: ellipsis}
.ai4u .episodes tr.chosen > * {font-weight: 700; color: var(--mantine-color-text);
  background: var(--well)}
.ai4u .downloads {display: flex; flex-wrap: wrap; gap: .4em; align-items: center}
.ai4u .downloads a {padding: .15em .7em; border: 1px solid var(--soft); border-radius: 4px;
  color: var(--mantine-color-text); text-decoration: none}
.ai4u .downloads a:hover, .ai4u .downloads a:focus-visible {background: var(--well)}
</style>"""
HEADINGS = ("", "seed", "time", "reward", "goal", "driver")
FORMATS = {"html": "Page", "gif": "GIF", "mp4": "MP4", "csv": "Table", "episode": "Recording"}
"""Labels of the download formats, by file extension."""


def episode_table(
    entries: Iterable[ArchiveEntry], chosen: int | None, best: ArchiveEntry | None = None
) -> str:
    """Return a table of episodes, the latest first.

    Args:
        entries: the kept episodes.
        chosen: number of the chosen episode.
        best: the episode that gets a star.
    """
    rows = [_row(each, each.number == chosen, each is best) for each in reversed(tuple(entries))]
    if not rows:
        return section("<small>Every episode is kept here when it is over.</small>")
    head = "".join(f"<th>{heading}</th>" for heading in HEADINGS)
    table = f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
    region = 'class="episodes" tabindex="0" role="region" aria-label="Kept episodes"'
    return STYLE + section(f"<div {region}>{table}</div>")


def download_links(chosen: int, formats: Iterable[str]) -> str:
    """Return links to an episode's files.

    Args:
        chosen: the episode's number.
        formats: file extensions, among :data:`FORMATS`.
    """
    links = [f'<a href="api/past/{chosen}.{each}" download>{FORMATS[each]}</a>' for each in formats]
    return section(f'<div class="downloads">Download: {"".join(links)}</div>')


def driver(entry: ArchiveEntry) -> str:
    """Return a short name of the first agent's driver."""
    return entry.source or short_brain_title(entry.first.driver)


def short_brain_title(title: str) -> str:
    """Return a brain's title without the parts that all titles share.

    >>> short_brain_title("LocalBrain(WASDRBMoveController)")
    'WASDRBMove'
    >>> short_brain_title("Recording, RemoteBrain(a script)")
    'Recording, a script'
    """
    parts = [part.rstrip(")").rpartition("(")[2] for part in title.split(", ")]
    return ", ".join(part.removesuffix("Controller") or part for part in parts)


def _row(entry: ArchiveEntry, is_chosen: bool, is_best: bool) -> str:
    episode, goal = entry.episode, entry.success
    cells = (
        str(episode.seed) if episode.seed < 10**7 else f"{str(episode.seed)[:6]}…",
        f"{episode.seconds:.1f} s",
        number(entry.first.total),
        "-" if goal is None else "yes" if goal else "no",
        escape(driver(entry)),
    )
    row = "".join(f"<td>{cell}</td>" for cell in cells)
    chosen = ' class="chosen" aria-current="true"' if is_chosen else ""
    star = ' <b title="the best one" aria-label="the best one">★</b>' if is_best else ""
    return f"<tr{chosen}><th>{entry.number}{star}</th>{row}</tr>"
