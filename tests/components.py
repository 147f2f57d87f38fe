"""A table of all components with their AI4U names and their tests."""

import ast
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ai4u_edu import Block
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.blocks.docs import coming_from_ai4u
from ai4u_edu.scenes.serialization import KINDS
from tests.check.samples import GIVEN, INSIDE_OTHERS

TESTS = Path(__file__).parent

AI4U = (
    "ActionSensor AgentArraySensor AreaOrientationSensor Camera Camera3DSensor DoneSensor "
    "FloatArrayCompositeSensor GroundStatusSensor GroupTouchSensor IDSensor LinearRayCastingSensor "
    "LinearRayCastingSensor2D OrientationSensor PositionSensor RayCastingSensor RaycastMapping "
    "RewardSensor ScreenSensor Sensor StepSensor TouchSensor TruncatedSensor "
    "Actuator CBMoveActuator CBMoveActuator2D CBRespawnActuator CBRespawnActuator2D "
    "ContinuousActuator DiscretActuator RBMoveActuator RBMoveActuator2D RBRespawnActuator "
    "AgentRewardFunc AndRewardFunc CollisionWithRewardFunc DistanceToTargetRewardFunc "
    "DynamicFallReward EvalBoolValue EvalFloatValue EvalIntValue FallReward MinDistReward "
    "MinDistReward2D ORRewardFunc RestlessnessRewardFunc RestlessnessRewardFunc2D RewardFunc "
    "TouchRewardFunc TouchRewardFunc2D HomeostaticVariable "
    "BasicAgent RLAgent ControlRequestor Brain LocalBrain RemoteBrain Controller "
    "ArrowPhysicsMoveController ArrowPhysicsMoveController2D DiscretArrowController "
    "WASDRBMoveController NeuralNetController TrainController Trainer Utils"
)
"""All classes of AI4U's guide and of its later versions that a user of AI4U meets."""

AI4U_SETTINGS = (
    "perceptionKey stackedObservations isActive resetable normalized isInput IsState SensorType "
    "sfloat sstring sbool sint sbytearray sfloatarray sintarray sstrings simage Shape agent shape "
    "isContinuous rangeMin rangeMax actionName isOutput ActionDone OnSetup OnReset OnUpdate Eval "
    "ResetEval causeEpisodeToEnd AddReward GetAction NewStateEvent Utils.ParseAction "
    "GetStateAsFloat GetStateAsBool GetStateAsString ID priority MaxStepsPerEpisode rewardScale "
    "doneAtNegativeReward doneAtPositiveReward avatarBody agentPath controllerPath remote "
    "checkEpisodeTruncated arrayInputSize actionHandler actionSize actionIsContinuous "
    "addControlRequestor agentsList defaultTimeScale controlRequestorTimeScale physicsMode "
    "computePhysicsTicks maxPhysicsFrames skipFrame repeatAction host port receiveTimeout "
    "Physics_FPS appgym_sb3train.py test.py "
    "RequestContinuousAction RequestAction StateUpdated SetTarget SetCentroid CheckValue "
    "beforeTheReset endOfEpisode beginOfEpisode endOfStep beginOfStep beginOfUpdateState "
    "endOfUpdateState beginOfApplyAction endOfApplyAction OnResetStart OnEpisodeEnd OnEpisodeStart "
    "OnStepEnd OnStepStart OnStateUpdateStart OnStateUpdateEnd OnActionStart OnActionEnd "
    "OnAgentStart eye Enabled GetStateSize GetStateName GetFieldArgAsInt GetFieldArgAsFloat "
    "GetFieldArgAsBool GetFieldArgAsString GetFieldArgAsFloatArray GetFieldArgAsIntArray "
    "ContainsField fields add_field request_reset EpisodeReward NSteps OnTouch body_entered "
    "body_exited returnDistance verticalShift ExportAgentMetadata RemoteStarter "
    "RemoteConfiguration ControllerConfiguration --ai4u_port --ai4u_host --ai4u_rid sac_export_to"
)
"""The settings, methods and events of these classes, an underscore in place of a space."""

MISSING: dict[str, str] = {}
"""Components of AI4U that are not here yet, and why."""

LISTS_ONLY = {"test_components", "test_parity"}
"""Modules that name components without trying them."""


@dataclass(frozen=True)
class Component:
    """A row of the table."""

    name: str
    kind: str
    ai4u: str
    """Its names in AI4U; empty for what is ours alone."""
    contract: str
    """"yes" if the checks run on it, "in others" if on a block that contains it, else "NO"."""

    @property
    def tests(self) -> dict[str, int]:
        """Number of tests that name it, by module."""
        name = self.name
        tests = {module: names[name] for module, names in named_in_tests().items() if name in names}
        if ">>>" in (Block.types[name].__doc__ or ""):
            tests["its own example"] = 1
        return tests


