"""``submit``: hand a trained network in for a tournament of the class."""

import secrets
from pathlib import Path
from typing import TYPE_CHECKING

from ai4u_edu.base.errors import suggest
from ai4u_edu.lessons.class_membership import current_connection
from ai4u_edu.lessons.notebook_output import card, put

if TYPE_CHECKING:
    from ai4u_edu.wire.class_link import Network

CHECK_TIMEOUT_S = 60.0
"""Time for which the class's check is waited for; it goes on afterwards."""
NO_CLASS = (
    'You are in no class. Join it first: `join_class("http://ADDRESS", "CODE")` with the address '
    "and the code on the board, on a JupyterHub `join_class()`. Then run this cell again. Without "
    "a class, networks play each other with: ai4u-edu tournament SCENE ONE.onnx OTHER.onnx"
)


def submit(scene: str, network: str | Path, *, part: str = "") -> None:
    """Hand in a trained network for a tournament of your class; the latest one counts.

    The class lets it play a game against itself before it takes it, and says so if it can't play.
    Without a connection it is kept, and sent later.

    Args:
        scene: name of the tournament's scene, such as ``"sumo"``.
        network: its ONNX file, such as ``"policy.onnx"``.
        part: role or side that the network drives, such as ``"keeper"`` in soccer; empty if it
            drives all of your robots.
    """
    connection = current_connection()
    if connection is None:
        _tell("grey", "Not handed in.", NO_CLASS)
        return
    message, problem = _message(scene, Path(network), part)
    if message is None:
        _tell("vermillion", "Not handed in.", problem)
        return
    answer = connection.hand_in(message, CHECK_TIMEOUT_S)
    title = f"{message.file} for {scene}" + (f" ({part})" if part else "")
    if answer.refusal:
        _tell("vermillion", "Not taken.", f"{title}: {answer.refusal}")
    elif answer.is_checked:
        _tell("green", "Handed in.", f"{title} can play in the tournament. The latest one counts.")
    elif answer.is_stored:
        _tell(
            "blue", "Handed in.", f"{title} waits for its check. Run this cell again to hear more."
        )
    else:
        _tell("blue", "Kept.", f"{connection.client.problem} {title} is sent as soon as it can be.")


def _message(scene: str, path: Path, part: str) -> "tuple[Network | None, str]":
    """Return the message with a network, or a sentence on why there is none."""
    from ai4u_edu.scenes import Scene
    from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES, Network

    names = Scene.names()
    if scene not in names:
        return None, f"Expected the name of a scene, got {scene!r}; {suggest(scene, names)}."
    if path.suffix.lower() != ".onnx":
        return (
            None,
            f"Expected a network as an .onnx file, got {path.name!r}. A training writes one.",
        )
    try:
        data = path.read_bytes()
    except OSError as error:
        return None, f"{path} can't be read: {error.strerror}. Is it in this notebook's folder?"
    if not 0 < len(data) <= MAX_NETWORK_BYTES:
        limit = MAX_NETWORK_BYTES // 2**20
        return None, f"{path.name}: expected 1 byte to {limit} MB, got {len(data):,} bytes."
    return Network(secrets.token_urlsafe(12), scene, part, path.name[-100:], data), ""


def _tell(colour: str, sign: str, text: str) -> None:
    put(card(colour, sign, [text]), f"{sign} {text}")
