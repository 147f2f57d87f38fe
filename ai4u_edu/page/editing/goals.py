"""The goal of a scene that somebody builds: the reward that stands for it, and its sentence."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any, NamedTuple

from ai4u_edu.blocks import Block
from ai4u_edu.locale import Text, join
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.scene_pictures import EMPTY_SCENE, TEMPLATES
from ai4u_edu.page.editing.state import EditState, reward_names
from ai4u_edu.scenes import Scene, SceneDescription

GOAL_REWARD = 10.0
"""Amount that the goal pays unless somebody changes it."""


class GoalKind(NamedTuple):
    """A type of reward that can stand for reaching the goal."""

    values: Mapping[str, Any]
    """Parameters with which it pays at the goal only."""
    sentence: str
    """The goal in words, with names of parameters in braces."""


KINDS = {
    "TouchRewardFunc": GoalKind({"reward": GOAL_REWARD}, _("Reach {target}.")),
    "BodyInAreaRewardFunc": GoalKind({"reward": GOAL_REWARD}, _("Bring {thing} into {area}.")),
    "ParkedRewardFunc": GoalKind({"reward": GOAL_REWARD}, _("Park in {area}.")),
    "CheckpointsReward": GoalKind(
        {"reward": 0.0, "lap_reward": GOAL_REWARD}, _("Touch in this order: {targets}.")
    ),
    "GoneReward": GoalKind(
        {"reward": GOAL_REWARD, "only_last": True}, _("Make all of the group {group} disappear.")
    ),
    "TargetFallReward": GoalKind({"success_reward": GOAL_REWARD}, _("Make {target} fall.")),
}
"""Kinds of goals by the type of their reward."""


def with_goal_values(state: EditState, reward: Plain) -> Plain:
    """Return a new reward that pays something, and as the first one of its kind ends the episode.

    Args:
        state: has the scene.
        reward: as :func:`~ai4u_edu.page.editing.suggestion.suggest_block` returns it.
    """
    kind = KINDS.get(str(reward["type"]))
    if kind is None:
        return reward
    if state.description.success is None and _goal_reward(state.description) is None:
        return {**reward, **kind.values, "cause_episode_to_end": True}
    # a touch pays 0 by default, which nobody would notice
    return {**reward, "reward": 1.0} if reward["type"] == "TouchRewardFunc" else reward


def with_goal(before: EditState, after: EditState) -> EditState:
    """Return the state after a change with its goal: the term that stands for it, and its sentence.

    A reward that ends the episode and pays for it becomes the goal of a scene without one. A
    sentence that somebody wrote is kept.
    """
    old, new = before.description, after.description
    goal = _goal_reward(new)
    if goal and old.success is None and new.success is None and _goal_reward(old) is None:
        new = new.model_copy(update={"success": goal.name})
    was, is_now = goal_sentence(old), goal_sentence(new)
    if was != is_now and new.goal == old.goal and old.goal in {"", no_goal(), was}:
        new = new.model_copy(update={"goal": str(is_now or no_goal())})
    return after if new is after.description else replace(after, description=new)


def goal_sentence(scene: SceneDescription) -> str:
    """Return the goal of a scene in words; empty if none of its rewards stands for one."""
    goal = _goal_reward(scene)
    return "" if goal is None else Text(KINDS[str(goal.reward["type"])].sentence, goal.words)


@cache
def no_goal() -> str:
    """Return what an empty scene says in place of a goal."""
    return Scene.load(TEMPLATES / f"{EMPTY_SCENE}.yaml").description.goal


class _GoalReward(NamedTuple):
    name: str
    reward: Plain

    @property
    def words(self) -> dict[str, str]:
        return {name: _words(value) for name, value in self.reward.items()}


def _goal_reward(scene: SceneDescription) -> _GoalReward | None:
    """Return the reward that stands for a scene's goal; None if there is none of a known kind."""
    for agent in scene.agents:
        for name, reward in zip(reward_names(agent), agent.get("rewards", ()), strict=True):
            if reward["type"] not in KINDS:
                continue
            if name == scene.success or (scene.success is None and _ends_with_a_win(reward)):
                return _GoalReward(name, reward)
    return None


def _ends_with_a_win(reward: Plain) -> bool:
    if not reward.get("cause_episode_to_end"):
        return False
    parameters = Block.types[str(reward["type"])].parameters()
    amounts = [
        reward.get(name, parameters[name].default)
        for name in KINDS[str(reward["type"])].values
        if name != "only_last"
    ]
    return any(isinstance(amount, float | int) and amount > 0 for amount in amounts)


def _words(value: Any) -> str:
    """Return names in words.

    >>> _words("red_box"), _words("Bob"), _words(["1", "2"])
    ('the red box', 'Bob', '1, 2')
    """
    if isinstance(value, list | tuple):
        return join([_words(each) for each in value], ", ")
    text = str(value).replace("_", " ")
    return _("the {name}", name=text) if text.islower() else text
