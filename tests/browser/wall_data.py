"""Messages of the teacher's socket for a class of any size, as the gateway would send them."""

import json
import math
from functools import cache
from typing import Any

from msgspec.structs import asdict

from ai4u_edu.classroom.live_rooms import LiveRoom
from ai4u_edu.classroom.names import COLOURS, words_of
from ai4u_edu.classroom.teacher import join_code
from ai4u_edu.member.thumbnail import drawing_of, poses_of
from ai4u_edu.page.server.library_pictures import picture_address
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.wire.class_link import Drawing, Poses, Switches

CODE = "KVBTM"
MAX_SEEDS = 8
"""Different starts of a scene."""
CIRCLE_M = 0.5
"""Radius in which robots drive."""
ADDRESS = "http://192.168.4.20:8080/"
MARKUP = "<img src=x onerror=alert(1)>"
"""A name that would do harm if a page took it for HTML."""
EXERCISES = [
    {"lesson": "02", "title": "Drive", "ids": ["02.1", "02.2", "02.3", "02.exit"]},
    {"lesson": "03", "title": "Build an agent", "ids": ["03.1", "03.2", "03.3", "03.exit"]},
    {
        "lesson": "04",
        "title": "Sensors: what can it know?",
        "ids": ["04.1", "04.2", "04.3", "04.4", "04.exit"],
    },
]
SCENES = [
    {
        "name": name,
        "title": title,
        "stars": 3,
        "picture": picture_address(name),
        "is_duel": name == "soccer",
    }
    for name, title in (
        ("box_chase", "Box chase"),
        ("soccer", "Soccer"),
        ("maze", "Corner maze"),
        ("parking", "Parking"),
    )
]
MISSIONS = [
    {"name": "drive-1", "title": "First drive", "island": "Drive", "steps": 4, "stars": 3},
    {"name": "drive-2", "title": "Round the ring", "island": "Drive", "steps": 3, "stars": 3},
    {"name": "sense-1", "title": "Who sees what?", "island": "Sense", "steps": 3, "stars": 1},
]
STATUSES = ["driving"] * 5 + ["solved", "fell", "driving", "idle", "solved", "waiting", "error"]
_IDS = [name for lesson in EXERCISES for name in lesson["ids"]]
_MISTAKES = [
    (
        "04.2",
        "narrow",
        "Your rays look straight ahead only: a box at the side is never seen.",
        "Draw the field of view on the board. Ask: where could the box hide?",
    ),
    (
        "04.2",
        "far",
        "The rays end before the wall, so an empty answer can mean two things.",
        "Let them compare the reach with the size of the plate.",
    ),
    (
        "03.2",
        "sign",
        "It turns away from the box: the sign of the angle is the other way round.",
        "Stand up, turn left, and ask for the sign of the angle. Positive is to the left.",
    ),
    (
        "02.3",
        "units",
        "The angle is in radians; 90 turns the robot many times around.",
        "A half turn is about 3.14. Ask for a quarter turn.",
    ),
]


def class_message(count: int, **changes: Any) -> dict[str, Any]:
    """Return the state of a class with a number of rooms, a seat in each."""
    seats = [_seat(number) for number in range(1, count + 1)]
    message = {
        "type": "class",
        "code": CODE,
        "address": ADDRESS,
        "qr": join_code(ADDRESS, CODE),
        "open": True,
        "attention": {"kind": "", "message": "", "ends_in": 0.0},
        "switches": asdict(Switches()),
        "shown": {"kind": "join", "room": "", "game": 0},
        "race": None,
        "tournament": None,
        "handed_in": {"missing": "", "networks": []},
        "scenes": SCENES,
        "exercises": EXERCISES,
        "lessons": [
            {"number": each["lesson"], "title": each["title"], "scene": scene}
            for each, scene in zip(EXERCISES, ("box_chase", "", "maze"), strict=True)
        ],
        "seats": seats,
        "rooms": [_room(number) for number in range(1, count + 1)],
        "progress": {str(number): _progress(number) for number in range(1, count + 1)},
        "missions": MISSIONS,
        "mission_progress": {"3": {"drive-1": [4, 2]}, "4": {"drive-1": [1, 0], "drive-2": [3, 1]}},
        "mission_places": {"3": mission_place(2), "4": mission_place(1, hint="It fell.")},
        "stars": {"3": {"box_chase": 3, "maze": 1}, "4": {"maze": 2}},
        "misconceptions": _misconceptions(count),
    }
    return {**message, **changes}


