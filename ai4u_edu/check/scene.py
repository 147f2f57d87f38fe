"""The check of a scene."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent, ControlRequestor
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Block, RespawnActuator, RewardFunc
from ai4u_edu.check.block_check import (
    DEFAULT_DECISIONS,
    BlockCheck,
    Options,
    frozen,
    short,
    warn_of_groups,
    warn_of_no_end,
)
from ai4u_edu.check.report import Outcome, Report
from ai4u_edu.check.rollout import Rollout, RolloutStep, Script, title_of
from ai4u_edu.check.sensors import not_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.scenes import Scene

TEXTS = ("title", "goal", "controls", "rewards")


def check_scene(
    scene: Scene | str,
    *,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Drive all agents of a scene at random, and report what is wrong with the scene.

    The scene must survive being written to a file and read back; give finite readings inside the
    sensors' spaces; run the same for the same seed, also after a reset; and leave the global random
    generators alone. Warnings: no description, an agent without a sensor or without an actuator, a
    sensor that always reads the same, a reward that is never paid, an agent that cannot move, a
    position over the void or inside another body, a group that no body carries, and a reward that
    is meant to end the episode and cannot. ``ai4u-edu check FILE`` gives the same report.

    Args:
        scene: a Scene, or the name of one.
        script: called before each decision with the first agent and the decision's number.
        seed: for the random actions and the world.
        decisions: length of each run.

    >>> check_scene("box_chase", decisions=20).ok
    True
    """
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    report = Report(the_scene.description.name)
    missing = [text for text in TEXTS if not getattr(the_scene.description, text)]
    report.add(
        _("documented"),
        _(
            "expected a title, a goal, controls and rewards in words, got no {names}",
            names=", no ".join(missing),
        )
        if missing
        else "",
        outcome=Outcome.WARNING if missing else None,
    )
    report.add(_("scene file"), _lost(the_scene))
    rollouts: list[Rollout] = []

    def make() -> Rollout:
        rollouts.append(Rollout(the_scene, script=script))
        return rollouts[-1]

    checks = BlockCheck(report, make, options, of=_all_of, words=_("world"))
    if checks.run():
        _look_at_agents(report, rollouts[0].sim.agents)
        _warn(report, rollouts[0].sim.agents)
        _look_at_sensors(report, rollouts[0], checks.records)
        _look_at_rewards(report, rollouts[0], checks.records)
        odd = _implausible_places(the_scene.build(), seed)
        report.add(
            _("places"),
            _(
                "expected agents that can move and stand where they are put, got: {names}",
                names=join(odd, "; "),
            )
            if odd
            else "",
            outcome=Outcome.WARNING if odd else None,
        )
    return report


def _lost(scene: Scene) -> str:
    try:
        again = Scene.loads(scene.dumps())
    except AI4UError as error:
        return _("expected the same scene back from its file, got {error}", error=text_of(error))
    if again == scene:
        return ""
    return _("expected the same scene back from its file, got another one")


def _all_of(record: RolloutStep) -> Any:
    percepts = [(percept.data, percept.texts) for percept in record.percepts.values()]
    return record.poses, percepts, record.terms


def _look_at_agents(report: Report, agents: Sequence[BasicAgent]) -> None:
    """Warn of agents without a sensor or an actuator of their own."""
    bare: list[str] = []
    for agent in agents:
        bound = agent.bound_blocks
        if not any(sensor in bound.sensors for sensor in agent.sensors):
            bare.append(
                _(
                    "agent {id!r} has no sensor, so its brain knows nothing of the world; give it "
                    "one, as in sensors: [{{type: OrientationSensor, target: NAME}}]",
                    id=agent.id,
                )
            )
        if not any(actuator.is_output for actuator in bound.actuators.values()):
            bare.append(
                _(
                    "agent {id!r} has no actuator, so nothing that its brain decides has an "
                    "effect; give it one, as in actuators: [{{type: RBMoveActuator}}]",
                    id=agent.id,
                )
            )
    report.add(
        _("senses and acts"),
        join(bare, "; ") if bare else "",
        outcome=Outcome.WARNING if bare else None,
    )


def _warn(report: Report, agents: Sequence[BasicAgent]) -> None:
    blocks: list[tuple[str, Block]] = []
    rewards: list[tuple[str, RewardFunc]] = []
    for agent in agents:
        bound = agent.bound_blocks  # what is switched off sits on no body
        for block in (*bound.sensors, *bound.actuators.values(), *bound.rewards):
            words = _("agent {id!r}, {block}: ", id=agent.id, block=title_of(block))
            blocks.append((words, block))
            if isinstance(block, RewardFunc):
                rewards.append((words, block))
    warn_of_groups(report, blocks, agents[0].view)
    warn_of_no_end(report, rewards)


