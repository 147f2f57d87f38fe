"""Results of a class as one HTML page that needs nothing else; all texts are escaped."""

import json
from collections.abc import Iterator

from ai4u_edu.base.html_report import html_report
from ai4u_edu.classroom.class_event import misconceptions
from ai4u_edu.classroom.course_index import course_index
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.race import WINNING
from ai4u_edu.classroom.tournament.runner import VIEW

ENDS = {"fell": "fell", "lost": "lost", "time": "time was up", "over": "not reached"}
"""Words for the end of a drive that did not reach the goal."""
WORDS = {"solved": "solved", "tried": "not yet", "hint": "not yet, with hints"}


Rows = list[tuple[object, ...]]


def results_page(live: LiveClass) -> str:
    """Return the page: progress, stars, mistakes, races, tournaments.

    Exercises that nobody has begun are left out.
    """
    begun = {exercise for _, exercise in live.progress.entries}
    return html_report(
        "classroom/results_page.html",
        seats=live.seats.all(),
        exercises=[each for one in course_index() for each in one.ids if each in begun],
        entries=live.progress.entries,
        words=WORDS,
        stars=star_rows(live),
        mistakes=[
            (row["exercise"], len(row["seats"]), row["count"], row["sentence"], row["guide"])
            for row in misconceptions(live.progress.mistakes)
        ],
        program_mistakes=[
            (row["title"], len(row["seats"]), row["count"], row["guide"])
            for row in live.program_runs.mistakes()
        ],
        races=_races(live),
        tournaments=_tournaments(live),
    )


def star_rows(live: LiveClass) -> Iterator[tuple[str, str, int]]:
    """Yield a seat's name, a scene's name and the stars of the seat's program there."""
    for seat in live.seats.all():
        for scene, count in sorted(live.stars.of_seat(seat.number).items()):
            yield seat.name, scene, count


def _races(live: LiveClass) -> Iterator[tuple[str, Rows]]:
    """Yield the title of each race and the best result of each room, also without the goal."""
    for race, title in live.store.query("select id, title from races order by rowid"):
        results = live.store.query(
            "select room, outcome, min(seconds) from race_results where race = ? "
            "and (verdict = 'right' or outcome not in ('goal', 'won')) group by room, outcome "
            "order by outcome not in ('goal', 'won'), min(seconds)",
            [race],
        )
        best: dict[str, tuple[str, float]] = {}
        for room, outcome, seconds in results:
            best.setdefault(room, (outcome, seconds))
        rows: Rows = []
        for place, (room, (outcome, seconds)) in enumerate(best.items(), 1):
            names = " & ".join(each.name for each in live.all_seats_of(room)) or room
            is_winner = outcome in WINNING
            end = f"{seconds:.2f} s" if is_winner else ENDS.get(outcome, outcome)
            rows.append((place if is_winner else "", names, end))
        yield title, rows


def _tournaments(live: LiveClass) -> Iterator[tuple[str, Rows]]:
    """Yield the title and the standings of each tournament that was played."""
    tournaments = live.tournament.tournaments
    for tournament in tournaments.all():
        try:
            view = json.loads((tournaments.work_of(tournament) / VIEW).read_bytes())
        except (OSError, ValueError):  # it was not played
            continue
        yield (
            tournament.title,
            [
                (
                    place,
                    row["name"],
                    f"{row['rating']} ± {row['range']}",
                    *(row[name] for name in ("won", "drawn", "lost", "points")),
                )
                for place, row in enumerate(view["standings"] if view else (), 1)
            ],
        )
