"""Makes the networks that come with the package: ``python -m ai4u_edu.training.zoo SCENE ...``.

Each scene is learned as its settings say, to the last step; the best network is exported, and
evaluated on 100 seeds that no training uses. What falls short is learned once more from another
seed, and in the end not taken. The folder's README.md tells how good each one is.
"""

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from ai4u_edu import zoo
from ai4u_edu.scenes import Scene
from ai4u_edu.training.algorithms import load_model
from ai4u_edu.training.entrants import entrant
from ai4u_edu.training.evaluate import Evaluation, evaluate
from ai4u_edu.training.export import export
from ai4u_edu.training.report import row
from ai4u_edu.training.settings import settings_for
from ai4u_edu.training.train import train

EPISODES = 100
WANTED = 0.95
"""Share of the episodes that has to succeed, in a scene that has a success."""
LARGEST = 200_000
"""Bytes of a network."""
TRIES = 3

HEAD = """\
# Networks that come with the package

Made by `python -m ai4u_edu.training.zoo`; let one drive with `ai4u-edu play SCENE --brain zoo`.
Evaluated on seeds 0..99, which no training uses; a scene's own limit of steps holds.

| scene | learned by | steps | seed | success | 95% between | return | length |
|---|---|---|---|---|---|---|---|
"""


def make(scene: str, folder: Path) -> Evaluation | None:
    """Trains, exports and evaluates one network; None if none was good enough."""
    loaded = Scene.load(scene)
    settings = settings_for(scene).model_copy(update={"enough": 0})
    algorithm = settings.algorithm
    for seed in range(TRIES):
        done = train(loaded, algorithm, settings, folder / f"{scene}-{seed}", seed=seed)
        model = load_model(algorithm, done.run.best)
        file = export(model, loaded, done.run.config(), folder / f"{scene}.onnx")
        told = evaluate(entrant(str(file)), loaded, range(EPISODES))
        share = "no success to count" if told.success is None else f"success {told.success:.0%}"
        sys.stderr.write(f"{scene}, {algorithm}, seed {seed}: {share}\n")
        if (told.success is None or told.success >= WANTED) and file.stat().st_size <= LARGEST:
            zoo.network_of(scene).write_bytes(file.read_bytes())
            return told
    return None


def tell() -> str:
    """The folder's README.md: evaluates every network anew."""
    return HEAD + "".join(f"{_line(name)}\n" for name in zoo.names())


def _line(name: str) -> str:
    import onnx

    entries = onnx.load(zoo.network_of(name)).metadata_props
    about: dict[str, Any] = json.loads(entries[0].value)
    told = evaluate(entrant(f"zoo:{name}"), Scene.load(name), range(EPISODES))
    cells = (name, about["algorithm"], about["steps"], about["seed"], *row(told))
    return f"| {' | '.join(map(str, cells))} |"


def main() -> int:
    """Makes those that are named, or all that settings are there for; ``--tell`` only evaluates."""
    names = [each for each in sys.argv[1:] if not each.startswith("-")]
    failed = []
    if "--tell" not in sys.argv:
        with tempfile.TemporaryDirectory() as folder:
            failed = [name for name in names or zoo.names() if not make(name, Path(folder))]
    (zoo.FOLDER / "README.md").write_text(tell(), encoding="utf-8")
    if failed:
        sys.stderr.write(f"not good enough: {', '.join(failed)}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
