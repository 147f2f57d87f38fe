"""The check of a reward function."""

from ai4u_edu.blocks import RewardFunc
from ai4u_edu.check.block_check import (
    DEFAULT_DECISIONS,
    BlockCheck,
    Options,
    run_static_checks,
    warn_of_groups,
    warn_of_no_end,
)
from ai4u_edu.check.report import Report
from ai4u_edu.check.rollout import Rollout, Script, fresh, title_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


def check_reward(
    reward: RewardFunc,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DEFAULT_DECISIONS,
) -> Report:
    """Drive an agent at random in a small world, and report what is wrong with a reward function.

    The reward function must have a docstring; survive being written to a scene file and read back;
    pay finite numbers; pay the same for the same seed; keep nothing across a reset; move nothing;
    and leave the global random generators alone. It gives a warning if it always pays the same, if
    it is meant to end the episode and cannot, or if no body carries its group.

    Args:
        reward: is not changed; the check runs copies of it.
        scene: a Scene or the name of one. By default a small world with the bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and the area "goal".
        script: called before each decision with the agent and the decision's number.
        seed: for the random actions and the world.
        decisions: length of each run.

    >>> from ai4u_edu import FallReward
    >>> check_reward(FallReward()).ok
    True
    """
    name = reward.name
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    report = Report(title_of(reward))
    checks = BlockCheck(
        report,
        lambda: Rollout(the_scene, fresh(reward), script=script),
        options,
        of=lambda record: next(iter(record.terms.values())).get(name),
        words=_("rewards"),
    )
    run_static_checks(report, reward, _("what it pays for"))
    warn_of_no_end(report, [("", reward)])
    if checks.run():
        warn_of_groups(report, [("", reward)], checks.view)
        checks.only_looks(Rollout(the_scene, without=reward, script=script))
        checks.changes(warning=True)
    return report
