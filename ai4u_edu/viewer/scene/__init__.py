"""The drawn world: bodies, sensors, overlays, handles."""
