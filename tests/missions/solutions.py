"""A solution of each mission: by sight with keys, by the percept as a program."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import LinearRayCastingSensor
from ai4u_edu.lessons.answers import answers_to
from ai4u_edu.missions.checks import Solves, Starts
from ai4u_edu.missions.events import decision_of
from ai4u_edu.world import BodyDescription
from tests.missions.doing import Action, Doing, Policy
from tests.scenes.solvers import solver_of

Solution = Callable[[Doing], object]
STOP: Action = {"move": [0.0, 0.0, 0.0, 0.0]}


def move(forward: float, turn: float) -> Policy:
    return lambda _: {"move": [forward, turn, 0, 0]}


def to(name: str, speed: float = 1.0) -> Policy:
    """Return a policy that drives to a body by sight."""
    return lambda agent: towards(agent, agent.view[name].position, speed)


def towards(agent: BasicAgent, point: tuple[float, float], speed: float = 1.0) -> Action:
    ahead, left = agent.body.to_local(*point)
    angle = math.atan2(left, ahead)
    forward = speed if abs(angle) < 0.5 else 0.0
    return {"move": [forward, max(-1.0, min(1.0, -2 * angle)), 0, 0]}


def to_marks(count: int, wheels: bool = False) -> Policy:
    """Return a policy that drives from one numbered mark to the next one."""
    state = {"episode": -1, "next": 0}

    def policy(agent: BasicAgent) -> Action:
        areas = [agent.view.areas[f"mark {number + 1}"] for number in range(count)]
        marks = [(area.x, area.y) for area in areas]
        if state["episode"] != agent.episode:
            ahead = [agent.body.to_local(*mark) for mark in marks]
            near = min(range(count), key=lambda each: math.hypot(*ahead[each]))
            state.update(episode=agent.episode, next=near if ahead[near][0] > 0 else near + 1)
        if math.dist(agent.body.position, marks[state["next"] % count]) < 0.5:
            state["next"] += 1
        action = towards(agent, marks[state["next"] % count], 0.6)
        return action if not wheels else wheeled(action)

    return policy


def wheeled(action: Action) -> Action:
    """Return the action of two wheels in place of forward and turn."""
    forward, turn = action["move"][0] or 0.15, action["move"][1] * 0.4
    return {"move": [max(-1, min(1, forward + turn)), max(-1, min(1, forward - turn))]}


def faces_box(agent: BasicAgent) -> float:
    return float(agent.percept["orientation"][0])


def near_rays(agent: BasicAgent) -> Mapping[str, float]:
    sim = agent.requestor
    assert isinstance(sim, ControlRequestor)
    return decision_of(sim, agent).distances


# -- programs --------------------------------------------------------------------------------------


def until_wall(agent: BasicAgent) -> Action:
    return move(0.5, 0)(agent) if near_rays(agent)["ahead"] > 0.8 else STOP


def turn_away(agent: BasicAgent) -> Action:
    return move(0, 0.5)(agent) if near_rays(agent)["ahead"] < 1.2 else move(0.5, 0)(agent)


def follow_wall(agent: BasicAgent) -> Action:
    near = near_rays(agent)
    if near["ahead"] < 0.9:
        return move(0, -0.8)(agent)
    return move(0.5, max(-1.0, min(1.0, near["right"] - 0.8)))(agent)


def to_exit(agent: BasicAgent) -> Action:
    return to_seen("target", agent, follow_wall)


def to_seen(group: str, agent: BasicAgent, otherwise: Policy) -> Action:
    """Return an action to what the rays see of a group, as the blocks "sees" and "direction" do."""
    (sensor,) = (each for each in agent.sensors if isinstance(each, LinearRayCastingSensor))
    codes = np.asarray(agent.percept[sensor.perception_key]).reshape(-1, 2)[:, 0]
    angles = -np.linspace(-1, 1, len(codes)) * sensor.field_of_view / 2
    largest = sensor.largest_code if sensor.normalized else 1.0
    hits = np.isclose(codes, sensor.group_code[group] / largest, atol=1e-3)
    if not hits.any():
        return otherwise(agent)
    shift = float(angles[hits].mean())
    return move(0.6, max(-1.0, min(1.0, shift / 40)))(agent)


def box_by_if(agent: BasicAgent) -> Action:
    return move(1, 0)(agent) if faces_box(agent) > 0.95 else move(0, -0.6)(agent)


class LineProgram:
    """Follows a line, and remembers on which side it was last."""

    def __init__(self) -> None:
        self._last = 1.0

    def __call__(self, agent: BasicAgent) -> Action:
        """Return the speeds of both wheels."""
        eyes = np.asarray(agent.percept["line"])
        if not eyes.any():
            return {"move": [-0.15, 0.15]} if self._last < 0 else {"move": [0.15, -0.15]}
        side = float((eyes * np.array([-2, -1, 0, 1, 2])).sum() / eyes.sum())
        if side:
            self._last = side
        return {"move": [0.35 + 0.12 * side, 0.35 - 0.12 * side]}


def by_solver(scene: str) -> Policy:
    """Return the scene's solver, which sees the percept alone, as a program does."""
    state: dict[str, Any] = {"episode": -1}

    def policy(agent: BasicAgent) -> Action:
        if state["episode"] != agent.episode:
            state.update(episode=agent.episode, drive=solver_of(scene))
        action: Action = state["drive"](agent.percept)
        return action

    return policy