def _look_at_sensors(report: Report, rollout: Rollout, records: list[RolloutStep]) -> None:
    wrong: list[str] = []
    still: list[str] = []
    for agent in rollout.sim.agents:
        for sensor in agent.bound_blocks.sensors:
            key, space = sensor.perception_key, sensor.observation_space()
            values = [record.percepts[agent.id][key] for record in records]
            for value in values:
                finite = isinstance(value, str | tuple) or np.isfinite(value).all()
                expected = not_in(space, value) if finite else _("finite numbers")
                if expected:
                    wrong.append(
                        _(
                            "agent {id!r}, {key!r}: {expected}, got {got}",
                            id=agent.id,
                            key=key,
                            expected=expected,
                            got=short(value),
                        )
                    )
                    break
            if sensor.is_input and all(frozen(each) == frozen(values[0]) for each in values):
                still.append(_("{name!r} of agent {id!r}", name=key, id=agent.id))
    report.add(
        _("in its space"),
        _("expected readings as the sensors' spaces say: {names}", names=join(wrong, "; "))
        if wrong
        else "",
    )
    report.add(
        _("changes"),
        _(
            "expected readings that change, got always the same from {names}",
            names=join(still, ", "),
        )
        if still
        else "",
        outcome=Outcome.WARNING if still else None,
    )


def _look_at_rewards(report: Report, rollout: Rollout, records: list[RolloutStep]) -> None:
    never: list[str] = [
        _("{name!r} of agent {id!r}", name=reward.name, id=agent.id)
        for agent in rollout.sim.agents
        for reward in agent.bound_blocks.rewards
        if not any(record.terms[agent.id].get(reward.name) for record in records)
    ]
    report.add(
        _("pays"),
        _(
            "expected every reward to be paid at some time, got nothing from {names}; a random "
            "drive may just not have got there",
            names=join(never, ", "),
        )
        if never
        else "",
        outcome=Outcome.WARNING if never else None,
    )


def _implausible_places(sim: ControlRequestor, seed: int) -> list[str]:
    """Return a sentence for each position that is probably a mistake.

    These are: an agent with actuators on a body that can't move; a body that starts over the void;
    a respawn pose over the void or inside another body.

    Args:
        sim: will be reset, and its bodies moved.
        seed: for the reset.
    """
    sim.reset(seed)
    return [*_immovable(sim), *_over_the_void(sim), *_respawn_poses(sim)]


def _immovable(sim: ControlRequestor) -> Iterator[str]:
    for agent in sim.agents:
        driven = [name for name, each in agent.bound_blocks.actuators.items() if each.is_output]
        if driven and not agent.body.moves:
            yield _(
                "agent {id!r} is on body {body!r}, which can't move (its kind is {kind!r}), and "
                "has the actuator {name!r}",
                id=agent.id,
                body=agent.body_name,
                kind=agent.body.description.kind,
                name=driven[0],
            )


def _over_the_void(sim: ControlRequestor) -> Iterator[str]:
    for body in sim.world.bodies.values():
        if body.moves and not body.fallen and sim.world.ground(*body.position) is None:
            x, y = body.position
            yield _(
                "body {name!r} begins over the void, at ({x:g}, {y:g}), and falls",
                name=body.name,
                x=x,
                y=y,
            )


def _respawn_poses(sim: ControlRequestor) -> Iterator[str]:
    for agent in sim.agents:
        for actuator in agent.bound_blocks.actuators.values():
            if isinstance(actuator, RespawnActuator):
                yield from _poses_of(sim, agent, actuator)


def _poses_of(sim: ControlRequestor, agent: BasicAgent, actuator: RespawnActuator) -> Iterator[str]:
    body = agent.body
    for number, (x, y, heading_deg) in enumerate(actuator.poses):
        pose = _(
            "pose {number} of {name!r} of agent {id!r}, ({x:g}, {y:g}),",
            number=number,
            name=actuator.action_name,
            id=agent.id,
            x=x,
            y=y,
        )
        if sim.world.ground(x, y) is None:
            yield _("{pose} lies over the void", pose=pose)
            continue
        body.move_to(x, y, heading=math.radians(heading_deg))
        other = sim.world.find_overlap(body)
        if other is not None:
            yield _("{pose} lies in body {name!r}", pose=pose, name=other.name)
