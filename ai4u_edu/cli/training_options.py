"""Options of ``ai4u-edu train`` and ``ai4u-edu evaluate``, one type for each."""

from pathlib import Path
from typing import Annotated

import typer

from ai4u_edu.cli.options import (
    MAX_EPISODES,
    MAX_TRAINING_STEPS,
    seed_option,
    training_seed_option,
)

TrainedScene = Annotated[
    str, typer.Argument(help="Scene name or YAML file. Default: box_chase. Not with --resume.")
]
Algorithm = Annotated[str, typer.Option(help="sac, ppo or dqn. Default: as in the settings.")]
Steps = Annotated[
    int | None,
    typer.Option(
        help="Number of decisions to learn from. Default: as in the settings.",
        min=1,
        max=MAX_TRAINING_STEPS,
    ),
]
TrainingSeed = Annotated[
    int, training_seed_option("Random seed; the same seed gives the same model.")
]
TrainingFolder = Annotated[
    Path | None, typer.Option(help="Folder for the results. Default: runs/SCENE-ALGO-SEED.")
]
SettingsFile = Annotated[
    Path | None, typer.Option(help="YAML file to use instead of the scene's own settings.")
]
PolicyKind = Annotated[
    str,
    typer.Option(
        help="Kind of network: MlpPolicy, CnnPolicy (one picture) or MultiInputPolicy. "
        "Default: as in the settings."
    ),
]
Observed = Annotated[
    list[str] | None,
    typer.Option(
        help="Perception key that the policy observes. Repeat the option for several. "
        "Default: as in the settings."
    ),
]
Trainer = Annotated[
    str,
    typer.Option(
        help="Who learns: sb3 (Stable-Baselines3, with torch) or small (with NumPy alone). "
        "Default: sb3 if it is installed."
    ),
]
BeginWith = Annotated[
    Path | None,
    typer.Option(
        help="Network (.onnx) to improve, such as a clone; only with --trainer small.",
        show_default=False,
    ),
]
RewardWeights = Annotated[
    list[str] | None,
    typer.Option(
        "--reward",
        help="Factor of a reward term, such as touch=2; only with --trainer small. Repeat the "
        "option for several.",
        show_default=False,
    ),
]
LearningAgent = Annotated[
    str,
    typer.Option(
        help="Id of the agent that learns, where there are several. Default: the first one.",
        show_default=False,
    ),
]
Against = Annotated[
    str,
    typer.Option(
        help="Who plays the other side, in a scene with two: player (the scene's own), self (the "
        "network itself, as it is and as it was, and the scene's player), or a network (.onnx); "
        "only with --trainer small. Default: all others are driven as the scene says.",
        show_default=False,
    ),
]
Resume = Annotated[bool, typer.Option("--resume", help="Continue the training in --out.")]
Overwrite = Annotated[
    bool, typer.Option("--overwrite", help="Start again and delete the training in --out.")
]
KeepCheckpoints = Annotated[
    bool,
    typer.Option(
        "--keep-checkpoints", help="Keep the model of each check, as checkpoint-STEPS.zip in --out."
    ),
]
WithCritic = Annotated[
    bool,
    typer.Option("--with-critic", help="Also keep the critic, which tells what a place is worth."),
]
Checkpoints = Annotated[
    Path | None,
    typer.Option(
        help="Folder: export the model of each check that the training kept, to compare them.",
        show_default=False,
    ),
]
WatchFlag = Annotated[
    bool,
    typer.Option(
        "--watch",
        help="Show the policy in the browser while it learns and afterwards; Ctrl-C ends it.",
    ),
]
WatchPort = Annotated[
    int,
    typer.Option(help="Port of the page with --watch; 0 for any free port.", min=0, max=65535),
]
EvaluatedScene = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="SCENE",
        help="Scene name or YAML file. Default: the one that the first driver is made for.",
    ),
]
EvaluatedDrivers = Annotated[
    list[str] | None,
    typer.Option(
        "--brain",
        help="The driver: a training's folder, a model (.zip), a network (.onnx, zoo:SCENE, or "
        "zoo for the scene's own), a controller, FILE.py:NAME (a function or a Controller), "
        "random, or scene (the scene's own controller). Repeat the option for several, which get "
        "the same seeds.",
    ),
]
FormerScene = Annotated[str, typer.Option("--scene", hidden=True)]
FormerDrivers = Annotated[list[str] | None, typer.Option("--compare", hidden=True)]
Episodes = Annotated[int, typer.Option(help="Number of episodes.", min=1, max=MAX_EPISODES)]
FirstSeed = Annotated[int, seed_option("Seed of the first episode; the next ones count up.")]
VariedParameter = Annotated[
    str,
    typer.Option(
        help="The number to vary, such as vision.columns or bodies.box.mass. "
        "Default: list all numbers.",
        show_default=False,
    ),
]
VariedValues = Annotated[str, typer.Option(help="Its values, as in 1,2,4,8.", show_default=False)]
VaryingDriver = Annotated[
    str,
    typer.Option(
        "--brain",
        help="The driver: a network (.onnx, zoo:SCENE, or zoo for the scene's own), a controller, "
        "FILE.py:NAME, random, or scene (the scene's own controller). ID=DRIVER for another agent "
        "than the first.",
    ),
]
CsvFile = Annotated[
    Path | None, typer.Option("--csv", help="Write the results to a CSV file; - prints them.")
]
Workers = Annotated[
    int,
    typer.Option(
        help="Processes that drive at a time; starting them takes seconds. The numbers are the "
        "same with any count.",
        min=1,
        max=256,
    ),
]
JsonFile = Annotated[
    Path | None, typer.Option("--json", help="Write the results to a JSON file; - prints them.")
]
Plot = Annotated[Path | None, typer.Option(help="Draw the results into a PNG file.")]
EngineName = Annotated[
    str,
    typer.Option(
        "--engine",
        help="Where the episodes run: inline (here), processes (one for each core), or ray "
        "(a cluster). Starting processes takes seconds.",
    ),
]
JobsEngine = Annotated[
    str,
    typer.Option(
        "--engine",
        help="Where the jobs run: inline (here), processes (one for each core), or ray "
        "(a cluster).",
    ),
]
ClusterAddress = Annotated[
    str,
    typer.Option(help="Address of a Ray cluster, such as 192.0.2.7:6379. Default: this machine."),
]