def solved(do: Doing) -> Policy:
    return by_solver(do.run.mission.scene)


# -- missions --------------------------------------------------------------------------------------


def drive_1(do: Doing) -> None:
    do.drive(move(1, 0), 30)
    do.drive(move(0, -1))
    do.drive(to("box"))
    do.new_start()


def drive_2(do: Doing) -> None:
    do.drive(to_marks(8), through=True)


def drive_3(do: Doing) -> None:
    do.drive(move(-1, 0), 60)
    do.drive(sumo(), 6000)


def sumo() -> Policy:
    def policy(agent: BasicAgent) -> Action:
        other = agent.view["orange"].position
        x, y = agent.body.position
        if math.hypot(x, y) > 2.6 and math.hypot(*other) < math.hypot(x, y):
            return towards(agent, (0, 0))
        return towards(agent, other)

    return policy


def sense_1(do: Doing) -> None:
    do.drive(move(0.5, 0))
    do.drive(lambda agent: STOP if faces_box(agent) > 0.99 else move(0, 0.3)(agent))
    do.drive(lambda agent: STOP if faces_box(agent) < -0.97 else move(0, 0.3)(agent))
    do.answer(f"{float(do.agent.percept['orientation'][1]):.2f}")


def sense_2(do: Doing) -> None:
    do.drive(turn_away)
    do.drive(until_wall)
    do.drive(follow_wall)


def sense_3(do: Doing) -> None:
    do.drive(LineProgram(), through=True)


def think_1(do: Doing) -> None:
    do.open("code")
    for _ in range(5):
        if do.drive(move(1, 0), 60):
            break
        do.new_start()
    do.drive(until_wall)


def think_2(do: Doing) -> None:
    do.open("code")
    do.drive(turn_away)


def think_3(do: Doing) -> None:
    do.open("code")
    do.drive(follow_wall)


def think_4(do: Doing) -> None:
    do.drive(to_exit, 4000)
    do.new_start()
    do.drive(to_exit, 12000)


def code_1(do: Doing) -> None:
    do.open("code", "python")
    do.drive(move(0.4, 0.3))
    do.again()
    do.drive(move(0.4, -0.3))


def code_2(do: Doing) -> None:
    do.drive(move(0, -0.3))
    do.again()
    do.drive(box_by_if)
    do.new_start()
    do.drive(box_by_if, 12000)


def code_3(do: Doing) -> None:
    do.drive(LineProgram(), through=True)


def thing(tag: str, number: int, position: tuple[float, float]) -> BodyDescription:
    return BodyDescription.model_validate(
        {
            "name": f"{tag} {number}",
            "shape": {"type": "box", "size": [1, 0.5]},
            "position": position,
            "kind": "static",
            "tags": [tag],
        }
    )


