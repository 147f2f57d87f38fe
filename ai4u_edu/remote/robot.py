"""A robot in a world elsewhere, driven by a script that waits."""

from collections.abc import Iterator, Sequence
from typing import Any, Self, SupportsIndex

from ai4u_edu.remote.address import address_of
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.own_frames import OWN_FRAMES_HIDDEN
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot_base import RobotBase
from ai4u_edu.remote.sync_connection import SyncConnection
from ai4u_edu.wire.native import Mode, OnMissing

_robots: dict[tuple[str, str], "Robot"] = {}
"""The robots of this process, by the world's address and the agent that was asked for."""


class Robot(RobotBase):
    """An agent of a running world, driven from this script; made by :func:`connect`.

    Each decision is a percept and the action that answers it::

        with connect("http://teacher:8080", agent="red") as robot:
            for percept in robot:
                robot.act(move=[1, -percept["bearing"][0], 0, 0])
            print(robot.percept.reward_terms)
            robot.reset()

    It reconnects if the connection is lost, and goes on where it was. If the world was restarted
    meanwhile, the episode is over (truncated), and :meth:`reset` begins another.
    """

    def __init__(self, connection: SyncConnection, dialogue: Dialogue) -> None:
        super().__init__(dialogue)
        self._connection = connection
        connection.run(dialogue.begin())

    def sense(self) -> RemotePercept:
        """Return the current percept; after an action, wait until its decision is over."""
        with OWN_FRAMES_HIDDEN:
            return self._connection.run(self._dialogue.sense())

    def act(self, action: Any = None, /, **numbers: Any) -> None:
        """Answer the latest percept with an action. Returns at once; :meth:`sense` waits.

        Args:
            action: numbers by the actuator's name; of a robot with one actuator, its numbers alone.
            numbers: the same, as in ``act(move=[1, 0, 0, 0])``. Actuators left out do nothing.

        Raises:
            ActionError: it names an unknown actuator, its numbers don't fit, or the episode is
                over.
        """
        with OWN_FRAMES_HIDDEN:
            self._connection.run(self._dialogue.act(numbers if action is None else action))

    def tell(self, **fields: Any) -> None:
        """Tell the agent something besides actions, such as a target: ``tell(target=[1, 2])``.

        It goes with the next action or reset, and stays until it is told otherwise. An
        AgentArraySensor of the field's name reads its numbers, and blocks find it in
        ``agent.fields``. A field that no sensor reads is reported on the page, where the world
        runs, and in the script's log ``ai4u_edu.remote``.

        Args:
            fields: numbers or text by name; None takes one back.

        Raises:
            RemoteError: a field is neither numbers nor text, or they are too many or too long.
        """
        with OWN_FRAMES_HIDDEN:
            self._connection.run(self._dialogue.tell(fields))

    def reset(self, seed: SupportsIndex | None = None) -> RemotePercept:
        """Begin an episode, and return its first percept.

        Args:
            seed: fixes all random numbers of the episode, and resets the whole world; a whole
                number from 0 to 2**63 - 1. Left out, the episode begins for this robot alone if
                there are others.

        Raises:
            RemoteError: the seed is out of range.
            RefusedError: there is a seed, there are other agents, and the world does not allow
                scripts to reset it.
        """
        with OWN_FRAMES_HIDDEN:
            return self._connection.run(self._dialogue.reset(seed))

    def close(self) -> None:
        """Give the agent back to the brain that it had before. It may be called twice."""
        self._connection.run(self._dialogue.end())
        # several threads may close robots of theirs at once
        for place in [place for place, robot in list(_robots.items()) if robot is self]:
            _robots.pop(place, None)

    def __iter__(self) -> Iterator[RemotePercept]:
        """Yield every percept that needs an action, until the episode is over."""
        with OWN_FRAMES_HIDDEN:
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
    """Connect to a running world, and drive one of its agents.

    If this process drives the same agent already, that robot is closed first, so that a cell of a
    notebook can be run again.

    Args:
        url: the page's address, such as ``"http://teacher:8080"``; a token in it counts.
        agent: the agent's id; may be left out where there is only one.
        token: the world's, if it has one.
        mode: ``"realtime"``: the world never waits, and an action counts as soon as it arrives.
            ``"lockstep"``: the world waits for each action, as training needs it. In a world with
            several agents that other machines can reach, its owner has to allow that (``ai4u-edu
            play --lockstep``). If a script is silent for longer than the world's
            ``--receive-timeout``, the world goes on until the script answers.
        keys: keys of the readings to get, such as ``["ray_casting"]``; default: all.
        session: :attr:`Robot.session` of a script that is gone, to resume its session.
        patience: seconds to wait for a world that is not there, at first or again after it was
            restarted, and for an agent that another script has. The script says that it waits: in
            the log ``ai4u_edu.remote``, by default on stderr. 0 for one attempt.
        on_missing: substitute for an action that is missing when a decision is due, also while the
            connection is lost: ``"hold"``: the last action; ``"coast"``: nothing; ``"stop"``: zeros
            for all actuators. Left out, the world's setting (``ai4u-edu play --on-missing``): by
            default hold, and stop while the connection is lost.

    Raises:
        RefusedError: the world does not give the agent to this script; the text says why.
        LostError: no world answers.
        RemoteError: an argument is wrong.
    """
    with OWN_FRAMES_HIDDEN:
        address = address_of(url, token)
        before = _robots.pop((address.url, agent), None)
        if before is not None:
            before.close()
        dialogue = Dialogue(
            agent,
            token=address.token,
            mode=mode,
            keys=keys,
            session=session,
            patience=patience,
            on_missing=on_missing,
        )
        robot = _robots[address.url, agent] = Robot(SyncConnection(address), dialogue)
        return robot
