"""Trained networks in the package, one for each scene: ``ai4u-edu play SCENE --brain zoo``.

Each was made by ``python -m ai4u_edu.learn.training.zoo``, which trains, evaluates and exports.
"""

from pathlib import Path

FOLDER = Path(__file__).parent


def names() -> list[str]:
    """Return the names of the scenes that have a network."""
    return sorted(path.stem for path in FOLDER.glob("*.onnx"))


def network_of(scene: str) -> Path:
    """Return the path of a scene's network, which need not exist."""
    return FOLDER / f"{scene}.onnx"
