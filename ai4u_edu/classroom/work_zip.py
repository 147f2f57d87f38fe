"""ZIP files with the work of a class and its results, or with one seat's own work."""

import json
import re
import tempfile
import zipfile
from collections.abc import AsyncIterator, Iterator
from contextlib import suppress
from dataclasses import asdict
from typing import IO

from starlette.concurrency import run_in_threadpool
from starlette.responses import StreamingResponse

from ai4u_edu.base.atomic_write import PREFIX
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.html_template import render_html
from ai4u_edu.classroom.class_event import misconceptions
from ai4u_edu.classroom.course_index import course_index
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import remote_id
from ai4u_edu.classroom.programs import FOLDER as PROGRAMS
from ai4u_edu.classroom.progress import SeatProgress
from ai4u_edu.classroom.race import FOLDER as RACES
from ai4u_edu.classroom.race import WINNING
from ai4u_edu.classroom.scene_file import NAME as SCENE_FILE
from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.classroom.tournament.networks import FOLDER as NETWORKS
from ai4u_edu.classroom.tournament.runner import VIEW
from ai4u_edu.classroom.tournament.tournaments import FOLDER as TOURNAMENTS
from ai4u_edu.lessons import progress_file
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text, translate
from ai4u_edu.scenes import Scene
from ai4u_edu.teach.networks import FOLDER as TAUGHT

CHUNK_BYTES = 2**18
HEADER = ("seat", "name", "exercise", "state", "checks", "hints", "minutes")
MISSION_HEADER = ("name", "mission", "title", "steps", "of", "stars")
MISSIONS = "missions.json"
"""File of a seat's progress in missions."""
SCENES = "scenes"
Files = Iterator[tuple[str, bytes]]
_Rows = list[tuple[object, ...]]
_ENDS = {"fell": _("fell"), "lost": _("lost"), "time": _("time was up"), "over": _("not reached")}
"""Words for the end of a drive that did not reach the goal."""
_STATES = {"solved": _("solved"), "tried": _("not yet"), "hint": _("not yet, with hints")}


def class_zip(live: LiveClass) -> IO[bytes]:
    """Return a temporary file with the work of a class; a thread may do it."""
    return _zipped(_class_files(live))


def seat_zip(live: LiveClass, seat: SeatRow) -> IO[bytes]:
    """Return a temporary file with a seat's work, as ``ai4u-edu play`` opens it."""
    return _zipped(_seat_files(live, seat))


def zip_response(file: IO[bytes], name: str) -> StreamingResponse:
    """Return a response with a file, which is closed at the end."""

    async def parts() -> AsyncIterator[bytes]:
        with file:
            while part := await run_in_threadpool(file.read, CHUNK_BYTES):
                yield part

    headers = {"Content-Disposition": f'attachment; filename="{name}"', "Cache-Control": "no-store"}
    return StreamingResponse(parts(), media_type="application/zip", headers=headers)


def _zipped(files: Files) -> IO[bytes]:
    # without a name, so nothing is left of it whatever happens
    file = tempfile.TemporaryFile()  # noqa: SIM115 - the caller closes it
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files:
            archive.writestr(name, data)
    file.seek(0)
    return file


def _class_files(live: LiveClass) -> Files:
    yield "results.html", _results_page(live).encode()
    yield "progress.csv", _table(live).encode()
    yield "stars.csv", csv_table(("name", "scene", "stars"), _star_rows(live)).encode()
    yield "missions.csv", csv_table(MISSION_HEADER, _mission_rows(live)).encode()
    remote = [remote_id(each.number) for each in live.seats.all()]
    for each in [*live.seats.scenes(), *remote]:
        name = _room_name(live, each)
        for file, data in _room_files(live, each):
            yield f"rooms/{name}/{file}", data
    for seat in live.seats.all():
        own = _file_name(f"{seat.name} {seat.number}")
        for file, data in _programs(live, seat.number):
            yield f"{PROGRAMS}/{own}/{file}", data
        for file, data in _networks(live, seat.number):
            yield f"{NETWORKS}/{own}/{file}", data
    yield from _tournaments(live)
    races = live.store.query("select id, title from races order by rowid")
    for number, (race, title) in enumerate(races, 1):
        rows = live.store.query(
            "select key, room, seconds from race_results where race = ? and verdict = 'right' "
            "order by seconds",
            [race],
        )
        for key, each, seconds in rows:
            path = live.store.folder / RACES / race / f"{key}.episode"
            if path.is_file():
                place = f"races/{number} {_file_name(title)}"
                yield f"{place}/{seconds:.2f} s {_room_name(live, each)}.episode", path.read_bytes()


