"""Scene files: read, written back, and refused with the line that is wrong."""

import textwrap
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.scenes.serialization import OWN
from ai4u_edu.snapshot import capture_bodies, capture_static_scene

GOOD = """
name: small
bodies:
  - name: robot
    shape: {type: circle, radius: 0.4}
agents:
  - body: robot
    brains:
      - type: LocalBrain
        controller: {type: WASDRBMoveController}
"""


def error_of(text: str) -> str:
    with pytest.raises(SceneError) as caught:
        Scene.loads(textwrap.dedent(text).lstrip("\n"), name="my.yaml")
    return str(caught.value)


def changed(old: str, new: str) -> str:
    text = GOOD.lstrip("\n")
    assert old in text
    return text.replace(old, new)


AI4U_POSES = [
    (0, 0, 0),
    (3.53, 0.51, 0),
    (0, -3.61, 0),
    (0, 4, 0),
    (-1.7, -3.07, 0),
    (3.93, -3.07, 0),
    (3.93, 4.8, 0),
    (3.93, 0.14, 0),
]
"""(x, y, heading in degrees) of the starts in AI4U's box chase."""


@pytest.mark.parametrize("name", Scene.names())
def test_round_trip(name: str, tmp_path: Path) -> None:
    scene = Scene.load(name)
    path = tmp_path / "copy.yaml"
    scene.save(path)
    again = Scene.load(path)  # tried with more seeds than one of the library
    assert again == scene
    assert again.dumps() == scene.dumps()
    assert [str(agent) for agent in again.build().agents] == [
        str(agent) for agent in scene.build().agents
    ]
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", Scene.names())
def test_every_scene_tells_what_to_do(name: str) -> None:
    described = Scene.load(name).description
    assert described.name == name
    for text in (described.title, described.goal, described.controls, described.rewards):
        assert text


def test_box_chase_differs_from_ai4us_in_starts_and_keys_alone() -> None:
    plain, ai4us = Scene.load("box_chase").plain(), Scene.load("box_chase_ai4u").plain()
    for data in (plain, ai4us):
        for name in ("name", "title", "goal", "level", "minutes", "few_decisions"):
            del data[name]
        (agent,) = data["agents"]
        del agent["brains"], agent["actuators"][1]["poses"]
    assert plain == ai4us


def test_the_parity_table_of_box_chase() -> None:
    sim = Scene.load("box_chase_ai4u").build()
    agent = sim.agents[0]
    assert sim.world["box"].position == pytest.approx((-2.39, 0))
    assert agent.actuators[1].values()["poses"] == AI4U_POSES
    move = agent.actuators[0].values()
    amounts = ("move_amount", "turn_amount", "jump_power", "jump_forward_power")
    assert [move[name] for name in amounts] == [5, 5, 0, 0]
    assert agent.max_steps_per_episode == 3000
    sim.reset(seed=0)
    assert agent.percept["vision"].shape == (4, 2, 3, 5)


def test_spawn_poses_come_from_the_seed() -> None:
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]

    def spawn(seed: int) -> tuple[float, float]:
        sim.reset(seed)
        return agent.body.position

    assert [spawn(seed) for seed in range(20)] == [spawn(seed) for seed in range(20)]
    assert len({spawn(seed) for seed in range(100)}) == 8


def test_no_such_scene() -> None:
    with pytest.raises(SceneError) as caught:
        Scene.load("box_chse")
    assert str(caught.value) == (
        "no scene is called 'box_chse'; did you mean 'box_chase'?; a file's name ends in .yaml"
    )


