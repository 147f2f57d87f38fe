"""The 3D scene of a page: ground, bodies, sensor overlays, camera and drag handles."""
