"""Results of a class as one HTML page that needs nothing else; all texts are escaped."""

import html
import json
from collections.abc import Iterable, Iterator

from ai4u_edu.classroom.class_event import misconceptions
from ai4u_edu.classroom.course_index import course_index
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.race import WINNING
from ai4u_edu.classroom.tournament.runner import VIEW

POLICY = "default-src 'none'; style-src 'unsafe-inline'"
STYLE = """body{font:15px/1.4 system-ui,sans-serif;margin:1em;color:#1b2530}
table{border-collapse:collapse;margin:.7em 0}td,th{border:1px solid #c9ced4;padding:.15em .5em;
text-align:left;vertical-align:top}.solved{background:#cdeee2}.hint,.tried{background:#fbdfcc}"""
ENDS = {"fell": "fell", "lost": "lost", "time": "time was up", "over": "not reached"}
"""Words for the end of a drive that did not reach the goal."""
WORDS = {"solved": "solved", "tried": "not yet", "hint": "not yet, with hints"}


def results_page(live: LiveClass) -> str:
    """Return the page: progress, mistakes, races."""
    parts = [
        f"<h1>Results of the class</h1><p>{len(live.seats)} seats.</p>",
        "<h2>Exercises</h2>",
        _progress(live),
        "<h2>Stars of programs</h2>",
        _table(("student", "scene", "stars"), star_rows(live)),
        "<h2>Mistakes in exercises</h2>",
        _table(
            ("exercise", "students", "times", "hint that students got", "what to say"),
            (
                (
                    each["exercise"],
                    len(each["seats"]),
                    each["count"],
                    each["sentence"],
                    each["guide"],
                )
                for each in misconceptions(live.progress.mistakes)
            ),
        ),
        "<h2>Mistakes in programs</h2>",
        _table(
            ("mistake", "students", "times", "what to say"),
            (
                (each["title"], len(each["seats"]), each["count"], each["guide"])
                for each in live.program_runs.mistakes()
            ),
        ),
        *_races(live),
        *_tournaments(live),
    ]
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        "<title>AI4U Edu: results of the class</title>"
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        f"<style>{STYLE}</style></head><body>" + "\n".join(parts) + "</body></html>\n"
    )


def _progress(live: LiveClass) -> str:
    """Return the table of seats and exercises that somebody has begun."""
    entries = live.progress.entries
    begun = {exercise for _, exercise in entries}
    exercises = [each for one in course_index() for each in one.ids if each in begun]
    head = "".join(f"<th>{html.escape(each)}</th>" for each in exercises)
    rows = []
    for seat in live.seats.all():
        cells = []
        for each in exercises:
            entry = entries.get((seat.number, each))
            if entry is None:
                cells.append("<td></td>")
                continue
            text = f"{WORDS[entry.state]}, checks: {entry.tries}, minutes: {entry.seconds / 60:.1f}"
            cells.append(f'<td class="{entry.state}">{html.escape(text)}</td>')
        rows.append(f"<tr><th>{html.escape(seat.name)}</th>{''.join(cells)}</tr>")
    return f"<table><tr><th></th>{head}</tr>{''.join(rows)}</table>"


def star_rows(live: LiveClass) -> Iterator[tuple[str, str, int]]:
    """Yield a seat's name, a scene's name and the stars of the seat's program there."""
    for seat in live.seats.all():
        for scene, count in sorted(live.stars.of_seat(seat.number).items()):
            yield seat.name, scene, count


def _races(live: LiveClass) -> Iterator[str]:
    """Yield a table for each race: the best result of each room, also of one without a goal."""
    for race, title in live.store.query("select id, title from races order by rowid"):
        rows = live.store.query(
            "select room, outcome, min(seconds) from race_results where race = ? "
            "and (verdict = 'right' or outcome not in ('goal', 'won')) group by room, outcome "
            "order by outcome not in ('goal', 'won'), min(seconds)",
            [race],
        )
        yield f"<h2>Race: {html.escape(title)}</h2>"
        best: dict[str, tuple[str, float]] = {}
        for room, outcome, seconds in rows:
            best.setdefault(room, (outcome, seconds))
        yield _table(
            ("place", "who", "time"),
            (
                (place, _names(live, room), f"{seconds:.2f} s")
                if outcome in WINNING
                else ("", _names(live, room), ENDS.get(outcome, outcome))
                for place, (room, (outcome, seconds)) in enumerate(best.items(), 1)
            ),
        )


def _tournaments(live: LiveClass) -> Iterator[str]:
    """Yield a table for each tournament that was played: its standings."""
    tournaments = live.tournament.tournaments
    for each in tournaments.all():
        try:
            view = json.loads((tournaments.work_of(each) / VIEW).read_bytes())
        except (OSError, ValueError):  # it was not played
            continue
        yield f"<h2>Tournament: {html.escape(each.title)}</h2>"
        yield _table(
            ("place", "who", "rating", "won", "drawn", "lost", "points"),
            (
                (
                    place,
                    row["name"],
                    f"{row['rating']} ± {row['range']}",
                    *(row[name] for name in ("won", "drawn", "lost", "points")),
                )
                for place, row in enumerate(view["standings"] if view else (), 1)
            ),
        )


def _names(live: LiveClass, room: str) -> str:
    return " & ".join(each.name for each in live.all_seats_of(room)) or room


def _table(heads: Iterable[object], rows: Iterable[Iterable[object]]) -> str:
    head = "".join(f"<th>{html.escape(str(each))}</th>" for each in heads)
    body = "".join(
        f"<tr>{''.join(f'<td>{html.escape(str(each))}</td>' for each in row)}</tr>" for row in rows
    )
    return f"<table><tr>{head}</tr>{body}</table>"
