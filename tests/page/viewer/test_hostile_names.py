"""Names in scene files can't inject HTML or scripts into the page."""

from typing import Any

from gymnasium.spaces import Box

from ai4u_edu import (
    Actuator,
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RayCastingSensor,
    RewardFunc,
    Sensor,
    World,
)
from ai4u_edu.page.panel.parts.agent import script_lines
from tests.builders import still

EVIL = "</td><img src=x onerror=alert(1)>{alert(2)}\n```\n<script>alert(3)</script>"


class Odd(Sensor):
    """Reads text that would be a script."""

    def space(self) -> Any:
        from gymnasium.spaces import Text

        return Text(200)

    def read(self, body: Any, view: Any) -> str:
        return EVIL


class Push(Actuator):
    """Does nothing."""

    def space(self) -> Box:
        return Box(-1.0, 1.0, (2,))

    def act(self, body: Any, action: tuple[float, ...]) -> None:
        pass


class Pay(RewardFunc):
    """Pays one."""

    def on_update(self, body: Any, view: Any) -> float:
        return 1.0


class Evil(LocalBrain):
    """Is called what would be a script."""

    def title(self) -> str:
        return EVIL


def evil_sim(action_name: str = EVIL) -> ControlRequestor:
    world = World()
    world.add_area("goal", BoxShape(size=(1, 1)), position=(5, 5), label=EVIL[5:33])
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", BoxShape(size=(1, 1)), position=(3, 0), tags=("target",))
    agent = BasicAgent(
        body="robot",
        sensors=[
            Odd(perception_key=EVIL),
            RayCastingSensor(perception_key="eyes", group_code={"target": 2}),
        ],
        actuators=[Push(action_name=action_name)],
        rewards=[Pay(name=EVIL)],
        brains=[Evil(controller=still)],
    )
    return ControlRequestor(world, [agent], goal=EVIL, success=EVIL)


def test_a_name_ends_neither_the_line_nor_the_code() -> None:
    names = (EVIL, "x=[1])\nimport os#", "a b", "class", "'''", "\u2028", "move); quit(")
    for name in names:
        agent = evil_sim(name).agents[0]
        text = script_lines("http://teacher:8080/?token=a%20b", agent)
        compile(text, "lines", "exec")
        assert text.splitlines()[5] == f"    robot.act({{{name!r}: [1, 0]}})"
        assert len(text.splitlines()) == 7
