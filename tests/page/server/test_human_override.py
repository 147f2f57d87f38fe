"""Taking an agent over from a network or a script, and giving it back."""

import contextlib
import math
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from ai4u_edu import (
    Actuator,
    ArrowController,
    CarActuator,
    CBMoveActuator,
    ContinuousActuator,
    DifferentialDriveActuator,
    DiscreteActuator,
    ForceMoveActuator,
    LocalBrain,
    NeuralNetController,
    RBMoveActuator,
    RemoteBrain,
    ReplayController,
    Scene,
    WASDRBMoveController,
)
from ai4u_edu.blocks import trained_brain
from ai4u_edu.page.server.bindings import has_stick
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.page.server.input_messages import usable_keys
from ai4u_edu.remote import LostError, RemoteError
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.agent_words import driver_title
from tests.builders import small_sim, still
from tests.page.server.rooms import Room, free_port, served
from tests.remote.rooms import connect, patient_rules
from tests.waiting import LIMIT_S, until


def spin(_percept: Any) -> dict[str, Any]:
    return {"move": [0, 0.5, 0, 0]}


@pytest.fixture
def room() -> Iterator[Room]:
    with served(small_sim(controller=spin)) as room:
        yield room


def brain_of(room: Room) -> str:
    return room.sim.agents[0].brain.title()


def test_a_key_takes_over_and_letting_go_gives_back(room: Room) -> None:
    agent = room.sim.agents[0]
    script = agent.brain
    with room.page() as page:
        hello = page.receive("hello")
        assert (hello["others"], hello["instead"]) == ("A script", "")
        assert hello["keys"]["forward"] == ["KeyW", "ArrowUp"]
        page.hold("KeyW")
        page.receive("hello", others="", instead="A script")
        until(lambda: room.move[:1] == (1,))
        assert brain_of(room) == "LocalBrain(WASDRBMoveController)"
        page.hold()
        page.send("let_go")
        page.receive("hello", others="A script", instead="")
        assert agent.brain is script
        until(lambda: agent.brains == [script])  # what was made for this is gone again
        until(lambda: room.move[1:2] == (0.5,))


def test_a_page_that_is_gone_gives_back(room: Room) -> None:
    with room.page() as page:
        page.hold("KeyW")
        page.receive("hello", others="")
    until(lambda: brain_of(room) == "LocalBrain(ScriptController)")


def test_a_page_that_lets_go_and_leaves_at_once_gives_back(room: Room) -> None:
    may_go = threading.Event()
    with room.page() as page:
        page.hold("KeyW")
        page.receive("hello", others="")
        room.runner.submit(lambda: may_go.wait(LIMIT_S))
        for _ in range(50):  # one of them is carried out, they are not heaped up
            page.send("let_go")
            page.send("take")
        page.send("let_go")
        page.settle()
        waiting = len(room.runner._queue)
    may_go.set()
    until(lambda: brain_of(room) == "LocalBrain(ScriptController)")
    assert waiting < 5


def test_it_stays_taken_over_while_another_page_takes_control(room: Room) -> None:
    with room.page() as first, room.page() as second:
        first.hold("KeyW")
        second.receive("hello", others="")
        second.send("take")
        second.hold("KeyS")
        until(lambda: room.held == ["KeyS"])
        first.send("let_go")
        first.settle()
        room.runner.submit(lambda: None).result(LIMIT_S)
        assert brain_of(room) == "LocalBrain(WASDRBMoveController)"
        second.send("let_go")
        second.receive("hello", others="A script")


def test_a_click_and_a_stick_take_over_as_well(room: Room) -> None:
    with room.page() as page:
        page.send("take")
        page.receive("hello", others="")
        page.send("let_go")
        page.receive("hello", others="A script")
        page.send("keys", held=[], stick={"forward": 0.5, "turn": -0.25})
        until(lambda: room.move[:2] == (0.5, -0.25))
        page.receive("hello", others="")


