"""The page: draws snapshots with viser, hands on what people ask for."""

from ai4u_edu.viewer.viewer import Viewer

__all__ = ["Viewer"]
