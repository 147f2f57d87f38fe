"""Titles, questions, pictures and hints of the built-in blocks."""

from typing import NamedTuple


class BlockWords(NamedTuple):
    """A block in words."""

    title: str
    question: str
    """The question that it answers for the agent or the person who builds it."""
    picture: str
    """Name of its picture and its icon, as in ``web/shared/icons.js``."""
    hint: str = ""
    """A short sentence for people who build an agent; empty shows the summary of its class."""
    first_fields: tuple[str, ...] = ()
    """The parameters that matter most, at most three; by default the first of its own."""


OWN_BLOCKS = "My own blocks"
"""Heading of the blocks that somebody wrote."""

_WHERE, _AROUND, _TOUCH = "Where is ...?", "What is around me?", "What do I touch?"
_PLACE, _FAST, _BODY = "Where am I?", "How fast am I?", "How do I feel?"
_EPISODE, _SCRIPT = "How is it going?", "What does my script tell me?"
_SENSORS = {
    "BearingSensor": BlockWords(
        "Direction to ...", _WHERE, "bearing", "Tells which way a thing is."
    ),
    "OrientationSensor": BlockWords(
        "Direction and distance", _WHERE, "bearing", "Tells which way a thing is, and how far away."
    ),
    "AreaOrientationSensor": BlockWords(
        "Smell of things nearby",
        _WHERE,
        "smell",
        "Tells kind, direction and nearness of the nearest things: a nose.",
        ("group_code", "area", "radius"),
    ),
    "PresenceSensor": BlockWords(
        "Still there?", _WHERE, "presence", "Tells which things of a group are still in the world."
    ),
    "LinearRayCastingSensor": BlockWords(
        "Ray sensor",
        _AROUND,
        "rays",
        "A fan of rays: what each of them hits, and how far away.",
        ("number_of_rays", "field_of_view", "vision_max_distance"),
    ),
    "RayCastingSensor": BlockWords(
        "Ray picture",
        _AROUND,
        "picture",
        "A small picture of what is ahead, made of rays.",
        ("rows", "columns", "vision_max_distance"),
    ),
    "LocalGridSensor": BlockWords(
        "Map around me", _AROUND, "map", "A map of the surroundings that turns with the robot."
    ),
    "GridSensor": BlockWords(
        "Map of the world",
        _AROUND,
        "map",
        "A map of the world, made of square cells; north is up.",
        ("rows", "columns", "cell_size"),
    ),
    "LightSensor": BlockWords(
        "Light sensor", _AROUND, "lamp", "Tells how bright the lamps are on one side."
    ),
    "LineSensor": BlockWords(
        "Line sensor", _AROUND, "line", "A row of eyes that look down: 1 on the line, 0 beside it."
    ),
    "TouchSensor": BlockWords(
        "Bumper", _TOUCH, "touch", "1 while the robot touches the target, else -1."
    ),
    "GroupTouchSensor": BlockWords(
        "Bumper for a group",
        _TOUCH,
        "touch",
        "1 while the robot touches anything of a group, else -1.",
    ),
    "GroundStatusSensor": BlockWords(
        "Ground under me", _TOUCH, "ground", "1 on the ground, -1 in the air."
    ),
    "HeadingSensor": BlockWords("Compass", _PLACE, "compass", "Tells which way the robot looks."),
    "PositionSensor": BlockWords(
        "Position", _PLACE, "position", "Tells where the robot or a thing is."
    ),
    "CellSensor": BlockWords(
        "Cell of the grid", _PLACE, "cell", "Tells row and column of the cell the robot is in."
    ),
    "VelocitySensor": BlockWords(
        "Speed", _FAST, "speed", "Tells how fast the robot drives and turns."
    ),
    "ColourSensor": BlockWords(
        "Colour of the ground",
        _AROUND,
        "eye",
        "Tells the colour and brightness of one point of the ground: ink, paint or floor.",
    ),
    "HearSensor": BlockWords(
        "Hear others", _AROUND, "sound", "Tells what the nearest robots have just said."
    ),
    "HomeostaticSensor": BlockWords(
        "Needs: energy, water", _BODY, "need", "Tells how hungry or thirsty the robot is."
    ),
    "ActionSensor": BlockWords(
        "My last action", _EPISODE, "memory", "Tells what the robot did last."
    ),
    "RewardSensor": BlockWords("My last reward", _EPISODE, "star", "Tells the last reward."),
    "StepSensor": BlockWords(
        "Step counter", _EPISODE, "clock", "Counts the decisions of this episode."
    ),
    "DoneSensor": BlockWords("Episode over", _EPISODE, "end", "1 at the end, 0 before."),
    "TruncatedSensor": BlockWords("Out of time", _EPISODE, "clock", "1 once the time is up."),
    "IDSensor": BlockWords("My name", _EPISODE, "text", "Gives the name of the robot."),
    "AgentArraySensor": BlockWords(
        "Numbers from a script", _SCRIPT, "script", "Numbers that a Python script tells the robot."
    ),
    "FloatArrayCompositeSensor": BlockWords(
        "Sensors in one row", _SCRIPT, "row", "Joins several sensors to one."
    ),
}
_DRIVE, _THINGS, _START = "How do I drive?", "What can I do with things?", "Where do I start?"
_ACTUATORS = {
    "RBMoveActuator": BlockWords(
        "Drive and jump",
        _DRIVE,
        "drive",
        "Drives, turns and jumps.",
        ("move_amount", "turn_amount", "jump_power"),
    ),
    "CBMoveActuator": BlockWords(
        "Drive, jump and sidestep",
        _DRIVE,
        "drive",
        "Drives, sidesteps, turns and jumps.",
        ("move_amount", "turn_amount", "jump_power"),
    ),
    "ForceMoveActuator": BlockWords(
        "Push myself forward", _DRIVE, "drive", "Pushes the robot forward and turns it."
    ),
    "DifferentialDriveActuator": BlockWords(
        "Two wheels", _DRIVE, "wheels", "Drives with a left and a right wheel."
    ),
    "CarActuator": BlockWords("Car", _DRIVE, "car", "Drives and steers like a car."),
    "GridMoveActuator": BlockWords(
        "One cell at a time", _DRIVE, "cell", "Moves by exactly one cell at each decision."
    ),
    "DiscreteActuator": BlockWords(
        "List of motions", _DRIVE, "row", "Chooses one motion of a list."
    ),
    "GrabActuator": BlockWords(
        "Grab things", _THINGS, "grab", "Holds a thing that the robot touches in front."
    ),
    "CollectActuator": BlockWords(
        "Collect things", _THINGS, "collect", "Takes things away that the robot touches."
    ),
    "PenActuator": BlockWords(
        "Draw with a pen", _THINGS, "pen", "Draws a line on the floor wherever the robot goes."
    ),
    "SpeakActuator": BlockWords(
        "Speak to others",
        "What can I tell others?",
        "sound",
        "Says a few numbers to all robots that are near enough.",
    ),
    "RespawnActuator": BlockWords(
        "Start somewhere else", _START, "position", "Starts each episode at one of several places."
    ),
    "ContinuousActuator": BlockWords(
        "Numbers for a script",
        "What does my script do?",
        "script",
        "Gives numbers to a Python script.",
    ),
}
_REACH, _CLOSER, _AVOID = "Did I reach it?", "Am I getting closer?", "What went wrong?"
_TRUE, _SEVERAL = "Is something true?", "How do several go together?"
_REWARDS = {
    "TouchRewardFunc": BlockWords(
        "Reach the target", _REACH, "target", "A reward for touching the target."
    ),
    "BodyInAreaRewardFunc": BlockWords(
        "Bring something into an area", _REACH, "area", "A reward when a thing lies in an area."
    ),
    "EventRewardFunc": BlockWords(
        "Each touch, or way in or out",
        _REACH,
        "area",
        "A reward each time the robot touches a thing, or goes into an area or out of it.",
    ),
    "ParkedRewardFunc": BlockWords(
        "Park in an area", _REACH, "area", "A reward for standing straight in an area."
    ),
    "CheckpointsReward": BlockWords(
        "Touch things in order",
        _REACH,
        "route",
        "A reward for each target that is touched in order.",
    ),
    "FigureReward": BlockWords(
        "Draw a figure",
        _REACH,
        "pen",
        "A reward for ink that covers a figure, and no ink beside it.",
    ),
    "GoneReward": BlockWords(
        "Make things go away",
        _REACH,
        "presence",
        "A reward for each thing of a group that leaves the world.",
    ),
    "TargetFallReward": BlockWords(
        "Target has fallen", _REACH, "fall", "A reward when the target has fallen."
    ),
    "ProgressReward": BlockWords(
        "Every metre closer", _CLOSER, "closer", "A reward for each metre closer to the target."
    ),
    "MinDistReward": BlockWords(
        "Closer than before",
        _CLOSER,
        "closer",
        "A reward for being closer to the target than ever.",
    ),
    "DistanceToTargetRewardFunc": BlockWords(
        "Be near the target", _CLOSER, "target", "A reward for being near the target."
    ),
    "CollisionWithRewardFunc": BlockWords(
        "Hit something", _AVOID, "touch", "A reward, or a penalty, while the robot touches a group."
    ),
    "FallReward": BlockWords(
        "Fall", _AVOID, "fall", "A reward, or a penalty, when the robot falls."
    ),
    "DynamicFallReward": BlockWords(
        "Fall below something",
        _AVOID,
        "fall",
        "A reward, or a penalty, when the robot falls below a thing.",
    ),
    "RestlessnessRewardFunc": BlockWords(
        "Stand still", _AVOID, "still", "A penalty for standing still."
    ),
    "HomeostaticReward": BlockWords(
        "Feel better", _BODY, "need", "A reward when the robot's needs get better."
    ),
    "EvalBoolValue": BlockWords(
        "A property is true", _TRUE, "check", "Holds while something is true."
    ),
    "EvalFloatValue": BlockWords(
        "A number is in a range", _TRUE, "check", "Holds while a number is in a range."
    ),
    "EvalIntValue": BlockWords(
        "A whole number is in a range", _TRUE, "check", "Holds while a whole number is in a range."
    ),
    "AndRewardFunc": BlockWords(
        "All of these", _SEVERAL, "row", "A reward while all of its parts hold."
    ),
    "OrRewardFunc": BlockWords(
        "Any of these", _SEVERAL, "row", "A reward while one of its parts holds."
    ),
}
_WHO, _KEYS, _PROGRAM = "Who decides?", "Which keys drive?", "Which program drives?"
_BRAINS = {
    "LocalBrain": BlockWords(
        "Brain in this world", _WHO, "brain", "Decides here: keys, a network or a Python function."
    ),
    "RemoteBrain": BlockWords(
        "Python script", _WHO, "script", "A Python script in another program decides."
    ),
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
    "CallController": BlockWords("Partner that calls", _PROGRAM, "sound"),
    "AntController": BlockWords("Ant that follows trails", _PROGRAM, "route"),
    "FleeController": BlockWords("Run away", _PROGRAM, "speed"),
    "KeeperController": BlockWords("Goalkeeper", _PROGRAM, "area"),
    "StrikerController": BlockWords("Striker", _PROGRAM, "target"),
    "PushOutController": BlockWords("Sumo fighter", _PROGRAM, "drive"),
}
_PARTS = {
    "HomeostaticVariable": BlockWords(
        "Need", _BODY, "need", "A need such as energy or water, with a zone that feels good."
    )
}

BLOCK_WORDS: dict[str, BlockWords] = {
    **_SENSORS,
    **_ACTUATORS,
    **_REWARDS,
    **_BRAINS,
    **_PARTS,
    "": BlockWords("", OWN_BLOCKS, "own"),
}
"""Words by class name, in the order in which a page shows the questions."""