def build_1(do: Doing) -> None:
    reward = {"type": "TouchRewardFunc", "target": "target 1", "reward": 10}
    do.change(bodies=(*do.scene.bodies, thing("target", 1, (4, 0))))
    walls = [thing("wall", number, (2, 3 * number)) for number in (1, -1)]
    do.change(bodies=(*do.scene.bodies, *walls))
    do.change(agents=({**do.scene.agents[0], "rewards": [reward]},))
    do.drive(to("target 1"))


def teach_1(do: Doing) -> None:
    do.drive(to("box"))
    do.open("teach")
    do.drive(move(0.2, 0.5))


def drive_4(do: Doing) -> None:
    do.drive(move(1, 0))
    do.drive(move(-1, 0))
    do.drive(solved(do), 4000)


def drive_5(do: Doing) -> None:
    do.drive(solved(do), through=True)


def drive_6(do: Doing) -> None:
    do.drive(move(1, -1))
    do.drive(move(-1, 0))
    do.new_start()
    do.drive(solved(do), 4000)


def drive_7(do: Doing) -> None:
    do.drive(solved(do))
    do.new_start()
    do.drive(solved(do), 4000)


def drive_8(do: Doing) -> None:
    do.drive(to("block"))
    do.new_start()
    do.drive(solved(do), 4000)


def drive_9(do: Doing) -> None:
    do.drive(solved(do))
    do.new_start()
    do.drive(solved(do), 4000)


def sense_4(do: Doing) -> None:
    do.answer(f"{float(do.agent.percept['position'][0]):.2f}")
    do.drive(to_place((3, 3)))
    do.drive(lambda agent: move(0, -0.2 * (1 - agent.percept["heading"][0]))(agent), 3000)


def to_place(point: tuple[float, float]) -> Policy:
    def policy(agent: BasicAgent) -> Action:
        return STOP if math.dist(agent.body.position, point) < 0.3 else towards(agent, point, 0.6)

    return policy


def sense_5(do: Doing) -> None:
    do.drive(facing("block", 0.0))
    do.drive(facing("block", math.pi / 2))
    do.answer("block changes, position does not")


def facing(name: str, aside: float) -> Policy:
    """Return a policy that turns on the spot until a body is at an angle to the left (rad)."""

    def policy(agent: BasicAgent) -> Action:
        ahead, left = agent.body.to_local(*agent.view[name].position)
        angle = math.remainder(math.atan2(left, ahead) - aside, 2 * math.pi)
        return move(0, max(-1.0, min(1.0, -angle)))(agent)

    return policy


def sense_6(do: Doing) -> None:
    do.answer(f"{float(do.agent.percept['inside'][0]):.2f}")
    do.drive(hungry)
    do.drive(solved(do), 6000)


def hungry(agent: BasicAgent) -> Action:
    food = min(
        (agent.view[f"food {number}"].position for number in (1, 2)),
        key=lambda place: math.dist(place, agent.body.position),
    )
    return towards(agent, food)


def sense_7(do: Doing) -> None:
    do.drive(facing("cube", math.pi / 2))
    do.drive(facing("cube", -math.pi / 2))
    do.answer("The first number of bearing")


def sense_8(do: Doing) -> None:
    do.drive(lambda agent: STOP if agent.percept["hear"][0] else move(0, -0.3)(agent))
    do.drive(solved(do), 4000)
    do.drive(solved(do), 8000)


def sense_9(do: Doing) -> None:
    search = by_solver("ants")
    do.drive(lambda agent: STOP if agent.percept["line"][3] else search(agent), 6000)
    do.drive(solved(do), 12000, through=True)


def think_5(do: Doing) -> None:
    do.open("code", "blocks")
    do.drive(lambda agent: move(0, -agent.percept["bearing"][0])(agent))
    do.new_start()
    do.drive(by_bearing, 6000)


def by_bearing(agent: BasicAgent) -> Action:
    sine, cosine = map(float, agent.percept["bearing"])
    return move(max(0.0, cosine), -sine)(agent)


