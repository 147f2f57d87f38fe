"""Rays that read distances alone, and fans that point down."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from ai4u_edu import BoxShape, LinearRayCastingSensor, LocalBrain, RayCastingSensor, Scene, World
from ai4u_edu.base.errors import BlockError
from ai4u_edu.learn.envs.element_names import labels_of_reading
from ai4u_edu.page.panel.parts.sensors import sensor_reading
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.snapshot.block_info import block_info_of
from tests.builders import small_sim, small_world

CODES = {"floor": 1, "target": 2, "wall": 4}


def world_with_wall() -> World:
    world = small_world()
    wall = BoxShape(size=(1, 1))
    world.add_body("wall", wall, position=(2, 2), kind="static", height=0.4, tags=("wall",))
    return world


def grid(**fields: Any) -> RayCastingSensor:
    usual: dict[str, Any] = {"perception_key": "eyes", "rows": 3, "columns": 5, "vertical_shift": 5}
    return RayCastingSensor(group_code=CODES, **(usual | fields))


def readings(sensor: Any) -> list[npt.NDArray[np.float32]]:
    sim = small_sim([sensor], world=world_with_wall(), controller=lambda _: {"move": [1, 1, 0, 0]})
    found = []
    for _ in range(20):
        sim.step()
        found.append(np.array(sim.agents[0].percept[sensor.perception_key]))
    return found


@pytest.mark.parametrize("flattened", [False, True])
@pytest.mark.parametrize("share", [False, True])
def test_grid_of_distances_alone_is_the_second_half_of_both(flattened: bool, share: bool) -> None:
    modes = {"flattened": flattened, "normalize_distance": share, "return_distance": True}
    both = readings(grid(**modes))
    alone = readings(grid(return_code=False, **modes))
    sensor = grid(return_code=False, **modes)
    assert alone[0].shape == ((15,) if flattened else (3, 5)) == sensor.space().shape
    for reading, whole in zip(alone, both, strict=True):
        half = whole.reshape(2, -1)[1]
        assert reading.ravel().tolist() == half.tolist()
        assert sensor.space().contains(reading.astype(np.float32))
    assert len({reading.tobytes() for reading in alone}) > 1


def test_grid_that_reads_nothing() -> None:
    with pytest.raises(BlockError) as caught:
        RayCastingSensor(return_code=False)
    assert str(caught.value) == (
        "RayCastingSensor 'ray_casting': expected return_code or return_distance, got neither"
    )


def test_numbers_of_a_grid_of_distances_have_names_and_metres() -> None:
    sensor = grid(return_code=False, return_distance=True, normalize_distance=False)
    small_sim([sensor])
    labels = labels_of_reading(sensor)
    assert len(labels) == 15
    assert labels[7] == ("distance, row 1, column 2", "m")


@pytest.mark.parametrize("down", [15, -10, 60])
@pytest.mark.parametrize("codes", [True, False])
def test_shifted_fan_reads_as_one_row_of_a_grid(down: float, codes: bool) -> None:
    modes: dict[str, Any] = {
        "field_of_view": 120,
        "vertical_shift": down,
        "return_code": codes,
        "return_distance": True,
        "vision_max_distance": 6,
    }
    fan = readings(
        LinearRayCastingSensor(perception_key="fan", number_of_rays=5, group_code=CODES, **modes)
    )
    row = readings(grid(rows=1, **modes))
    parts = 1 + codes
    for from_right, from_left in zip(fan, row, strict=True):
        rays = from_right.reshape(5, parts)[::-1].T
        assert rays.tolist() == from_left.reshape(parts, 5).tolist()


def test_shifted_fan_sees_the_floor_and_draws_its_rays_down() -> None:
    fan = LinearRayCastingSensor(
        perception_key="fan",
        number_of_rays=1,
        vertical_shift=30,
        eye=(0, 0, 1),
        group_code=CODES,
        normalized=False,
        normalize_distance=False,
        return_distance=True,
    )
    sim = small_sim([fan])
    assert sim.agents[0].percept["fan"].tolist() == pytest.approx([1, 2])
    assert fan.picture().groups == ("floor",)
    assert fan.picture().ends[0].tolist() == pytest.approx([3**0.5, 0, 0])


def test_fan_that_looks_straight_down_is_refused() -> None:
    with pytest.raises(Exception, match="vertical_shift"):
        LinearRayCastingSensor(vertical_shift=90)


def test_panel_draws_distances_alone_as_greys() -> None:
    sensor = grid(return_code=False, return_distance=True, stacked_observations=2)
    sim = small_sim([sensor], world=world_with_wall())
    sim.step()
    agent = sim.agents[0]
    info = next(each for each in block_info_of(agent).sensor_infos if each.key == "eyes")
    shown = sensor_reading(
        info, agent.percept["eyes"], {}, None, title="", is_drawable=True, is_shown=True
    )
    assert isinstance(shown.pictures, list)
    assert [each.caption for each in shown.pictures] == ["distance: dark is near", "earlier"]


SCENE = """
name: modes
floors: [{name: plate, shape: {type: box, size: [8, 8]}}]
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 0], tags: [box]}
agents:
  - body: robot
    max_steps_per_episode: 12
    sensors:
      - {type: RayCastingSensor, return_code: false, return_distance: true}
      - type: LinearRayCastingSensor
        vertical_shift: 15
        return_distance: true
        group_code: {floor: 1, box: 2}
    actuators: [{type: RBMoveActuator, move_amount: 3}]
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
"""


def test_both_modes_are_replayed_bit_for_bit() -> None:
    scene = Scene.loads(SCENE)
    assert Scene.loads(scene.dumps()) == scene
    drive = LocalBrain(controller=lambda _: {"move": [1, 0.5, 0, 0]})
    sim = scene.build(brains=lambda _: drive)
    seen: list[bytes] = []
    sim.agents[0].percept_ready.connect(lambda agent: seen.append(agent.percept.data))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(4)
    for _ in range(12):
        sim.step()
    recorder.finish()
    replay = Replay(recorder.episodes[-1])
    assert replay.verdict.why == ""
    assert [percept.data for part in replay.percepts() for percept in part] == seen
    assert len(set(seen)) > 6
