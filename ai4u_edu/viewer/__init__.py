"""The page: draws snapshots with viser, and sends what people do to the runner and the editor."""

from ai4u_edu.viewer.viewer import Viewer

__all__ = ["Viewer"]