def think_6(do: Doing) -> None:
    do.open("code", "blocks")
    do.drive(lambda agent: to_seen("food", agent, move(0, 0.4)))
    do.new_start()
    do.drive(by_need, 6000)


def by_need(agent: BasicAgent) -> Action:
    energy, water, *_ = map(float, agent.percept["inside"])
    return to_seen("food" if energy < water else "water", agent, move(0, 0.4))


def think_7(do: Doing) -> None:
    do.open("code", "blocks")
    do.drive(lambda _: {"move": [0.2, 0.4]})
    do.again()
    do.drive(brake_one_wheel, 6000)


def brake_one_wheel(agent: BasicAgent) -> Action:
    line = agent.percept["line"]  # blocks count its eyes from 0, as Python does
    return {"move": [0.0 if line[1] > line[3] else 0.4, 0.0 if line[3] > line[1] else 0.4]}


def think_8(do: Doing) -> None:
    do.open("code", "blocks")
    do.drive(lambda agent: after_runner(agent, 1), 4000)
    do.new_start()
    do.drive(after_free_runner, 12000)


def after_runner(agent: BasicAgent, number: int) -> Action:
    left = float(agent.percept[f"runner {number}"][1])
    return move(0.9, max(-1.0, min(1.0, -8 * left)))(agent)


def after_free_runner(agent: BasicAgent) -> Action:
    free = agent.percept["free"]
    return after_runner(agent, 1 if free[0] > 0 else 2 if free[1] > 0 else 3)


def code_4(do: Doing) -> None:
    do.drive(lambda agent: move(0, -agent.percept["bearing"][0])(agent))
    do.new_start()
    do.drive(solved(do), through=True, limit=6000)


def code_5(do: Doing) -> None:
    do.drive(solved(do), through=True, limit=6000)


def code_6(do: Doing) -> None:
    do.drive(solved(do))
    do.new_start()
    do.drive(solved(do), 12000)


def code_7(do: Doing) -> None:
    do.drive(move(0.3, 0.5))
    do.again()
    do.drive(solved(do), through=True, limit=6000)


TARGET = "target 1"
TOUCH = {"type": "TouchRewardFunc", "target": TARGET, "reward": 10, "cause_episode_to_end": True}


def add_bodies(do: Doing, *bodies: BodyDescription) -> None:
    do.change(bodies=(*do.scene.bodies, *bodies))


def add_block(do: Doing, kind: str, **block: object) -> None:
    agent = do.scene.agents[0]
    do.change(agents=({**agent, kind: [*agent.get(kind, ()), block]},))


def add_reward(do: Doing, **reward: object) -> None:
    add_block(do, "rewards", **reward)


def build_2(do: Doing) -> None:
    add_bodies(do, thing("wall", 1, (4, 0)), thing("wall", 2, (-4, 0)))
    add_block(do, "sensors", type="LinearRayCastingSensor", group_code={"wall": 1})
    (sensor,) = do.scene.agents[0]["sensors"]
    do.change(agents=({**do.scene.agents[0], "sensors": [{**sensor, "return_distance": True}]},))
    do.drive(lambda agent: STOP if near_rays(agent)["ahead"] < 1.1 else move(0.3, 0)(agent))


def build_3(do: Doing) -> None:
    add_bodies(do, thing("target", 1, (4, 0)))
    add_block(do, "sensors", type="BearingSensor", target=TARGET)
    add_block(do, "sensors", type="TouchSensor", target=TARGET)
    do.drive(to(TARGET))


def build_4(do: Doing) -> None:
    do.drive(move(1, 0))
    (motor,) = do.scene.agents[0]["actuators"]
    do.change(agents=({**do.scene.agents[0], "actuators": [{**motor, "move_amount": 2}]},))
    do.drive(move(1, 0))


def build_5(do: Doing) -> None:
    add_bodies(do, thing("target", 1, (4, 0)))
    add_reward(do, **TOUCH)
    add_reward(do, type="FallReward", cause_episode_to_end=True)
    do.drive(move(-1, 0))
    do.again()
    do.drive(to(TARGET))


