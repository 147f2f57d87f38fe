"""Networks that come with the package, one a scene: ``ai4u-edu play SCENE --brain zoo``.

Each was made by ``python -m ai4u_edu.training.zoo``, which trains, evaluates and exports.
"""

from pathlib import Path

FOLDER = Path(__file__).parent


def names() -> list[str]:
    """The scenes for which there is a network."""
    return sorted(path.stem for path in FOLDER.glob("*.onnx"))


def network_of(scene: str) -> Path:
    """Where a scene's network is, or would be."""
    return FOLDER / f"{scene}.onnx"
