"""Your own sensor, actuator, reward."""

import math
from typing import Any, TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.blocks import Actuator, Block, LocalBrain, RBMoveActuator, RewardFunc, Sensor
from ai4u_edu.check import Report, check_actuator, check_reward, check_sensor
from ai4u_edu.lessons.exercise import Done, NotYet, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import is_close
from ai4u_edu.lessons.rollouts import drive
from ai4u_edu.locale import gettext as _
from ai4u_edu.world import BoxShape, CircleShape, World

B = TypeVar("B", bound=Block)


def _made(cls: Any, kind: type[B], **parameters: Any) -> B:
    """Make one of a student's blocks."""
    if not isinstance(cls, type) or not issubclass(cls, kind):
        raise NotYet(
            _(
                "Expected a class that is a {name}: `class ...({name}):`. Got {got}.",
                name=kind.__name__,
                got=named(cls),
            ),
            hint="no-base",
        )
    return cls(**parameters)


def _always(name: str, *action: float) -> LocalBrain:
    """Return a brain that always gives the same action."""
    return LocalBrain(controller=lambda _: {name: list(action)})


def _examined(report: Report) -> None:
    """Raise NotYet with the checker's first finding."""
    if report.failed:
        raise NotYet(_("The examiner says: {failed}", failed=str(report.failed[0])))


def _world(box: tuple[float, float], heading_deg: float = 0.0, name: str = "box") -> World:
    world = World()
    world.add_floor("plate", BoxShape(size=(30, 30)))
    robot = CircleShape(radius=0.5)
    world.add_body("robot", robot, tags=("agent",), heading_deg=heading_deg)
    world.add_body(name, BoxShape(size=(1, 1)), position=box, tags=("target",))
    return world


@exercise(
    "19.1",
    _("Nearness"),
    hints={
        "begin": _(
            "Divide the distance by the reach: 0 at the target, 1 at the reach. One minus "
            "that is what is wanted."
        ),
        "reversed": _("Near and far are mixed up: at the target it has to be 1."),
        "beyond": _(
            "Beyond the reach your reading is below 0. `max(0.0, ...)` takes the larger one "
            "of two numbers."
        ),
        "target": _(
            "It looks for a body that is always called the same. Which body is meant says "
            "the parameter: `view[self.target]`."
        ),
        "reach": _("With another `reach` the reading is wrong. Use the parameter: `self.reach`."),
    },
)
def senses_nearness(cls: Any) -> Done:
    """Check for 1 at the target, 0 at the reach and beyond."""
    for reach, target in ((8.0, "box"), (5.0, "box"), (6.0, "lamp")):
        for away in (2.0, 4.0, 3.3, 6.0, 12.0):
            sensor = _made(cls, Sensor, target=target, reach=reach)
            brain = LocalBrain(controller=lambda _: {})
            agent = BasicAgent(body="robot", sensors=[sensor], brains=[brain])
            try:
                ControlRequestor(_world((away, 0), name=target), [agent]).reset(1)
            except AI4UError as error:
                if target != "box":
                    raise NotYet(
                        _(
                            "With `target={target!r}`: {error}. Use `self.target`.",
                            target=target,
                            error=text_of(error),
                        ),
                        hint="target",
                    ) from error
                if away < reach:
                    raise
                raise NotYet(
                    _(
                        "With a reach of {reach:g} m and the target {away:g} m away: {error}",
                        reach=reach,
                        away=away,
                        error=text_of(error),
                    ),
                    hint="beyond",
                ) from error
            found = float(agent.percept[sensor.perception_key][0])
            wanted = max(0.0, 1 - away / reach)
            if not is_close(found, wanted, 0.01):
                hint = "begin"
                if is_close(found, min(1.0, away / reach), 0.01):
                    hint = "reversed"
                elif is_close(found, 1 - away / reach, 0.01) or away > reach:
                    hint = "beyond"
                elif reach != 8.0:
                    hint = "reach"
                raise NotYet(
                    _(
                        "With a reach of {reach:g} m and the target {away:g} m away, the "
                        "reading is {found:.2f}, not {wanted:.2f}.",
                        reach=reach,
                        away=away,
                        found=found,
                        wanted=wanted,
                    ),
                    hint=hint,
                )
    _examined(check_sensor(_made(cls, Sensor, target="box"), decisions=40))
    return Done(_("Fifteen distances, and the examiner has nothing to complain about."))