def build_6(do: Doing) -> None:
    add_bodies(do, *(thing("wall", number, (2, 2 * number - 6)) for number in range(6)))
    add_bodies(do, thing("target", 1, (-4, 0)))
    add_reward(do, **TOUCH)
    do.drive(to(TARGET))
    do.again()
    do.drive(to(TARGET))


def teach_2(do: Doing) -> None:
    do.open("teach")
    do.drive(to("box"), through=True, limit=3000)


def teach_3(do: Doing) -> None:
    do.drive(to("box"), through=True, limit=6000)


def teach_4(do: Doing) -> None:
    do.drive(LineProgram())
    do.new_start()
    do.drive(LineProgram())
    do.answer("To see the line, wherever it stands")


def teach_5(do: Doing) -> None:
    do.open("teach")
    do.drive(to("box"), 3000)
    do.answer("Nobody knows: 3 starts are too few")
    do.new_start()
    do.drive(to("box"), 3000)


def teach_6(do: Doing) -> None:
    do.drive(move(-1, 0), 60)
    do.drive(sumo(), through=True, limit=9000)


def exercise(do: Doing) -> None:
    do.solve("import math\n" + answers_to(do.run.mission.exercise).solution)


def code_17(do: Doing) -> None:
    do.drive(before_the_box)
    do.new_start()
    do.drive(before_the_box)


def before_the_box(agent: BasicAgent) -> Action:
    return STOP if agent.percept["orientation"][1] < 2.1 else move(1, 0)(agent)


def wires(agent: BasicAgent) -> list[float]:
    return [float(agent.percept[f"{side} eye"][0]) for side in ("left", "right")]


def code_18(do: Doing) -> None:
    do.open("code")
    do.drive(lambda agent: {"wheels": wires(agent)[::-1]}, 3000)
    do.new_start()
    do.drive(lambda agent: {"wheels": wires(agent)[::-1]}, 3000)


def by_code(code: str) -> Policy:
    """Return a policy that drives as an answer of a lesson does, with what its notebook has."""
    known: dict[str, Any] = {"Controller": object, "to": to_bearing, "math": math}
    exec(code, known)  # noqa: S102 - the lessons' own answers
    *_, made = (each for each in known.values() if callable(each) and each is not to_bearing)
    state: dict[str, Any] = {"episode": -1}

    def policy(agent: BasicAgent) -> Action:
        if state["episode"] != agent.episode:
            decide = made().get_action if isinstance(made, type) else made
            state.update(episode=agent.episode, decide=decide)
        action: Action | None = state["decide"](agent.percept)
        return action or STOP  # a page would stop a program that returns nothing

    return policy


def to_bearing(bearing: Any) -> Action:
    """Drive towards a bearing, as the function of lessons 06, 07 and 18 does."""
    left, ahead = bearing
    if ahead < 0:
        return {"move": [0, -1 if left > 0 else 1, 0, 0]}
    return {"move": [1, -left, 0, 0]}


def program(do: Doing, code: str = "") -> None:
    """Drive with a program through the mission, with a new start where one is asked for.

    Args:
        do: the mission.
        code: the program; default: the lesson's own solution.
    """
    policy = by_code(code or answers_to(do.run.mission.exercise).solution)
    do.open("code")
    while not do.is_done:
        if isinstance(do.run.step.check, Starts):
            do.new_start()
        elif not do.drive(policy, 4000):
            return


def code_22(do: Doing) -> None:
    do.open("code")
    do.drive(move(0.1, 0))
    do.drive(by_code(answers_to("00.2").solution))
    do.drive(move(0.1, 0.2))


def code_19(do: Doing) -> None:
    do.drive(lambda agent: {"wheels": wires(agent)}, 3000, through=True)


def code_21(do: Doing) -> None:
    do.drive(lambda agent: STOP if agent.percept["colour"][2] < 0.3 else move(0.5, 0)(agent))
    do.again()
    do.drive(ink_orange)