def mission_place(step: int, **changes: Any) -> dict[str, Any]:
    """Return where a seat is in the mission "First drive"."""
    place = {"mission": "drive-1", "title": "First drive", "step": step, "steps": 4}
    return {**place, "is_done": False, "hint": "", "minutes": 6, **changes}


def race(count: int, phase: str = "running", starts_in: float = 0.0) -> dict[str, Any]:
    """Return a race with a number of results."""
    rows = [
        {
            "name": name_of(number),
            "colour": COLOURS[(number - 1) % len(COLOURS)],
            "room": room_id(number),
            "outcome": "goal",
            "seconds": 12.4 + 1.7 * place,
        }
        for place, number in enumerate(range(3, 3 + count))
    ]
    return {
        "id": "race1",
        "phase": phase,
        "starts_in": starts_in,
        "scene": "Box chase",
        "is_board_hidden": False,
        "board": rows,
    }


def handed_in(count: int) -> dict[str, Any]:
    """Return the networks of a number of seats, some of which wait or were refused."""
    networks = []
    for number in range(1, count + 1):
        verdict = {3: "refused", 5: "open"}.get(number, "right")
        networks.append(
            {
                "key": f"network{number}",
                "seat": number,
                "scene": "soccer",
                "part": "keeper" if number == 4 else "",
                "file": f"policy{number}.onnx",
                "verdict": verdict,
                "reason": REFUSAL if verdict == "refused" else "",
            }
        )
    return {"missing": "", "networks": networks}


def tournament(count: int, phase: str = "running") -> dict[str, Any]:
    """Return a tournament of a number of seats, of which the first wins against all others."""
    entries = [_entry(number) for number in range(1, count + 1)]
    standings = [
        {
            **entry,
            "rating": 34.0 - 18.0 * place / count,
            "range": 9.5 if place % 4 else 13.5,
            "is_provisional": place % 4 == 0,
            "won": sum(row[0] for row in against if row),
            "drawn": sum(row[1] for row in against if row),
            "lost": sum(row[2] for row in against if row),
            "failed": 0,
            "points": 12.5 - 3.25 * place,
            "against": against,
        }
        for place, entry in enumerate(entries)
        for against in [[_against(place, other) for other in range(count)]]
    ]
    latest: list[dict[str, Any]] = [
        {
            "entries": [
                {**entries[place], "rank": 0, "points": 10.5},
                {**entries[place + 1], "rank": 1, "points": -10.5},
            ],
            "seed": 0,
            "problem": REFUSAL if place == 1 else "",
            "has_failed": place == 1,
            "games": [_game(2 * place + 1, entries[place], entries[place + 1])],
        }
        for place in range(min(4, count - 1))
    ]
    return {
        "id": "tournament1",
        "scene": "soccer",
        "title": "Soccer",
        "phase": phase,
        "problem": "",
        "players": count,
        "results": {
            "games": 3 * count,
            "total": count * (count - 1),
            "is_race": False,
            "standings": standings,
            "latest": latest,
            "best": [each["games"][0] for each in latest],
            "refused": [],
        },
    }


REFUSAL = "it took 1.3 s of processor time for a decision; expected at most 1 s"


def _entry(number: int) -> dict[str, Any]:
    colour = COLOURS[(number - 1) % len(COLOURS)]
    return {"name": name_of(number), "colour": colour, "seat": number}


def _against(place: int, other: int) -> list[int] | None:
    """Return what an entry has won, drawn and lost against another one; None if they still have to
    play."""
    if place == other or (place + other) % 5 == 4:
        return None
    if (place + other) % 4 == 3:
        return [0, 1, 0]
    return [1, 0, 0] if place < other else [0, 0, 1]


