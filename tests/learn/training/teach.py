"""Makes networks that learn from a teacher: ``python -m tests.learn.training.teach SCENE ...``.

Each learns by DAgger, as its settings say; it is evaluated on 100 seeds that no lesson used, and
taken if it is good enough. What falls short learns once more from another seed; ``--seed N`` begins
with another one.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from ai4u_edu import Scene
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.learn.training.dagger import imitate
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.settings import settings_for
from ai4u_edu.learn.training.zoo import EPISODES, TRIES, take, tell
from tests.learn.training.teachers import teacher_of


def make(scene: str, folder: Path, seeds: range) -> bool:
    """Teaches, evaluates, and takes what is good enough."""
    loaded = Scene.load(scene)
    for seed in seeds:
        file = imitate(
            lambda: teacher_of(scene),
            loaded,
            folder / f"{scene}.onnx",
            settings_for(scene).dagger,
            seed=seed,
        )
        told = evaluate(entrant(str(file)), loaded, range(EPISODES))
        kilobytes = file.stat().st_size / 1000
        sys.stderr.write(f"{scene}, seed {seed}, {kilobytes:.0f} kB\n{told}\n")
        if take(scene, file, told):
            return True
    return False


def main() -> int:
    """Makes those that are named."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--tries", type=int, default=TRIES)
    chosen = parser.parse_args()
    seeds = range(chosen.seed, chosen.seed + chosen.tries)
    with tempfile.TemporaryDirectory() as folder:
        failed = [name for name in chosen.scenes if not make(name, Path(folder), seeds)]
    (zoo.FOLDER / "README.md").write_text(tell(), encoding="utf-8")
    if failed:
        sys.stderr.write(f"not good enough: {', '.join(failed)}\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