def ink_orange(agent: BasicAgent) -> Action:
    return {"move": [1, 0, 0, 0], "pen": [float(agent.percept["colour"][2] < 0.5)]}


def change_agent(do: Doing, **kinds: object) -> None:
    do.change(agents=({**do.scene.agents[0], **kinds},))
    if isinstance(do.run.step.check, Solves):
        do.check()


def build_7(do: Doing) -> None:
    (motor,) = do.scene.agents[0]["actuators"]
    change_agent(do, actuators=[{**motor, "move_amount": 2, "turn_amount": 3}])


BEARING = {"type": "BearingSensor", "target": "box"}
TOUCH_BOX = {**TOUCH, "target": "box"}
FALL = {"type": "FallReward", "cause_episode_to_end": True}


def build_8(do: Doing) -> None:
    change_agent(do, sensors=[BEARING, {"type": "TouchSensor", "target": "box"}])


def build_9(do: Doing) -> None:
    change_agent(do, rewards=[TOUCH_BOX, FALL])


def build_10(do: Doing) -> None:
    seen = {"type": "OrientationSensor", "target": "box", "visibility_test": True}
    change_agent(do, sensors=[BEARING, {**seen, "info": "distance"}])


def build_12(do: Doing) -> None:
    change_agent(do, rewards=[{"type": "ProgressReward", "target": "box"}, TOUCH_BOX])


def build_13(do: Doing) -> None:
    time = {"type": "RestlessnessRewardFunc", "reward": -0.05, "min_dist": 5}
    change_agent(do, rewards=[TOUCH_BOX, {**FALL, "success_reward": -20}, time])


def build_15(do: Doing) -> None:
    do.open("build")
    (brain,) = do.scene.agents[0]["brains"]
    change_agent(do, brains=[{**brain, "skip_frame": 18}])


def choices(*answers: str) -> Solution:
    def solve(do: Doing) -> None:
        for answer in answers:
            do.answer(answer)

    return solve


KEYS: Mapping[str, object] = {"type": "WASDRBMoveController"}
WRONG_ROBOTS: dict[str, list[dict[str, list[Mapping[str, object]]]]] = {
    "build-7": [
        {"actuators": [{"type": "RBMoveActuator", "move_amount": 2}]},
        {"actuators": [{"type": "RBMoveActuator", "move_amount": 3, "turn_amount": 2}]},
        {"actuators": [{"type": "DifferentialDriveActuator", "action_name": "move"}]},
    ],
    "build-8": [
        {"sensors": [BEARING]},
        {"sensors": [{"type": "TouchSensor", "target": "box"}]},
        {"sensors": [BEARING, {"type": "GroundStatusSensor"}]},
    ],
    "build-9": [
        {"rewards": [TOUCH_BOX]},
        {"rewards": [FALL, {**TOUCH_BOX, "reward": 1}]},
        {"rewards": [FALL, {**TOUCH_BOX, "cause_episode_to_end": False}]},
    ],
    "build-10": [
        {"sensors": [BEARING]},
        {"sensors": [BEARING, {"type": "OrientationSensor", "target": "box"}]},
        {"sensors": [{"type": "VelocitySensor"}]},
    ],
    "build-11": [
        {"sensors": [BEARING]},
        {"sensors": [BEARING, {"type": "OrientationSensor", "target": "box"}]},
        {"sensors": [{"type": "PositionSensor"}]},
    ],
    "build-12": [
        {"rewards": [TOUCH_BOX]},
        {"rewards": [{**TOUCH_BOX, "reward": 1000}]},
        {"rewards": [{"type": "RestlessnessRewardFunc", "reward": 1, "min_dist": 5}]},
    ],
    "build-13": [
        {"rewards": [TOUCH_BOX, FALL]},
        {"rewards": [TOUCH_BOX, {**FALL, "success_reward": -20}]},
        {"rewards": [FALL]},
    ],
    "build-15": [
        {"brains": [{"type": "LocalBrain", "controller": KEYS, "skip_frame": pace}]}
        for pace in (0, 10, 30)
    ],
}
"""Blocks of robots that are no answer, by the mission."""


