"""A solution of each mission: by sight with keys, by the percept as a program."""

import math
from collections.abc import Callable, Mapping

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import LinearRayCastingSensor
from ai4u_edu.missions.checks import decision_of
from ai4u_edu.world import BodyDescription
from tests.missions.doing import Action, Doing, Policy

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
    codes = np.asarray(agent.percept["vision"]).reshape(-1, 2)[:, 0]
    angles = -np.linspace(-1, 1, len(codes)) * 150 / 2
    (sensor,) = (each for each in agent.sensors if isinstance(each, LinearRayCastingSensor))
    largest = sensor.largest_code if sensor.normalized else 1.0
    target = sensor.group_code["target"] / largest
    hits = np.isclose(codes, target, atol=1e-3)
    if not hits.any():
        return follow_wall(agent)
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
    do.open("code")
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


SOLUTIONS: dict[str, Solution] = {
    "drive-1": drive_1,
    "drive-2": drive_2,
    "drive-3": drive_3,
    "sense-1": sense_1,
    "sense-2": sense_2,
    "sense-3": sense_3,
    "think-1": think_1,
    "think-2": think_2,
    "think-3": think_3,
    "think-4": think_4,
    "code-1": code_1,
    "code-2": code_2,
    "code-3": code_3,
    "build-1": build_1,
    "teach-1": teach_1,
}
