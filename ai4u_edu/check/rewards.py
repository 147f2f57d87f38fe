"""Whether a reward function keeps its promises."""

from ai4u_edu.blocks import RewardFunc
from ai4u_edu.check.block_check import DECISIONS, Exam, Options
from ai4u_edu.check.ineffective import warn_of_groups, warn_of_no_end
from ai4u_edu.check.report import Report
from ai4u_edu.check.rollout import Script, Trial, fresh, title_of
from ai4u_edu.check.static_checks import check_papers
from ai4u_edu.scenes import Scene


def check_reward(
    reward: RewardFunc,
    *,
    scene: Scene | str | None = None,
    script: Script | None = None,
    seed: int = 0,
    decisions: int = DECISIONS,
) -> Report:
    """Lets a reward function pay a random driver in a small world, and tells what is wrong with it.

    It has to be documented; come back from a scene file as it was; pay finite numbers; pay the same
    from the same seed; forget everything at a reset; move nothing; leave the global generators
    alone. One that always pays the same gets a warning, and so does one that is to end the episode
    and never can, and one that looks for groups that are not there.

    Args:
        reward: stays as it is; copies of it are driven.
        scene: where, a Scene or the name of one; left out: a small world with bodies "robot" (the
            agent's), "box", "ball", "other", "wall" and "step" and an area "goal".
        script: what a script does besides, called before each decision with the agent and the
            decision's number.
        seed: of the drive and the world.
        decisions: how long each run is.

    >>> from ai4u_edu import FallReward
    >>> check_reward(FallReward()).ok
    True
    """
    name = reward.name
    options = Options(scene, script, seed, decisions)
    the_scene = options.the_scene()
    report = Report(title_of(reward))
    exam = Exam(
        report,
        lambda: Trial(the_scene, fresh(reward), script=script),
        options,
        of=lambda record: next(iter(record.terms.values())).get(name),
        words="rewards",
    )
    check_papers(report, reward, "what it pays for")
    warn_of_no_end(report, [("", reward)])
    if exam.run():
        warn_of_groups(report, [("", reward)], exam.view)
        exam.only_looks(Trial(the_scene, without=reward, script=script))
        exam.changes(warning=True)
    return report