def _seat_files(live: LiveClass, seat: SeatRow) -> Files:
    rooms = [seat.room, remote_id(seat.number)]
    present = live.present_room(seat)
    found = [dict(_room_files(live, each)) for each in sorted(rooms, key=present.__eq__)]
    yield from ({SCENE_FILE: _first_scene(live, seat.room).encode()} | found[0] | found[1]).items()
    rows = live.store.query(
        "select key, race, seconds from race_results where verdict = 'right' and room in (?, ?)",
        rooms,
    )
    races = live.store.query("select id, title from races order by rowid")
    titles = {race: f"race {number} {title}" for number, (race, title) in enumerate(races, 1)}
    known: set[str] = set()
    for key, race, seconds in rows:
        path = live.store.folder / RACES / race / f"{key}.episode"
        if path.is_file():
            name = _free_name(f"{_file_name(titles[race])} {seconds:.2f} s", known)
            yield f"episodes/{name}.episode", path.read_bytes()
    for file, data in _programs(live, seat.number):
        yield f"{PROGRAMS}/{file}", data
    for file, data in _networks(live, seat.number):
        yield f"{NETWORKS}/{file}", data
    exercises = {
        exercise: asdict(progress_file.ExerciseProgress(entry.state == "solved", tries=entry.tries))
        for (number, exercise), entry in live.progress.entries.items()
        if number == seat.number
    }
    progress = {"version": progress_file.VERSION, "exercises": exercises}
    yield progress_file.FILE, json.dumps(progress, indent=1).encode()
    reached = {name: asdict(each) for name, each in live.missions.of_seat(seat.number).items()}
    yield MISSIONS, json.dumps({"version": 1, "missions": reached}, indent=1).encode()


def _programs(live: LiveClass, seat: int) -> Files:
    """Yield the programs of a seat, as files with different names on all systems."""
    known: set[str] = set()
    for each in live.programs.of_seat(seat):
        if not each.source:
            continue
        name = _free_name(f"{_file_name(each.scene)}-{_file_name(each.agent)}", known)
        yield f"{name}.py", each.source.encode()


def _free_name(stem: str, known: set[str]) -> str:
    """Return a name that is not known yet, whatever its case, and add it to those known."""
    name, number = stem, 1
    while name.casefold() in known:
        number += 1
        name = f"{stem}-{number}"
    known.add(name.casefold())
    return name


def _networks(live: LiveClass, seat: int) -> Files:
    """Yield the latest network of a seat for each scene and part that was not refused."""
    networks = live.tournament.networks
    latest = {each.place: each for each in networks.of_seat(seat) if each.verdict != "refused"}
    for each in latest.values():
        path = networks.path_of(each)
        if path.is_file():
            yield f"{each.scene}{each.part and f'-{each.part}'}.onnx", path.read_bytes()


def _tournaments(live: LiveClass) -> Files:
    """Yield the files of all tournaments, each in a folder as ``ai4u-edu tournament`` has it."""
    tournaments = live.tournament.tournaments
    for number, each in enumerate(tournaments.all(), 1):
        folder = tournaments.folder_of(each)
        place = f"{TOURNAMENTS}/{number} {_file_name(each.title)}"
        for path in sorted(folder.rglob("*")):
            name = path.relative_to(folder).as_posix()
            if not path.is_file() or path.name.startswith(PREFIX):
                continue
            with suppress(FileNotFoundError):  # it is played now
                yield f"{place}/{name}", path.read_bytes()


