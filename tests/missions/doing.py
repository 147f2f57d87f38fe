"""A person who does a mission, in the mission's own world and without a page."""

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import (
    CarActuator,
    DifferentialDriveActuator,
    ForceMoveActuator,
    GridMoveActuator,
    LocalBrain,
    Percept,
)
from ai4u_edu.lessons.built import judge_built
from ai4u_edu.lessons.calls import Judged, RemoteCalls, function_name
from ai4u_edu.missions.events import Driver, SeenPage, Verdict, decision_of
from ai4u_edu.missions.mission import library_missions
from ai4u_edu.missions.run import MissionRun
from ai4u_edu.page.editing.scene_pictures import load_by_name
from ai4u_edu.program import ProgramError, host
from ai4u_edu.scenes import Scene

Action = Mapping[str, Any]
Policy = Callable[[BasicAgent], Action]

MAX_OTHER_DECISIONS = 150
"""Decisions of another driver than asked at one go: none of them counts, however many they are."""


class Doing:
    """Drives the first robot of a mission's scene, and goes on to the next step when one is done.

    Args:
        name: of the mission.
        seed: of the first episode.
        driver: drives in place of whom each step asks for; empty for that one.
    """

    def __init__(self, name: str, seed: int = 1, *, driver: Driver | None = None) -> None:
        self.name = name
        self.run = MissionRun(library_missions().get(name))
        self.decisions = 0
        self._driver = driver
        self._seeds = np.random.default_rng(seed)
        self._policy: Policy = lambda _: {}
        self._enter(scene_of(self.run.mission.scene), seed)

    def _enter(self, scene: Scene, seed: int) -> None:
        self.scene = scene.description
        self.sim = scene.build()
        self.agent = self.sim.agents[0]
        brain = self.agent.brain
        self.agent.use_brain(
            LocalBrain(
                controller=self._decide,
                skip_frame=brain.skip_frame,
                repeat_action=brain.repeat_action,
            )
        )
        self.agent.percept_ready.connect(self._on_percept)
        self.sim.reset(seed)
        self.run.see_scene(self.scene)

    def change(self, **fields: object) -> None:
        """Change fields of the scene, as the person does in Build and World."""
        self._enter(Scene(self.scene.model_copy(update=fields)), self.sim.world.seeds.seed)
        self.go_on()

    @property
    def is_done(self) -> bool:
        return self.run.is_done

    def open(self, tab: str, way: str = "") -> None:
        self.run.see(SeenPage(tab, way))
        self.go_on()

    def answer(self, text: str) -> None:
        self.run.see_answer(text)
        self.go_on()

    def solve(self, source: str) -> None:
        """Have the page's Python call the function in a text, until the judge has seen enough."""
        calls = RemoteCalls(self.run.mission.exercise, source)
        name = function_name(calls.exercise.id)
        self._host("load", source=source, has_entry=False)
        while calls.arguments:
            calls.answer(self._host("call", name=name, arguments=calls.arguments)["value"])
        self._see(calls.judged)

    def check(self) -> None:
        """Let the exercise's judge look at the robot that is built."""
        scene = Scene(self.scene)
        self._see(judge_built(self.run.mission.exercise, lambda: scene.build().agents[0]))

    def _see(self, judged: Judged) -> None:
        self.run.see(Verdict(judged.passed, judged.text))
        self.go_on()

    def _host(self, method: str, **said: object) -> dict[str, Any]:
        answer: dict[str, Any] = json.loads(getattr(host, method)(json.dumps(said)))
        if not answer["ok"]:
            raise ProgramError(answer["text"])
        return answer

    def new_start(self, seed: int | None = None) -> None:
        self.sim.reset(int(self._seeds.integers(1, 2**31)) if seed is None else seed)
        self.go_on()

    def again(self) -> None:
        self.sim.reset(self.sim.world.seeds.seed)
        self.go_on()

    def drive(self, policy: Policy, limit: int = 1500, *, through: bool = False) -> bool:
        """Drive until the step is done; after an episode's end, another one begins.

        Args:
            policy: returns an action.
            limit: most decisions.
            through: True drives on over steps, to the end of the mission.
        """
        index, self._policy = self.run.index, policy
        for _ in range(limit if self._driver is None else min(limit, MAX_OTHER_DECISIONS)):
            if self.is_done or (self.run.index != index and not through):
                break
            if self.agent.done:
                self.new_start()
            else:
                self.sim.step()
                self.decisions += 1
                self.go_on()
        return self.run.index != index or self.is_done

    def drive_for_stars(self, policy: Policy, limit: int = 9000) -> None:
        """Drive until all stars are earned; after an episode's end, another one begins."""
        self._policy = policy
        for _ in range(limit):
            if all(self.run.stars):
                return
            if self.agent.done:
                self.new_start()
            else:
                self.sim.step()

    def go_on(self) -> None:
        """Press Next if the step is done."""
        if self.run.is_step_done and not self.is_done:
            self.run.begin(self.run.index + 1)

    def _decide(self, percept: Percept) -> Action:
        action = dict(self._policy(self.agent))
        if isinstance(action.get("move"), list) and len(action["move"]) == 4:
            forward, turn, *_ = move = action.pop("move")
            wheels = [each for each in self.agent.actuators if each.action_name == "wheels"]
            action["wheels" if wheels else "move"] = self._moved(forward, turn, move)
        return action

    def _moved(self, forward: float, turn: float, move: list[float]) -> Any:
        """Return the robot's own way to move forward and turn."""
        for actuator in self.agent.actuators:
            if isinstance(actuator, DifferentialDriveActuator):
                return [max(-1.0, min(1.0, forward + each)) for each in (turn, -turn)]
            if isinstance(actuator, CarActuator | ForceMoveActuator):
                return [forward, turn]
            if isinstance(actuator, GridMoveActuator):
                return 1 if forward > 0 else 2 if forward < 0 else 0 if not turn else 3 + (turn > 0)
        return move

    def _on_percept(self, agent: BasicAgent) -> None:
        asked = self.run.step.by
        network = f"{self.run.index}" if "network" in asked else ""
        driver: Driver
        driver = "keys" if asked == "anyone" else "network" if asked == "new network" else asked
        driver = self._driver or driver
        self.run.see(replace(decision_of(self.sim, agent), driver=driver, network=network))


def scene_of(name: str) -> Scene:
    scene = load_by_name(name)
    assert scene is not None
    return scene