def components() -> list[Component]:
    """Return all built-in blocks, sorted by kind and name."""
    ai4u: dict[str, list[str]] = {}
    for theirs, ours in parity_rows().items():
        ai4u.setdefault(ours, []).append(theirs)
    found = []
    for name, cls in Block.types.items():
        if not is_built_in(cls) or cls in KINDS or cls.__dict__.get("abstract"):
            continue
        kind = next((each.__name__ for each in KINDS if issubclass(cls, each)), "part")
        contract = "in others" if cls in INSIDE_OTHERS else "yes" if has_sample(cls) else "NO"
        found.append(Component(name, kind, " ".join(ai4u.get(name, ())), contract))
    order = [kind.__name__ for kind in KINDS] + ["part"]
    return sorted(found, key=lambda each: (order.index(each.kind), each.name))


def has_sample(cls: type[Block]) -> bool:
    """Return True if a block has a sample, or can be made without one."""
    fields = cls.parameters().values()
    return cls in GIVEN or not any(field.is_required() for field in fields)


def parity_rows() -> dict[str, str]:
    """Return our names by AI4U's, from the table for users of AI4U; empty if there is none."""
    rows = re.findall(r"^\| `(\w+)` \| (?:`(\w+)`|-) \|", coming_from_ai4u(), re.MULTILINE)
    assert len(dict(rows)) == len(rows) == len(coming_from_ai4u().splitlines()) - 2
    return dict(rows)


@cache
def named_in_tests() -> dict[str, Counter[str]]:
    """Return the number of tests of each module for each name, without modules that only list."""
    files = sorted(TESTS.rglob("test_*.py"))
    return {
        file.relative_to(TESTS).with_suffix("").as_posix(): names_in(
            file.read_text(encoding="utf-8")
        )
        for file in files
        if file.stem not in LISTS_ONLY
    }


def names_in(source: str) -> Counter[str]:
    """Count the top-level parts of a test module that use each name; skipped tests do not count.

    >>> names_in("def test_it(): assert TouchSensor(target='box')")["TouchSensor"]
    1
    >>> names_in("def test_it(): Scene.loads('sensors: [{type: TouchSensor}]')")["TouchSensor"]
    1
    >>> names_in("@pytest.mark.skip\\ndef test_it(): assert TouchSensor()")["TouchSensor"]
    0
    >>> names_in("pytestmark = pytest.mark.skip\\ndef test_it(): TouchSensor()")["TouchSensor"]
    0
    >>> names_in("NIGHTLY = pytest.mark.nightly\\ndef test_it(): TouchSensor()")["TouchSensor"]
    1
    """
    pieces = ast.parse(source).body
    marks = [each for each in pieces if "pytestmark" in _names(each)]
    if any(map(_is_skipped, marks)):
        return Counter()
    return Counter(name for each in pieces if not _is_skipped(each) for name in set(_names(each)))


def _names(piece: ast.stmt) -> Iterator[str]:
    for node in ast.walk(piece):
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name):
                yield name
            case ast.Constant(value=str(text)):  # a scene, perhaps
                yield from re.findall(r"\btype: *(\w+)", text)


def _is_skipped(piece: ast.stmt) -> bool:
    """Return True for a mark of the whole module or of a test: skip, skipif, xfail, nightly."""
    match piece:
        case ast.Assign(targets=[ast.Name(id="pytestmark")], value=value):
            marks: list[ast.AST] = list(ast.walk(value))
        case ast.FunctionDef() | ast.ClassDef():
            marks = [
                each.func if isinstance(each, ast.Call) else each for each in piece.decorator_list
            ]
        case _:
            return False
    names = {mark.attr for mark in marks if isinstance(mark, ast.Attribute)}
    return not {"skip", "skipif", "xfail", "nightly"}.isdisjoint(names)


def table() -> str:
    """Return all components, and the missing ones, in columns."""
    rows = [("component", "kind", "AI4U's name", "contract", "tests that name it")]
    for each in components():
        tests = each.tests
        modules = sorted(tests, key=lambda module: (-tests[module], module))
        shown = ", ".join(f"{module} ({tests[module]})" for module in modules[:3])
        more = f", {len(modules) - 3} more" if len(modules) > 3 else ""
        rows.append((each.name, each.kind, each.ai4u or "-", each.contract, shown + more))
    rows += [("-", "-", name, "-", f"MISSING: {why}") for name, why in MISSING.items()]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    return "\n".join("  ".join((*map(str.ljust, row[:4], widths), row[4])).rstrip() for row in rows)