def _room_files(live: LiveClass, room: str) -> Files:
    """Yield the scene of a room, the scenes that were saved there, and networks that learned."""
    folder = live.store.room_folder(room)
    saved, taught = (
        sorted((folder / SCENES).glob("*.yaml")),
        sorted((folder / TAUGHT).glob("*.onnx")),
    )
    for path in [folder / SCENE_FILE, *saved, *taught]:
        if path.is_file() and not path.name.startswith(PREFIX):
            yield path.relative_to(folder).as_posix(), path.read_bytes()


def _first_scene(live: LiveClass, room: str) -> str:
    """Return the scene of a room in which nothing was changed."""
    try:
        return Scene.load(live.seats.scenes()[room]).source
    except AI4UError:  # the teacher's file is not there any more
        return ""


def _room_name(live: LiveClass, room: str) -> str:
    """Return a name of a room's folder: its seats, also those that were sent out, and its id."""
    names = " & ".join(each.name for each in live.all_seats_of(room))
    return _file_name(f"{names} {room}".strip())


def _file_name(text: str) -> str:
    """Return a text as a part of a path.

    >>> _file_name("../<b>Tag")
    'bTag'
    """
    return re.sub(r"[^\w &-]", "", text)[:80].strip() or "scene"


def _table(live: LiveClass) -> str:
    """Return one line of CSV for each seat and exercise."""
    names = {each.number: each.name for each in live.seats.all()}
    entries = sorted(live.progress.entries.items())
    return csv_table(
        HEADER,
        (
            [seat, names.get(seat, ""), exercise, *_cells(entry)]
            for (seat, exercise), entry in entries
        ),
    )


def _cells(entry: SeatProgress) -> tuple[object, ...]:
    return entry.state, entry.tries, entry.hints, round(entry.seconds / 60, 1)


def _results_page(live: LiveClass) -> str:
    """Return the results as one HTML page that needs nothing else.

    Exercises that nobody has begun are left out.
    """
    begun = {exercise for _seat, exercise in live.progress.entries}
    return render_html(
        "classroom/results.html",
        seats=live.seats.all(),
        exercises=[each for one in course_index() for each in one.ids if each in begun],
        entries=live.progress.entries,
        words=_STATES,
        stars=_star_rows(live),
        missions=_mission_rows(live),
        mistakes=[
            (
                row["exercise"],
                len(row["seats"]),
                row["count"],
                *map(translate, (row["sentence"], row["guide"])),
            )
            for row in misconceptions(live.progress.mistakes)
        ],
        program_mistakes=[
            (translate(row["title"]), len(row["seats"]), row["count"], translate(row["guide"]))
            for row in live.program_runs.mistakes()
        ],
        races=_race_results(live),
        tournaments=_standings(live),
    )


def _star_rows(live: LiveClass) -> Iterator[tuple[str, str, int]]:
    """Yield a seat's name, a scene's name and the stars of the seat's program there."""
    for seat in live.seats.all():
        for scene, count in sorted(live.stars.of_seat(seat.number).items()):
            yield seat.name, scene, count


def _mission_rows(live: LiveClass) -> Iterator[tuple[object, ...]]:
    """Yield a seat's name, a mission, its title, finished steps, all steps, and stars.

    A mission whose file was removed has no title and no steps.
    """
    for seat in live.seats.all():
        for name, reached in sorted(live.missions.of_seat(seat.number).items()):
            mission = live.missions.known.get(name)
            title = "" if mission is None else translate(library_text(mission.title))
            steps = "" if mission is None else len(mission.steps)
            yield seat.name, name, title, reached.steps, steps, reached.stars


def _race_results(live: LiveClass) -> Iterator[tuple[str, _Rows]]:
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
        rows: _Rows = []
        for place, (room, (outcome, seconds)) in enumerate(best.items(), 1):
            names = " & ".join(each.name for each in live.all_seats_of(room)) or room
            is_winner = outcome in WINNING
            end = f"{seconds:.2f} s" if is_winner else translate(_ENDS.get(outcome, outcome))
            rows.append((place if is_winner else "", names, end))
        yield title, rows


def _standings(live: LiveClass) -> Iterator[tuple[str, _Rows]]:
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
