"""Titles, questions and pictures of the built-in blocks."""

from typing import NamedTuple


class BlockWords(NamedTuple):
    """A block in words."""

    title: str
    question: str
    """The question that it answers for the agent or the person who builds it."""
    picture: str
    """Name of its picture and its icon, as in ``web/shared/icons.js``."""
    first_fields: tuple[str, ...] = ()
    """The parameters that matter most, at most three; by default the first of its own."""


OWN_BLOCKS = "My own blocks"
"""Heading of the blocks that somebody wrote."""

_WHERE, _AROUND, _TOUCH = "Where is ...?", "What is around me?", "What do I touch?"
_PLACE, _FAST, _BODY = "Where am I?", "How fast am I?", "How do I feel?"
_EPISODE, _SCRIPT = "How is it going?", "What does my script tell me?"
_SENSORS = {
    "BearingSensor": BlockWords("Direction to ...", _WHERE, "bearing"),
    "OrientationSensor": BlockWords("Direction and distance", _WHERE, "bearing"),
    "AreaOrientationSensor": BlockWords(
        "Smell of things nearby", _WHERE, "smell", ("group_code", "area", "radius")
    ),
    "PresenceSensor": BlockWords("Still there?", _WHERE, "presence"),
    "LinearRayCastingSensor": BlockWords(
        "Ray sensor",
        _AROUND,
        "rays",
        ("number_of_rays", "field_of_view", "vision_max_distance"),
    ),
    "RayCastingSensor": BlockWords(
        "Ray picture", _AROUND, "picture", ("rows", "columns", "vision_max_distance")
    ),
    "LocalGridSensor": BlockWords("Map around me", _AROUND, "map"),
    "GridSensor": BlockWords("Map of the world", _AROUND, "map", ("rows", "columns", "cell_size")),
    "LightSensor": BlockWords("Light sensor", _AROUND, "lamp"),
    "LineSensor": BlockWords("Line sensor", _AROUND, "line"),
    "TouchSensor": BlockWords("Bumper", _TOUCH, "touch"),
    "GroupTouchSensor": BlockWords("Bumper for a group", _TOUCH, "touch"),
    "GroundStatusSensor": BlockWords("Ground under me", _TOUCH, "ground"),
    "HeadingSensor": BlockWords("Compass", _PLACE, "compass"),
    "PositionSensor": BlockWords("Position", _PLACE, "position"),
    "CellSensor": BlockWords("Cell of the grid", _PLACE, "cell"),
    "VelocitySensor": BlockWords("Speed", _FAST, "speed"),
    "HomeostaticSensor": BlockWords("Needs: energy, water", _BODY, "need"),
    "ActionSensor": BlockWords("My last action", _EPISODE, "memory"),
    "RewardSensor": BlockWords("My last reward", _EPISODE, "star"),
    "StepSensor": BlockWords("Step counter", _EPISODE, "clock"),
    "DoneSensor": BlockWords("Episode over", _EPISODE, "end"),
    "TruncatedSensor": BlockWords("Out of time", _EPISODE, "clock"),
    "IDSensor": BlockWords("My name", _EPISODE, "text"),
    "AgentArraySensor": BlockWords("Numbers from a script", _SCRIPT, "script"),
    "FloatArrayCompositeSensor": BlockWords("Sensors in one row", _SCRIPT, "row"),
}
_DRIVE, _THINGS, _START = "How do I drive?", "What can I do with things?", "Where do I start?"
_ACTUATORS = {
    "RBMoveActuator": BlockWords(
        "Drive and jump", _DRIVE, "drive", ("move_amount", "turn_amount", "jump_power")
    ),
    "CBMoveActuator": BlockWords(
        "Drive, jump and sidestep", _DRIVE, "drive", ("move_amount", "turn_amount", "jump_power")
    ),
    "ForceMoveActuator": BlockWords("Push myself forward", _DRIVE, "drive"),
    "DifferentialDriveActuator": BlockWords("Two wheels", _DRIVE, "wheels"),
    "CarActuator": BlockWords("Car", _DRIVE, "car"),
    "GridMoveActuator": BlockWords("One cell at a time", _DRIVE, "cell"),
    "DiscreteActuator": BlockWords("List of motions", _DRIVE, "row"),
    "GrabActuator": BlockWords("Grab things", _THINGS, "grab"),
    "CollectActuator": BlockWords("Collect things", _THINGS, "collect"),
    "RespawnActuator": BlockWords("Start somewhere else", _START, "position"),
    "ContinuousActuator": BlockWords("Numbers for a script", "What does my script do?", "script"),
}
_REACH, _CLOSER, _AVOID = "Did I reach it?", "Am I getting closer?", "What went wrong?"
_TRUE, _SEVERAL = "Is something true?", "How do several go together?"
_REWARDS = {
    "TouchRewardFunc": BlockWords("Reach the target", _REACH, "target"),
    "BodyInAreaRewardFunc": BlockWords("Bring something into an area", _REACH, "area"),
    "ParkedRewardFunc": BlockWords("Park in an area", _REACH, "area"),
    "CheckpointsReward": BlockWords("Visit targets in order", _REACH, "route"),
    "GoneReward": BlockWords("Make things disappear", _REACH, "presence"),
    "TargetFallReward": BlockWords("Target has fallen", _REACH, "fall"),
    "ProgressReward": BlockWords("Every metre closer", _CLOSER, "closer"),
    "MinDistReward": BlockWords("Closer than ever", _CLOSER, "closer"),
    "DistanceToTargetRewardFunc": BlockWords("Be near the target", _CLOSER, "target"),
    "CollisionWithRewardFunc": BlockWords("Hit something", _AVOID, "touch"),
    "FallReward": BlockWords("Fall", _AVOID, "fall"),
    "DynamicFallReward": BlockWords("Fall below something", _AVOID, "fall"),
    "RestlessnessRewardFunc": BlockWords("Stand still", _AVOID, "still"),
    "HomeostaticReward": BlockWords("Feel better", _BODY, "need"),
    "EvalBoolValue": BlockWords("A property is true", _TRUE, "check"),
    "EvalFloatValue": BlockWords("A number is in a range", _TRUE, "check"),
    "EvalIntValue": BlockWords("A whole number is in a range", _TRUE, "check"),
    "AndRewardFunc": BlockWords("All of these", _SEVERAL, "row"),
    "OrRewardFunc": BlockWords("Any of these", _SEVERAL, "row"),
}
_WHO, _KEYS, _PROGRAM = "Who decides?", "Which keys drive?", "Which program drives?"
_BRAINS = {
    "LocalBrain": BlockWords("Brain in this world", _WHO, "brain"),
    "RemoteBrain": BlockWords("Python script", _WHO, "script"),
    "WASDRBMoveController": BlockWords("Keys W, A, S, D", _KEYS, "keys"),
    "WASDController": BlockWords("Keys W, A, S, D, with sidestep", _KEYS, "keys"),
    "ArrowController": BlockWords("Arrow keys", _KEYS, "keys"),
    "DiscreteArrowController": BlockWords("Arrow keys, one choice each", _KEYS, "keys"),
    "NeuralNetController": BlockWords("Trained network", _PROGRAM, "network"),
    "ScriptController": BlockWords("Python function", _PROGRAM, "script"),
    "TrainController": BlockWords("Training script", _PROGRAM, "script"),
    "ReplayController": BlockWords("Recorded actions", _PROGRAM, "memory"),
    "AStarController": BlockWords("Shortest path (A*)", _PROGRAM, "route"),
    "BreadthFirstController": BlockWords("Shortest path (breadth first)", _PROGRAM, "route"),
    "FleeController": BlockWords("Run away", _PROGRAM, "speed"),
    "KeeperController": BlockWords("Goalkeeper", _PROGRAM, "area"),
    "StrikerController": BlockWords("Striker", _PROGRAM, "target"),
    "PushOutController": BlockWords("Sumo fighter", _PROGRAM, "drive"),
}
_PARTS = {"HomeostaticVariable": BlockWords("Need", _BODY, "need")}

BLOCK_WORDS: dict[str, BlockWords] = {
    **_SENSORS,
    **_ACTUATORS,
    **_REWARDS,
    **_BRAINS,
    **_PARTS,
    "": BlockWords("", OWN_BLOCKS, "own"),
}
"""Words by class name, in the order in which a page shows the questions."""