@exercise(
    "19.2",
    _("Calm"),
    hints={
        "begin": _(
            "`on_update` returns what is paid: `-self.cost` if the robot turns too fast, else 0."
        ),
        "limit": _("The limit is a parameter: compare with `self.limit`."),
        "always": _("It costs even to turn slowly."),
        "side": _(
            "To one side it costs, to the other it does not. `abs` makes every number a "
            "positive one."
        ),
        "sign": _("It pays for turning fast. A cost is below 0."),
    },
)
def pays_for_calm(cls: Any) -> Done:
    """Check for a cost for turning fast, to either side."""
    for limit, cost in ((1.0, 0.1), (2.0, 0.5)):
        for turn in (0.0, 0.5, 3.0, -3.0, 1.5, -1.5):
            calm = _made(cls, RewardFunc, limit=limit, cost=cost)
            agent = BasicAgent(
                body="robot",
                actuators=[RBMoveActuator(turn_amount=3)],
                rewards=[calm],
                brains=[_always("move", 0, -turn / 3, 0, 0)],
            )
            drive(ControlRequestor(_world((5, 5)), [agent]), agent, 1, limit=3)
            found = agent.reward
            wanted = -cost if abs(turn) > limit else 0.0
            if not is_close(found, wanted, 1e-6):
                hint = "sign" if found > 0 else "side" if turn < 0 else "begin"
                if found < 0:
                    hint = "limit" if limit != 1.0 or abs(turn) > 1 else "always"
                elif limit != 1.0 and turn > 0 and found == 0:
                    hint = "limit"
                raise NotYet(
                    _(
                        "With limit {limit:g} and cost {cost:g}, a robot that turns at "
                        "{turn:g} rad/s is paid {found:g}, not {wanted:g}.",
                        limit=limit,
                        cost=cost,
                        turn=turn,
                        found=found,
                        wanted=wanted,
                    ),
                    hint=hint,
                )
    _examined(check_reward(_made(cls, RewardFunc), decisions=60))
    return Done(_("It costs to turn fast, to the left and to the right."))


@exercise(
    "19.3",
    _("A crab"),
    hints={
        "begin": _(
            "`body.apply_force(forward, left)`: no push forward, and to the left "
            "`self.newtons * action[0]`."
        ),
        "forward": _(
            "It goes forward. The second number of `apply_force` is the push to the left."
        ),
        "right": _("Left and right are mixed up: above 0 is a push to the left."),
        "strength": _("Multiply the newtons by the number in the action: `action[0]`."),
        "speed": _("It sets a speed. `apply_force` pushes, and a push makes a body ever faster."),
        "world": _(
            "It goes up on the screen, wherever it looks. Left of the robot is somewhere "
            "else when it has turned: `apply_force` knows that."
        ),
    },
)
def walks_sideways(cls: Any) -> Done:
    """Check that it walks to its own left, whatever its heading."""
    for heading in (0.0, 90.0, -140.0):
        for push in (1.0, -1.0, 0.5):
            crab = _made(cls, Actuator, newtons=10.0)
            agent = BasicAgent(
                body="robot",
                actuators=[crab],
                brains=[_always(crab.action_name, push)],
            )
            sim = ControlRequestor(_world((9, 9), heading), [agent])
            done = drive(sim, agent, 1, limit=12)
            (x, y), turned = agent.body.position, math.radians(heading)
            forward = x * math.cos(turned) + y * math.sin(turned)
            left = y * math.cos(turned) - x * math.sin(turned)
            if left * push < 0.05 or abs(forward) > 0.2 * abs(left):
                hint = "begin"
                if abs(left) > 5 * abs(forward):
                    hint = "right"
                elif heading == 0 and abs(forward) > 0.1:
                    hint = "forward"
                elif done.moved > 0.1:
                    hint = "world"
                raise done.not_yet(
                    _(
                        "With the action {push:g} and a heading of {heading:g} degrees the "
                        "body went {forward:.1f} m forward and {left:.1f} m to its left.",
                        push=push,
                        heading=heading,
                        forward=forward,
                        left=left,
                    ),
                    hint,
                )
    half, full = (_pushed(cls, 10.0, push) for push in (0.5, 1.0))
    if not is_close(half / full, 0.5, 0.1):
        raise NotYet(
            _(
                "With the action 0.5 the body went {half:.2f} m, with 1 {full:.2f} m: the "
                "number in the action says how strong the push is.",
                half=half,
                full=full,
            ),
            hint="strength",
        )
    if _pushed(cls, 10.0, decisions=12) < 2.5 * full:
        raise NotYet(
            _(
                "In twice the time the body got only twice as far. A push makes it faster "
                "and faster."
            ),
            hint="speed",
        )
    weak = _pushed(cls, 5.0)
    strong = _pushed(cls, 20.0)
    if strong < 2 * weak:
        raise NotYet(_("With more `newtons` it does not go faster."), hint="begin")
    _examined(check_actuator(_made(cls, Actuator), decisions=40))
    return Done(_("It walks sideways, wherever it looks."), done.picture())


def _pushed(cls: Any, newtons: float, push: float = 1.0, decisions: int = 6) -> float:
    """Return how far a push takes the body; metres."""
    crab = _made(cls, Actuator, newtons=newtons)
    brain = _always(crab.action_name, push)
    agent = BasicAgent(body="robot", actuators=[crab], brains=[brain])
    return drive(ControlRequestor(_world((9, 9)), [agent]), agent, 1, limit=decisions).moved


exit_ticket(
    "19.exit",
    Question(
        "c",
        {
            "a": _("`read` does not look at the parameter at all: it divides by 8."),
            "b": _("A parameter may have any value. It is just not used."),
        },
    ),
    Question(
        "a",
        {
            "b": _(
                "A space is not a place here. It says what a reading looks like: how many "
                "numbers, from where to where."
            ),
            "c": _(
                "Time has nothing to do with it. A space says from where to where the numbers go."
            ),
        },
    ),
    Question(
        "b",
        {
            "a": _("A scene file is data. It can describe a world, and nothing else."),
            "c": _("A class with functions is a program, and a program can do anything."),
        },
    ),
)