def test_names_do_not_lead_out_of_the_library() -> None:
    with pytest.raises(SceneError, match="no scene is called"):
        Scene.load("../library/box_chase")


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        (
            "type: LocalBrain",
            "type: LocalBrian",
            "my.yaml, line 8: agents[0].brains[0].type: unknown type of brain 'LocalBrian'; "
            f"did you mean 'LocalBrain'?; {OWN}",
        ),
        (
            "type: WASDRBMoveController",
            "type: WASDRBMoveControler",
            "my.yaml, line 9: agents[0].brains[0].controller.type: unknown type of controller "
            f"'WASDRBMoveControler'; did you mean 'WASDRBMoveController'?; {OWN}",
        ),
        (
            "{type: WASDRBMoveController}",
            "{type: WASDRBMoveController, sped: 1}",
            "my.yaml, line 9: agents[0].brains[0].controller.sped: unknown parameter; "
            "did you mean 'speed'?",
        ),
        (
            "radius: 0.4",
            "radius: -0.4",
            "my.yaml, line 4: bodies[0].shape.radius: expected more than 0, got -0.4",
        ),
        (
            "type: circle",
            "type: sphere",
            "my.yaml, line 4: bodies[0].shape: unknown type 'sphere'; known are 'box', 'capsule', "
            "'circle', 'polygon', 'segment'",
        ),
        (
            "radius: 0.4}",
            "radius: 0.4}\n    colour: oragne",
            "my.yaml, line 5: bodies[0].colour: expected '#rrggbb' or a colour's name, got "
            "'oragne'; did you mean 'orange'?",
        ),
        (
            "radius: 0.4}",
            "radius: 0.4}\n    mas: 3",
            "my.yaml, line 5: bodies[0].mas: unknown parameter; did you mean 'mass'?",
        ),
        (
            "body: robot",
            "body: robt",
            "my.yaml, line 6: agents[0].body: agent '0': no body is named 'robt'; did you mean "
            "'robot'?",
        ),
        (
            "  - body: robot\n",
            "  - body: robot\n    priorty: 1\n",
            "my.yaml, line 7: agents[0].priorty: unknown parameter; did you mean 'priority'?",
        ),
        ("name: small", "name: ''",
         "my.yaml, line 1: name: expected at least 1 characters, got ''"),
        ("name: small", "name: small\nfloor: []", "my.yaml, line 2: floor: unknown parameter; "
         "did you mean 'floors'?"),
        ("name: small", "name: small\nname: big", "my.yaml, line 2, column 1: 'name' stands here "
         "for the second time, after line 1; expected each name once\n    name: big\n    ^"),
        ("name: small", "name: [small", "my.yaml, line 1, column 7: this [ is never closed; "
         "expected ] at the end, commas between\n    name: [small\n          ^"),
        ("name: small", "name: &a small", "my.yaml, line 1: expected plain values; anchors (&), "
         "aliases (*) and tags (!) are not used in scene files\n    name: &a small"),
        ("name: small", "name: !!python/object:os.system small", "my.yaml, line 1: expected plain "
         "values; anchors (&), aliases (*) and tags (!) are not used in scene files\n"
         "    name: !!python/object:os.system small"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_line(old: str, new: str, text: str) -> None:
    assert error_of(changed(old, new)) == text


VARIED = """
name: varied
floors:
  - name: plate
    shape: {type: box, size: [8, 8]}
areas:
  - name: goal
    shape: {type: circle, radius: 0.5}
    random:
      places: [[-3, -3], [3, 3]]
      clearance: 0.5
bodies:
  - name: robot
    shape: {type: circle, radius: 0.4}
    random: {x: [-4, 4], y: [-4, 4], heading_deg: [-180, 180], scale: [0.8, 1.2], clearance: 0.3}
  - name: wall
    shape: {type: box, size: [4, 0.5]}
    kind: static
agents:
  - body: robot
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        ("x: [-4, 4]", "x: [4, -4]",
         "my.yaml, line 14: bodies[0].random.x: expected the smaller number first, got "
         "[4.0, -4.0]"),
        ("clearance: 0.5", "x: [0, 1]",
         "my.yaml, line 8: areas[0].random: expected either ranges (x, y) or places, got both; "
         "leave one out"),
        ("scale: [0.8, 1.2]", "scale: [0.8, big]",
         "my.yaml, line 14: bodies[0].random.scale[1]: expected a number, got 'big'"),
        ("clearance: 0.3", "clearence: 0.3",
         "my.yaml, line 14: bodies[0].random.clearence: unknown parameter; did you mean "
         "'clearance'?"),
        ("size: [8, 8]}", "size: [8, 8]}\n    random: {clearance: 1, x: [0, 1]}",
         "my.yaml, line 5: floors[0].random: a floor has bodies on it; expected no clearance, "
         "leave it out"),
        ("clearance: 0.3", "clearance: 9",
         "my.yaml, line 12: bodies[0]: body 'robot': found no free place in 1000 draws (x -4..4, "
         "y -4..4, heading_deg -180..180, scale 0.8..1.2, clearance 9; seed 0); in the way: "
         "body 'wall' (1000 times); give it wider ranges or less clearance, or make it smaller"),
        ("radius: 0.5", "radius: 9",
         "my.yaml, line 6: areas[0]: area 'goal': found no free place in 1000 draws (places "
         "(-3, -3), (3, 3), clearance 0.5; seed 0); in the way: body 'wall' (1000 times); give it "
         "wider ranges or less clearance, or make it smaller"),
        ("name: wall", "name: goal",
         "my.yaml, line 15: bodies[1]: 'goal' is already the name of an area; names are unique"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_what_is_random_is_told(old: str, new: str, text: str) -> None:
    assert old in VARIED
    assert error_of(VARIED.replace(old, new)) == text


def test_that_there_is_room_in_some_episodes_is_not_enough() -> None:
    places = "places: [[0, 2], [0, -2], [0, -2.1], [0, -2.2]]"
    text = VARIED.replace("x: [-4, 4], y: [-4, 4]", f"{places}").replace(
        "bodies:\n", "bodies:\n  - {name: cat, random: {places: [[0, -3], [3, 0]]}}\n"
    )
    Scene.loads(text)
    told = error_of(text.replace("[0, 2], ", ""))
    assert told.startswith(
        "my.yaml, line 13: bodies[1]: body 'robot': found no free place in 1000 "
    )
    assert "seed 0" not in told
    assert "body 'cat'" in told


def test_what_is_random_comes_back_from_the_file() -> None:
    scene = Scene.loads(VARIED)
    again = Scene.loads(scene.dumps())
    assert again == scene
    assert again.plain()["areas"][0]["random"] == {"places": [[-3, -3], [3, 3]], "clearance": 0.5}
    here, there = scene.build(), again.build()
    for seed in (None, 5):
        here.reset(seed)
        there.reset(seed)
        assert capture_static_scene(here) == capture_static_scene(there)
        assert capture_bodies(here) == capture_bodies(there)
    assert scene.dumps() == again.dumps(), "what was drawn is in no file"


def test_a_built_scene_is_the_one_of_its_seed() -> None:
    built = Scene.loads(VARIED).build(seed=3)
    before = capture_static_scene(built), capture_bodies(built)
    built.reset(3)
    assert (capture_static_scene(built), capture_bodies(built)) == before


def test_the_stage_is_another_one_in_each_episode() -> None:
    sim = Scene.loads(VARIED).build()
    static_scenes = []
    for seed in range(5):
        sim.reset(seed)
        static_scenes.append(capture_static_scene(sim))
        robot, wall = static_scenes[-1].bodies
        assert robot.position == sim.world["robot"].position
        assert wall is sim.world["wall"].description
    for each in (
        {static_scene.bodies[0].position for static_scene in static_scenes},
        {static_scene.bodies[0].heading_deg for static_scene in static_scenes},
        {static_scene.bodies[0].shape for static_scene in static_scenes},
    ):
        assert len(each) == len(static_scenes)
    assert {static_scene.areas[0].position for static_scene in static_scenes} == {(-3, -3), (3, 3)}
    assert len({static_scene.bounds for static_scene in static_scenes}) == 1


def test_a_respawn_wins_over_chance() -> None:
    respawn = "    actuators: [{type: RespawnActuator, poses: [[2, 3, 90]]}]\n    brains: [{"
    sim = Scene.loads(VARIED.replace("    brains: [{", respawn)).build()
    for seed in range(3):
        sim.reset(seed)
        assert sim.world["robot"].position == (2.0, 3.0)


def test_all_problems_of_a_kind_are_told_at_once() -> None:
    lines = error_of(
        """
        name: bad
        bodies:
          - {name: a, shape: {type: circle, radius: 0}}
          - {name: b, shape: {type: box, size: [1, 2, 3]}}
        agents:
          - body: a
        """
    ).splitlines()
    assert lines == [
        "my.yaml, line 3: bodies[0].shape.radius: expected more than 0, got 0",
        "my.yaml, line 4: bodies[1].shape.size: expected at most 2 entries, got [1, 2, 3]",
    ]


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("", "expected lines such as name: ..., bodies: ..., agents: ..., got an empty file"),
        ("# a", "expected lines such as name: ..., bodies: ..., agents: ..., got a file without"),
        ("- a", "expected lines such as name: ..., bodies: ..., agents: ..., got a list (a line"),
        ("name:x", "got the text 'name:x'; a space has to follow each colon"),
        ("7", "got the value 7"),
        ("name: x", "my.yaml, line 1: agents: is missing and has no default"),
        ("name: x\nagents: []", "my.yaml, line 2: agents: expected at least 1 entries, got []"),
        ("name: x\nagents: [5]", "my.yaml, line 2: agents[0]: expected a mapping, got 5"),
        ("x" * 300_001, "expected at most 300000 characters, got 300001"),
        ("a: " + "[" * 100 + "]" * 100, "nested more than 24 deep"),
        ("a: 1\nb: " + 101 * "9", "my.yaml, line 2: expected numbers of at most 100 characters"),
        ("a: 1\n---\nb: 1", "my.yaml, line 2: expected one document, got another one"),
        ("a: 1\n[b]: 1", "my.yaml, line 2: expected words as keys, got lists or mappings"),
        ("a: \0", "my.yaml, line 1, column 4: expected text, got the control character 0x00"),
        ("a: {b: *c}", "my.yaml, line 1: expected plain values"),
    ],
)
def test_what_is_no_scene_at_all(text: str, part: str) -> None:
    assert part in error_of(text)


def test_a_deep_nest_is_no_crash() -> None:
    assert error_of("a: " + "[" * 500) == "my.yaml: nested more than 24 deep"
    assert "nest" in error_of("a: " + "[" * 5000)  # newer versions of PyYAML refuse it themselves
    assert "nested" not in error_of("a: " + "[" * 23 + "1" + "]" * 23)


def test_a_missing_file() -> None:
    with pytest.raises(SceneError, match=r"^nowhere\.yaml: can't be read: "):
        Scene.load("nowhere.yaml")


def test_comments_and_short_forms_are_fine() -> None:
    sim = Scene.loads("# mine\n" + GOOD).build()
    assert sim.world["robot"].description.shape.reach == 0.4


def test_a_students_own_block_is_known_by_its_name() -> None:
    from gymnasium.spaces import Box

    from ai4u_edu import Sensor

    class HowHigh(Sensor):
        """Reads z."""

        def space(self) -> Box:
            return Box(-10, 10, (1,))

        def read(self, body: Any, view: Any) -> float:
            return float(body.z)

    text = changed("  - body: robot\n", "  - body: robot\n    sensors: [{type: HowHigh}]\n")
    sim = Scene.loads(text).build()
    sim.reset()
    assert sim.agents[0].percept["how_high"].tolist() == [0.0]
    assert HowHigh.__name__ in str(sim.agents[0])


def test_a_failed_save_leaves_the_old_file(tmp_path: Path, monkeypatch: Any) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("old")
    monkeypatch.setattr("os.fsync", lambda _handle: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        Scene.load("box_chase").save(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