def test_restart_and_unbound_keys_do_not_take_over(room: Room) -> None:
    with room.page() as page, room.page() as other:
        page.hold("KeyR", "KeyX")
        page.settle()
        room.runner.submit(lambda: None).result(LIMIT_S)
        assert brain_of(room) == "LocalBrain(ScriptController)"
        other.hold("KeyW")  # it would be ignored if the lock were not free
        other.receive("seat", driver=2)


def test_take_over_enables_a_disabled_keyboard_brain() -> None:
    ready = LocalBrain(controller=ArrowController(speed=0.25), enabled=False)
    mine = LocalBrain(controller=spin)
    with served(small_sim(brains=[mine, ready])) as room, room.page() as page:
        agent = room.sim.agents[0]
        assert page.receive("hello")["keys"]["jump_forward"] == ["Enter"]
        page.hold("ArrowUp")
        until(lambda: agent.brain is ready)
        until(lambda: room.move[:1] == (0.25,))
        page.send("let_go")
        until(lambda: agent.brain is mine)
        assert agent.brains == [mine, ready]


def test_where_a_script_is_waited_for_a_person_may_drive() -> None:
    remote = RemoteBrain(port=free_port())
    ready = LocalBrain(controller=WASDRBMoveController(), enabled=False)
    with served(small_sim(brains=[remote, ready])) as room, room.page() as page:
        agent = room.sim.agents[0]
        hello = page.receive("hello")
        assert (hello["others"], hello["keys"]["forward"][0]) == ("A script elsewhere", "KeyW")
        page.hold("KeyW")
        page.receive("hello", others="", instead="A script elsewhere")
        until(lambda: room.move[:1] == (1,))
        assert agent.brain is remote
        page.send("let_go")
        page.receive("hello", others="A script elsewhere", instead="")
        assert agent.brains == [remote, ready]


@pytest.mark.parametrize("mode", ["realtime", "lockstep"])
def test_a_script_elsewhere_is_not_listened_to_while_a_person_drives(mode: Any) -> None:
    steps: list[int] = []
    with served(small_sim(controller=still), rules=patient_rules()) as room:
        agent = room.sim.agents[0]

        def drive() -> None:
            with contextlib.suppress(RemoteError, LostError):
                for percept in robot:
                    steps.append(percept.step)
                    robot.act(move=[-0.5, 0, 0, 0])

        def does(forward: float) -> bool:
            return room.move[:1] == (forward,)

        with connect(room.url, mode=mode) as robot, room.page() as page:
            script = threading.Thread(target=drive, daemon=True)
            script.start()
            until(lambda: does(-0.5))
            page.hold("KeyW")
            page.receive("hello", others="", instead="A script elsewhere")
            until(lambda: does(1))
            brain = agent.brain
            assert isinstance(brain, RemoteBrain)
            seen, ignored = len(steps), brain.status().ignored
            until(lambda: len(steps) > seen + 3)  # it goes on seeing
            until(lambda: brain.status().ignored > ignored + 2)
            assert does(1)
            assert "a person drives" in brain.status().reason
            page.hold()
            page.send("let_go")
            page.receive("hello", others="A script elsewhere", instead="")
            until(lambda: does(-0.5))
            assert agent.brain is brain
            until(lambda: brain.status().reason == "")
        script.join(LIMIT_S)
        assert not script.is_alive()
        assert steps == sorted(steps)
        until(lambda: brain_of(room) == "LocalBrain(ScriptController)")


def test_a_script_that_leaves_meanwhile_takes_nobody_along() -> None:
    sim = small_sim(controller=still)
    with (
        served(sim, rules=patient_rules()) as room,
        connect(room.url) as robot,
        room.page() as page,
    ):
        page.hold("KeyW")
        page.receive("hello", others="", instead="A script elsewhere")
        robot.close()
        until(lambda: brain_of(room) == "LocalBrain(ScriptController)")
        page.hold()  # a page says again and again what it holds
        page.send("let_go")
        page.receive("hello", others="A script", instead="")
        assert brain_of(room) == "LocalBrain(ScriptController)"


