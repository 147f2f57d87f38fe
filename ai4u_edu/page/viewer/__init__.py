"""The page: snapshots drawn with viser, and its side panel."""

from ai4u_edu.page.viewer.viewer import Viewer

__all__ = ["Viewer"]