def build_14(do: Doing) -> None:
    change_agent(do, sensors=[BEARING])
    do.change(success="touch", agents=({**do.scene.agents[0], "rewards": [TOUCH_BOX, FALL]},))
    do.drive(finder, 4000)
    do.new_start()
    do.drive(finder, 8000)


def finder(agent: BasicAgent) -> Action:
    left, ahead = map(float, agent.percept["bearing"])
    return move(0, -1 if left > 0 else 1)(agent) if ahead < 0 else move(1, -left)(agent)


def compete(do: Doing) -> None:
    while not do.is_done:
        do.new_start()
        if not do.drive(solved(do), 12000):
            return


SOLUTIONS: dict[str, Solution] = {
    "drive-1": drive_1,
    "drive-2": drive_2,
    "drive-3": drive_3,
    "drive-4": drive_4,
    "drive-5": drive_5,
    "drive-6": drive_6,
    "drive-7": drive_7,
    "drive-8": drive_8,
    "drive-9": drive_9,
    "sense-1": sense_1,
    "sense-2": sense_2,
    "sense-3": sense_3,
    "sense-4": sense_4,
    "sense-5": sense_5,
    "sense-6": sense_6,
    "sense-7": sense_7,
    "sense-8": sense_8,
    "sense-9": sense_9,
    "think-1": think_1,
    "think-2": think_2,
    "think-3": think_3,
    "think-4": think_4,
    "think-5": think_5,
    "think-6": think_6,
    "think-7": think_7,
    "think-8": think_8,
    "think-9": choices("5", "listen", "patrol", "chase", "chase", "listen"),
    "code-1": code_1,
    "code-2": code_2,
    "code-3": code_3,
    "code-4": code_4,
    "code-5": code_5,
    "code-6": code_6,
    "code-7": code_7,
    "code-8": drive_9,
    "code-9": exercise,
    "code-10": exercise,
    "code-11": exercise,
    "code-12": exercise,
    "code-13": exercise,
    "code-14": exercise,
    "code-15": exercise,
    "code-16": exercise,
    "code-17": code_17,
    "code-18": code_18,
    "code-19": code_19,
    "code-20": exercise,
    "code-21": code_21,
    "code-22": code_22,
    "code-23": program,
    "code-24": program,
    "code-25": program,
    "code-26": program,
    "code-27": program,
    "code-28": program,
    "build-1": build_1,
    "build-2": build_2,
    "build-3": build_3,
    "build-4": build_4,
    "build-5": build_5,
    "build-6": build_6,
    "build-7": build_7,
    "build-8": build_8,
    "build-9": build_9,
    "build-10": build_10,
    "build-11": build_10,
    "build-12": build_12,
    "build-13": build_13,
    "build-14": build_14,
    "build-15": build_15,
    "build-16": choices("lingerer", "jumper", "dancer"),
    "teach-1": teach_1,
    "teach-2": teach_2,
    "teach-3": teach_3,
    "teach-4": teach_4,
    "teach-5": teach_5,
    "teach-6": teach_6,
    "compete-1": compete,
    "compete-2": compete,
    "compete-3": compete,
    "compete-4": compete,
    "compete-5": compete,
    "compete-6": compete,
    "compete-7": exercise,
    "compete-8": exercise,
}

STAR_POLICIES: dict[str, Callable[[], Policy]] = {
    "sense-4": lambda: (
        lambda agent: (
            STOP if max(agent.percept["position"][:2]) < -2.3 else towards(agent, (-2.6, -2.6), 0.5)
        )
    ),
    "code-1": lambda: move(0.4, -0.3),
    "think-8": lambda: after_free_runner,
    "compete-4": lambda: after_free_runner,
}
"""Policies that earn the stars of missions in which the scene's solver does not."""


def earn_stars(do: Doing) -> None:
    """Do a mission, and drive on until all of its stars are earned."""
    SOLUTIONS[do.name](do)
    do.new_start()
    do.drive_for_stars(STAR_POLICIES[do.name]() if do.name in STAR_POLICIES else solved(do))