def test_letting_go_keeps_a_brain_that_was_set_meanwhile(room: Room) -> None:
    agent = room.sim.agents[0]
    third = LocalBrain(controller=still)
    with room.page() as page:
        page.hold("KeyW")
        page.receive("hello", others="")
        room.runner.submit(lambda: agent.use_brain(third)).result(LIMIT_S)
        page.receive("hello", others="A script", instead="")
        page.send("let_go")
        page.settle()
        room.runner.submit(lambda: None).result(LIMIT_S)
        assert agent.brain is third


@pytest.mark.parametrize("paused", [True, False])
def test_the_world_stays_as_it_is(room: Room, paused: bool) -> None:
    if paused:
        room.runner.pause().result(LIMIT_S)
    before = room.runner.latest
    with room.page() as page:
        page.send("take")
        page.receive("hello", others="")
        if not paused:
            until(lambda: room.runner.latest.tick > before.tick)
        after = room.runner.latest
        assert (after.episode, after.seed, after.paused) == (before.episode, before.seed, paused)
        assert not paused or after.tick == before.tick


@pytest.mark.parametrize(
    ("actuator", "actions"),
    [
        (RBMoveActuator(), {"forward", "backward", "left", "right", "jump", "jump_forward"}),
        (RBMoveActuator(jump_power=0), {"forward", "backward", "left", "right"}),
        (CBMoveActuator(), {"forward", "backward", "turn_left", "turn_right"}),
        (DifferentialDriveActuator(), {"forward", "backward", "turn_left", "turn_right"}),
        (CarActuator(), {"forward", "backward", "turn_left", "turn_right"}),
        (ForceMoveActuator(), {"forward", "backward", "turn_left", "turn_right"}),
        (DiscreteActuator(), {"right", "left", "up", "down"}),
        (DiscreteActuator(action_name="turn", table=[(0, 0, 0, 0), (0, 1, 0, 0)]), {"right"}),
        (ContinuousActuator(action_name="free"), set()),
    ],
)
def test_a_brain_is_made_that_fits_the_body(actuator: Actuator, actions: set[str]) -> None:
    sim = small_sim(actuators=[actuator])
    (agent,) = sim.agents
    override = HumanOverride(Runner(sim), agent)
    found = usable_keys(agent, override.brain)
    assert found.keys() - {"restart"} >= actions
    assert found.keys() - {"restart", "jump", "jump_forward"} == actions - {"jump", "jump_forward"}
    if actions:
        agent.use_brain(override.brain)
        codes = next(iter(found.values()))
        agent.keyboard.timeout_s = math.inf
        agent.keyboard.hold(codes[:1])
        sim.step()
        assert any(next(iter(agent.last_action.values())))


def test_a_stick_is_offered_where_somebody_listens_to_it() -> None:
    sims = [small_sim(actuators=[each]) for each in (CarActuator(), DiscreteActuator())]
    brains = [HumanOverride(Runner(sim), sim.agents[0]).brain for sim in sims]
    assert [has_stick(brain) for brain in brains] == [True, False]


def test_who_drives_is_said_in_words() -> None:
    network = trained_brain("zoo:box_chase")
    assert isinstance(network.controller, NeuralNetController)
    assert driver_title(network) == "A network"
    assert driver_title(LocalBrain(controller=ReplayController(actions=[{}]))) == "A recording"
    sim = Scene.load("sumo").build()
    assert driver_title(sim.agent("orange").brain) == "PushOutController"


def test_a_network_goes_on_after_it_was_taken_over() -> None:
    sim = Scene.load("box_chase_ai4u").build()
    (agent,) = sim.agents
    keys, network = agent.brain, trained_brain("zoo:box_chase")
    sim.reset(1)
    agent.use_brain(network)
    with served(sim) as room, room.page() as page:
        assert page.receive("hello")["others"] == "A network"
        page.hold("KeyS")
        until(lambda: agent.brain is keys)
        until(lambda: room.move[:2] == (-1, 0))
        page.send("let_go")
        until(lambda: agent.brain is network)
        until(lambda: room.move[:2] != (-1, 0))


# -- another world -------------------------------------------------------------------------------
