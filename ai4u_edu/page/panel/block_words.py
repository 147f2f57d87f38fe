"""Titles, questions, pictures and hints of the built-in blocks."""

from typing import NamedTuple

from ai4u_edu.locale import gettext as _


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


OWN_BLOCKS = _("My own blocks")
"""Heading of the blocks that somebody wrote."""

_WHERE, _AROUND, _TOUCH = _("Where is ...?"), _("What is around me?"), _("What do I touch?")
_PLACE, _FAST, _BODY = _("Where am I?"), _("How fast am I?"), _("How do I feel?")
_EPISODE, _SCRIPT = _("How is it going?"), _("What does my script tell me?")
_SENSORS = {
    "BearingSensor": BlockWords(
        _("Direction to ..."), _WHERE, "bearing", _("Tells which way a thing is.")
    ),
    "OrientationSensor": BlockWords(
        _("Direction and distance"),
        _WHERE,
        "bearing",
        _("Tells which way a thing is, and how far away."),
    ),
    "AreaOrientationSensor": BlockWords(
        _("Smell of things nearby"),
        _WHERE,
        "smell",
        _("Tells kind, direction and nearness of the nearest things: a nose."),
        ("group_code", "area", "radius"),
    ),
    "PresenceSensor": BlockWords(
        _("Still there?"),
        _WHERE,
        "presence",
        _("Tells which things of a group are still in the world."),
    ),
    "LinearRayCastingSensor": BlockWords(
        _("Ray sensor"),
        _AROUND,
        "rays",
        _("A fan of rays: what each of them hits, and how far away."),
        ("number_of_rays", "field_of_view", "vision_max_distance"),
    ),
    "RayCastingSensor": BlockWords(
        _("Ray picture"),
        _AROUND,
        "picture",
        _("A small picture of what is ahead, made of rays."),
        ("rows", "columns", "vision_max_distance"),
    ),
    "LocalGridSensor": BlockWords(
        _("Map around me"),
        _AROUND,
        "map",
        _("A map of the surroundings that turns with the robot."),
    ),
    "GridSensor": BlockWords(
        _("Map of the world"),
        _AROUND,
        "map",
        _("A map of the world, made of square cells; north is up."),
        ("rows", "columns", "cell_size"),
    ),
    "LightSensor": BlockWords(
        _("Light sensor"), _AROUND, "lamp", _("Tells how bright the lamps are on one side.")
    ),
    "LineSensor": BlockWords(
        _("Line sensor"),
        _AROUND,
        "line",
        _("A row of eyes that look down: 1 on the line, 0 beside it."),
    ),
    "TouchSensor": BlockWords(
        _("Bumper"), _TOUCH, "touch", _("1 while the robot touches the target, else -1.")
    ),
    "GroupTouchSensor": BlockWords(
        _("Bumper for a group"),
        _TOUCH,
        "touch",
        _("1 while the robot touches anything of a group, else -1."),
    ),
    "EventSensor": BlockWords(
        _("Something happened"),
        _TOUCH,
        "touch",
        _("1 once when the robot has touched a thing or gone into an area, else 0."),
    ),
    "GroundStatusSensor": BlockWords(
        _("Ground under me"), _TOUCH, "ground", _("1 on the ground, -1 in the air.")
    ),
    "HeadingSensor": BlockWords(
        _("Compass"), _PLACE, "compass", _("Tells which way the robot looks.")
    ),
    "PositionSensor": BlockWords(
        _("Position"), _PLACE, "position", _("Tells where the robot or a thing is.")
    ),
    "CellSensor": BlockWords(
        _("Cell of the grid"),
        _PLACE,
        "cell",
        _("Tells row and column of the cell the robot is in."),
    ),
    "VelocitySensor": BlockWords(
        _("Speed"), _FAST, "speed", _("Tells how fast the robot drives and turns.")
    ),
    "ColourSensor": BlockWords(
        _("Colour of the ground"),
        _AROUND,
        "eye",
        _("Tells the colour and brightness of one point of the ground: ink, paint or floor."),
    ),
    "HearSensor": BlockWords(
        _("Hear others"), _AROUND, "hear", _("Tells what the nearest robots have just said.")
    ),
    "HomeostaticSensor": BlockWords(
        _("Needs: energy, water"), _BODY, "need", _("Tells how hungry or thirsty the robot is.")
    ),
    "ActionSensor": BlockWords(
        _("My last action"), _EPISODE, "memory", _("Tells what the robot did last.")
    ),
    "RewardSensor": BlockWords(_("My last reward"), _EPISODE, "star", _("Tells the last reward.")),
    "StepSensor": BlockWords(
        _("Step counter"), _EPISODE, "clock", _("Counts the decisions of this episode.")
    ),
    "DoneSensor": BlockWords(_("Episode over"), _EPISODE, "end", _("1 at the end, 0 before.")),
    "TruncatedSensor": BlockWords(_("Out of time"), _EPISODE, "clock", _("1 once the time is up.")),
    "IDSensor": BlockWords(_("My name"), _EPISODE, "text", _("Gives the name of the robot.")),
    "AgentArraySensor": BlockWords(
        _("Numbers from a script"),
        _SCRIPT,
        "script",
        _("Numbers that a Python script tells the robot."),
    ),
    "FloatArrayCompositeSensor": BlockWords(
        _("Sensors in one row"), _SCRIPT, "row", _("Joins several sensors to one.")
    ),
}
_DRIVE, _THINGS, _START = (
    _("How do I drive?"),
    _("What can I do with things?"),
    _("Where do I start?"),
)
_ACTUATORS = {
    "RBMoveActuator": BlockWords(
        _("Drive and jump"),
        _DRIVE,
        "drive",
        _("Drives, turns and jumps."),
        ("move_amount", "turn_amount", "jump_power"),
    ),
    "CBMoveActuator": BlockWords(
        _("Drive, jump and sidestep"),
        _DRIVE,
        "drive",
        _("Drives, sidesteps, turns and jumps."),
        ("move_amount", "turn_amount", "jump_power"),
    ),
    "ForceMoveActuator": BlockWords(
        _("Push myself forward"), _DRIVE, "drive", _("Pushes the robot forward and turns it.")
    ),
    "DifferentialDriveActuator": BlockWords(
        _("Two wheels"), _DRIVE, "wheels", _("Drives with a left and a right wheel.")
    ),
    "CarActuator": BlockWords(_("Car"), _DRIVE, "car", _("Drives and steers like a car.")),
    "GridMoveActuator": BlockWords(
        _("One cell at a time"), _DRIVE, "cell", _("Moves by exactly one cell at each decision.")
    ),
    "DiscreteActuator": BlockWords(
        _("List of motions"), _DRIVE, "row", _("Chooses one motion of a list.")
    ),
    "GrabActuator": BlockWords(
        _("Grab things"), _THINGS, "grab", _("Holds a thing that the robot touches in front.")
    ),
    "CollectActuator": BlockWords(
        _("Collect things"), _THINGS, "collect", _("Takes things away that the robot touches.")
    ),
    "PenActuator": BlockWords(
        _("Draw with a pen"),
        _THINGS,
        "pen",
        _("Draws a line on the floor wherever the robot goes."),
    ),
    "SpeakActuator": BlockWords(
        _("Speak to others"),
        _("What can I tell others?"),
        "speak",
        _("Says a few numbers to all robots that are near enough."),
    ),
    "RespawnActuator": BlockWords(
        _("Start somewhere else"),
        _START,
        "position",
        _("Starts each episode at one of several places."),
    ),
    "ContinuousActuator": BlockWords(
        _("Numbers for a script"),
        _("What does my script do?"),
        "script",
        _("Gives numbers to a Python script."),
    ),
}
_REACH, _CLOSER, _AVOID = _("Did I reach it?"), _("Am I getting closer?"), _("What went wrong?")
_TRUE, _SEVERAL = _("Is something true?"), _("How do several go together?")
_REWARDS = {
    "TouchRewardFunc": BlockWords(
        _("Reach the target"), _REACH, "target", _("A reward for touching the target.")
    ),
    "BodyInAreaRewardFunc": BlockWords(
        _("Bring something into an area"),
        _REACH,
        "area",
        _("A reward when a thing lies in an area."),
    ),
    "EventRewardFunc": BlockWords(
        _("Each touch, or way in or out"),
        _REACH,
        "area",
        _("A reward each time the robot touches a thing, or goes into an area or out of it."),
    ),
    "ParkedRewardFunc": BlockWords(
        _("Park in an area"), _REACH, "area", _("A reward for standing straight in an area.")
    ),
    "CheckpointsReward": BlockWords(
        _("Touch things in order"),
        _REACH,
        "route",
        _("A reward for each target that is touched in order."),
    ),
    "FigureReward": BlockWords(
        _("Draw a figure"),
        _REACH,
        "pen",
        _("A reward for ink that covers a figure, and no ink beside it."),
    ),
    "GoneReward": BlockWords(
        _("Make things go away"),
        _REACH,
        "presence",
        _("A reward for each thing of a group that leaves the world."),
    ),
    "TargetFallReward": BlockWords(
        _("Target has fallen"), _REACH, "fall", _("A reward when the target has fallen.")
    ),
    "ProgressReward": BlockWords(
        _("Every metre closer"),
        _CLOSER,
        "closer",
        _("A reward for each metre closer to the target."),
    ),
    "MinDistReward": BlockWords(
        _("Closer than before"),
        _CLOSER,
        "closer",
        _("A reward for being closer to the target than ever."),
    ),
    "DistanceToTargetRewardFunc": BlockWords(
        _("Be near the target"), _CLOSER, "target", _("A reward for being near the target.")
    ),
    "CollisionWithRewardFunc": BlockWords(
        _("Hit something"),
        _AVOID,
        "touch",
        _("A reward, or a penalty, while the robot touches a group."),
    ),
    "FallReward": BlockWords(
        _("Fall"), _AVOID, "fall", _("A reward, or a penalty, when the robot falls.")
    ),
    "DynamicFallReward": BlockWords(
        _("Fall below something"),
        _AVOID,
        "fall",
        _("A reward, or a penalty, when the robot falls below a thing."),
    ),
    "RestlessnessRewardFunc": BlockWords(
        _("Stand still"), _AVOID, "still", _("A penalty for standing still.")
    ),
    "HomeostaticReward": BlockWords(
        _("Feel better"), _BODY, "need", _("A reward when the robot's needs get better.")
    ),
    "EvalBoolValue": BlockWords(
        _("A property is true"), _TRUE, "check", _("Holds while something is true.")
    ),
    "EvalFloatValue": BlockWords(
        _("A number is in a range"), _TRUE, "check", _("Holds while a number is in a range.")
    ),
    "EvalIntValue": BlockWords(
        _("A whole number is in a range"),
        _TRUE,
        "check",
        _("Holds while a whole number is in a range."),
    ),
    "AndRewardFunc": BlockWords(
        _("All of these"), _SEVERAL, "row", _("A reward while all of its parts hold.")
    ),
    "OrRewardFunc": BlockWords(
        _("Any of these"), _SEVERAL, "row", _("A reward while one of its parts holds.")
    ),
}
_WHO, _KEYS, _PROGRAM = _("Who decides?"), _("Which keys drive?"), _("Which program drives?")
_BRAINS = {
    "LocalBrain": BlockWords(
        _("Brain in this world"),
        _WHO,
        "brain",
        _("Decides here: keys, a network or a Python function."),
    ),
    "RemoteBrain": BlockWords(
        _("Python script"), _WHO, "script", _("A Python script in another program decides.")
    ),
    "WASDRBMoveController": BlockWords(_("Keys W, A, S, D"), _KEYS, "keys"),
    "WASDController": BlockWords(_("Keys W, A, S, D, with sidestep"), _KEYS, "keys"),
    "ArrowController": BlockWords(_("Arrow keys"), _KEYS, "keys"),
    "DiscreteArrowController": BlockWords(_("Arrow keys, one choice each"), _KEYS, "keys"),
    "NeuralNetController": BlockWords(_("Trained network"), _PROGRAM, "network"),
    "ScriptController": BlockWords(_("Python function"), _PROGRAM, "script"),
    "TrainController": BlockWords(_("Training script"), _PROGRAM, "script"),
    "ReplayController": BlockWords(_("Recorded actions"), _PROGRAM, "memory"),
    "AStarController": BlockWords(_("Shortest path (A*)"), _PROGRAM, "route"),
    "BreadthFirstController": BlockWords(_("Shortest path (breadth first)"), _PROGRAM, "route"),
    "CallController": BlockWords(_("Partner that calls"), _PROGRAM, "speak"),
    "AntController": BlockWords(_("Ant that follows trails"), _PROGRAM, "route"),
    "FleeController": BlockWords(_("Run away"), _PROGRAM, "speed"),
    "KeeperController": BlockWords(_("Goalkeeper"), _PROGRAM, "area"),
    "StrikerController": BlockWords(_("Striker"), _PROGRAM, "target"),
    "PushOutController": BlockWords(_("Sumo fighter"), _PROGRAM, "drive"),
}
_PARTS = {
    "HomeostaticVariable": BlockWords(
        _("Need"), _BODY, "need", _("A need such as energy or water, with a zone that feels good.")
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

NUMBER_NAMES: dict[str, str] = {
    "forward": _("forward"),
    "turn": _("turn"),
    "jump": _("jump"),
    "forward jump": _("forward jump"),
    "strafe": _("strafe"),
    "left": _("left"),
    "right": _("right"),
    "up": _("up"),
    "throttle": _("throttle"),
    "steering": _("steering"),
    "turning": _("turning"),
    "speak": _("speak"),
    "heard": _("heard"),
    "down": _("down"),
    "colour": _("colour"),
    "width": _("width"),
    "grip": _("grip"),
    "sine": _("sine"),
    "cosine": _("cosine"),
    "distance": _("distance"),
    "left?": _("left?"),
    "ahead?": _("ahead?"),
    "north?": _("north?"),
    "east?": _("east?"),
    "row": _("row"),
    "column": _("column"),
    "red": _("red"),
    "green": _("green"),
    "blue": _("blue"),
    "brightness": _("brightness"),
}
"""Names of the numbers of readings and actions, as a page shows them; programs have the English."""