def _game(number: int, one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    return {"number": number, "who": [one, other], "points": [10.5, -10.5], "seed": 0}


def drawing_message(number: int) -> dict[str, Any]:
    """Return the drawing of a room."""
    drawing, _ = _world(_scene(number)["name"], number % MAX_SEEDS)
    live = LiveRoom(room_id(number), "local")
    live.note_drawing(drawing)
    message: dict[str, Any] = json.loads(live.drawing_json)
    return message


def poses_message(count: int, time_s: float) -> dict[str, Any]:
    """Return the poses of all rooms at a time: those that drive go round."""
    return {
        "type": "poses",
        "rooms": {room_id(number): _poses(number, time_s) for number in range(1, count + 1)},
    }


def name_of(number: int) -> str:
    """Return the name of a seat."""
    first, second = words_of("en")
    return f"{first[(7 * number) % len(first)]} {second[(11 * number) % len(second)]}"


def room_id(number: int) -> str:
    """Return the id of a seat's room."""
    return f"room{number}"


@cache
def _world(scene: str, seed: int) -> tuple[Drawing, Poses]:
    sim = Scene.load(scene).build()
    sim.reset(seed=seed)
    snapshot = capture_snapshot(sim)
    drawing = drawing_of(snapshot.static_scene, 1)
    return drawing, poses_of(snapshot, drawing)


def _poses(number: int, time_s: float) -> dict[str, Any]:
    drawing, poses = _world(_scene(number)["name"], number % MAX_SEEDS)
    values = list(poses.values)
    turn = time_s if _status(number) == "driving" else 0.0
    for index, body in enumerate(drawing.bodies):
        if body.is_agent:  # in a small circle
            x, y, heading, _ = values[4 * index : 4 * index + 4]
            x += CIRCLE_M * (math.sin(heading + turn) - math.sin(heading))
            y -= CIRCLE_M * (math.cos(heading + turn) - math.cos(heading))
            values[4 * index : 4 * index + 3] = [x, y, heading + turn]
    return {"drawing": 1, "values": values}


def _seat(number: int) -> dict[str, Any]:
    return {
        "number": number,
        "name": name_of(number),
        "colour": COLOURS[(number - 1) % len(COLOURS)],
        "state": "in",
        "room": room_id(number),
        "is_here": True,
    }


def _status(number: int) -> str:
    return "asleep" if number % 17 == 0 else STATUSES[(5 * number) % len(STATUSES)]


def _scene(number: int) -> dict[str, Any]:
    return SCENES[0 if number % 5 else (number // 5) % 3]


def _room(number: int) -> dict[str, Any]:
    status = _status(number)
    needs, why = {
        "fell": (30 + 8 * (number % 5), f"fell {3 + number % 5} times"),
        "error": (90, "its world has an error"),
        "idle": (32, "nobody has driven for 3 minutes"),
    }.get(status, (8 * (number % 4), ""))
    return {
        "id": room_id(number),
        "seats": [number],
        "status": status,
        "scene": _scene(number)["title"],
        "driver": "" if status in ("idle", "asleep") else "A person",
        "seconds": 4.0 * number,
        "episodes": number % 9,
        "falls": number % 7,
        "is_solved": status == "solved" or number % 6 == 0,
        "error": "NameError: name 'angel' is not defined (line 4)" if status == "error" else "",
        "is_running": status != "asleep",
        "kind": "local",
        "look_in": f"./r/{room_id(number)}/",
        "help": needs,
        "why": why,
    }


def _progress(number: int) -> dict[str, Any]:
    solved = 3 + (5 * number) % (len(_IDS) - 4)
    found: dict[str, Any] = {
        each: {"state": "solved", "tries": 1 + (index + number) % 4, "minutes": 2.5 + number % 5}
        for index, each in enumerate(_IDS[:solved])
    }
    found[_IDS[solved]] = {
        "state": "hint" if number % 3 == 0 else "tried",
        "tries": 2 + number % 5,
        "minutes": 6.0,
    }
    return found


def _misconceptions(count: int) -> list[dict[str, Any]]:
    found = []
    for step, (exercise, diagnosis, sentence, guide) in enumerate(_MISTAKES, 3):
        seats = list(range(1, count + 1, step))
        found.append(
            {
                "exercise": exercise,
                "diagnosis": f"{exercise}/{diagnosis}",
                "count": len(seats) + step,
                "seats": seats,
                "sentence": sentence,
                "guide": guide,
            }
        )
    return found
