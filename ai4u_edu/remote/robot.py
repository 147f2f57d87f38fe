"""A robot that is somewhere else."""

from collections.abc import Iterator, Sequence
from typing import Any, Self, SupportsIndex

from ai4u_edu.remote.address import address_of
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot_base import RobotBase
from ai4u_edu.remote.sync_connection import SyncConnection
from ai4u_edu.wire.native import Mode, OnMissing

_robots: dict[tuple[str, str], "Robot"] = {}
"""Those of this process, by the world's address and the agent that was asked for."""


class Robot(RobotBase):
    """An agent of a running world, driven from here. :func:`connect` gives one.

    Each decision is a percept and the action that answers it::

        with connect("http://teacher:8080", agent="red") as robot:
            for percept in robot:
                robot.act(move=[1, -percept["bearing"][0], 0, 0])
            print(robot.percept.reward_terms)
            robot.reset()

    If the connection is lost, it is taken up again; the session goes on where it was.
    """

    def __init__(self, connection: SyncConnection, dialogue: Dialogue) -> None:
        super().__init__(dialogue)
        self._connection = connection
        connection.run(dialogue.begin())

    def sense(self) -> RemotePercept:
        """What the robot senses now; after an action, as soon as its decision is over."""
        return self._connection.run(self._dialogue.sense())

    def act(self, action: Any = None, /, **numbers: Any) -> None:
        """Decides: answers the latest percept. Returns at once; :meth:`sense` waits.

        Args:
            action: numbers by the actuator's name; of a robot with one actuator, its numbers alone.
            numbers: the same, as in ``act(move=[1, 0, 0, 0])``. What is left out does nothing.

        Raises:
            ActionError: it names an actuator that there is not, its numbers don't fit, or the
                episode is over.
        """
        self._connection.run(self._dialogue.act(numbers if action is None else action))

    def reset(self, seed: SupportsIndex | None = None) -> RemotePercept:
        """Begins an episode; what the robot senses first.

        Args:
            seed: fixes everything in it, and begins one for the whole world; a whole number from
                0 to 2**63 - 1. Left out, it begins for this robot alone if there are others.

        Raises:
            RemoteError: the seed is none.
            RefusedError: there is a seed and there are others, and the world is not to be reset
                from here.
        """
        return self._connection.run(self._dialogue.reset(seed))

    def close(self) -> None:
        """Leaves the robot to the brain that it had before. Closing twice is fine."""
        self._connection.run(self._dialogue.end())
        for place in [place for place, robot in _robots.items() if robot is self]:
            del _robots[place]

    def __iter__(self) -> Iterator[RemotePercept]:
        """Every percept that needs an action, until the episode is over."""
        while not (percept := self.sense()).done:
            yield percept
            self._dialogue.expect_answer_to(percept)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def connect(
    url: str,
    agent: str = "",
    *,
    token: str = "",
    mode: Mode = "realtime",
    keys: Sequence[str] = (),
    session: str = "",
    patience: float = 10.0,
    on_missing: OnMissing = "",
) -> Robot:
    """Drives an agent of a running world.

    A robot that this process has already at the same agent is closed first, so that a notebook's
    cell can be run again.

    Args:
        url: the page's address, such as ``"http://teacher:8080"``; a token in it counts.
        agent: the agent's id; may be left out where there is only one.
        token: the world's, where it asks for one.
        mode: ``"realtime"``: the world never waits, and an action counts as soon as it is there.
            ``"lockstep"``: the world waits for each action, as training wants it. In a world with
            several agents that has to be allowed by whoever runs it (``ai4u-edu play --lockstep``).
            A script that is silent for longer than the world's ``--receive-timeout`` is given up
            until it answers: the world goes on.
        keys: the readings that are wanted, such as ``["ray_casting"]``; left out, all.
        session: :attr:`Robot.session` of a script that is gone, to go on in its place.
        patience: seconds until the world has to have answered.
        on_missing: what the agent does when a decision is due and no action is there, also while
            the connection is lost: ``"hold"``: the last action again; ``"coast"``: nothing;
            ``"stop"``: zeros for all actuators. Left out, as the world has it (``ai4u-edu play
            --on-missing``), which is to hold, and to stop while the connection is lost.

    Raises:
        RefusedError: the world doesn't give the agent away; the text says why.
        LostError: no world answers.
        RemoteError: an argument is wrong.
    """
    address = address_of(url)
    before = _robots.pop((address.url, agent), None)
    if before is not None:
        before.close()
    dialogue = Dialogue(
        agent,
        token=token or address.token,
        mode=mode,
        keys=keys,
        session=session,
        patience=patience,
        on_missing=on_missing,
    )
    robot = _robots[address.url, agent] = Robot(SyncConnection(address), dialogue)
    return robot
