"""Scenes: worlds and their agents as data and files."""

from ai4u_edu.scenes.description import SceneDescription
from ai4u_edu.scenes.scene import Scene

__all__ = ["Scene", "SceneDescription"]
