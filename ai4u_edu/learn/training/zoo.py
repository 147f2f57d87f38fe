"""Training of the package's networks: ``python -m ai4u_edu.learn.training.zoo SCENE ...``.

Each scene is trained as its settings say, to the last step; the best network is exported and
evaluated on 100 seeds that no training uses. A network that falls short is trained once more from
another seed, and rejected in the end. The folder's README.md lists all results.
"""

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.learn.training.algorithms import load_model
from ai4u_edu.learn.training.evaluating import Evaluation, evaluate
from ai4u_edu.learn.training.exporting import export
from ai4u_edu.learn.training.learning import train
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.settings import settings_for
from ai4u_edu.scenes import Scene

EPISODES = 100
MIN_SUCCESS_SHARE = 0.95
"""Share of the episodes that has to succeed, in a scene that defines a success."""
MAX_ZOO_NETWORK_BYTES = 200_000
"""Limit of a network's size."""
TRIES = 3

HEAD = """\
# Networks that come with the package

Let one drive with `ai4u-edu play SCENE --brain zoo`. Those of PPO learned from reward alone, by
`python -m ai4u_edu.learn.training.zoo SCENE`; those of DAgger from a teacher who sat beside them, a
few lines of Python that solve the scene, by `python -m tests.learn.training.teach SCENE` in a
checkout.
Evaluated on seeds 0..99, which no training uses; a scene's own limit of steps holds.

| scene | learned by | steps | seed | success | 95% between | return | length |
|---|---|---|---|---|---|---|---|
"""


def make(scene: str, folder: Path) -> Evaluation | None:
    """Train, export and evaluate one network; return None if none was good enough."""
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
        if take(scene, file, told):
            return told
    return None


def take(scene: str, file: Path, told: Evaluation) -> bool:
    """Accept a network if it is good and small enough; return True if so."""
    good = told.success is None or told.success >= MIN_SUCCESS_SHARE
    if good and file.stat().st_size <= MAX_ZOO_NETWORK_BYTES:
        write_atomically(zoo.network_of(scene), file.read_bytes())
        return True
    return False


def tell() -> str:
    """Return the text of the folder's README.md, with every network evaluated anew."""
    return HEAD + "".join(f"{_line(name)}\n" for name in zoo.names()) + missing()


def missing() -> str:
    """Return a sentence on single-agent scenes without a network; empty if all have one."""
    alone = [name for name in Scene.names() if len(Scene.load(name).description.agents) == 1]
    without = [name for name in alone if name not in zoo.names()]
    return (
        f"\nThere is none for {', '.join(without)}; docs/training.md says why.\n" if without else ""
    )


def _line(name: str) -> str:
    import onnx

    entries = onnx.load(zoo.network_of(name)).metadata_props
    about: dict[str, Any] = json.loads(entries[0].value)
    told = evaluate(entrant(f"zoo:{name}"), Scene.load(name), range(EPISODES))
    _, *told_of = told.cells.values()
    cells = (name, about["algorithm"], about["steps"], about["seed"], *told_of)
    return f"| {' | '.join(map(str, cells))} |"


def main() -> int:
    """Train the named networks; ``--tell`` only evaluates those that exist."""
    names = [each for each in sys.argv[1:] if not each.startswith("-")]
    failed = []
    if "--tell" not in sys.argv:
        with tempfile.TemporaryDirectory() as folder:
            failed = [name for name in names if not make(name, Path(folder))]
    write_atomically(zoo.FOLDER / "README.md", tell())
    if failed:
        sys.stderr.write(f"not good enough: {', '.join(failed)}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
