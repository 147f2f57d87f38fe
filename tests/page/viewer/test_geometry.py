import math

import numpy as np
import pytest

from ai4u_edu import BoxShape, CapsuleShape, CircleShape, PolygonShape, SegmentShape
from ai4u_edu.page.viewer.scene.geometry import (
    Array,
    Mesh,
    band,
    cap,
    circle,
    flat_mesh,
    grow,
    join_meshes,
    prism,
    rotate,
    segments,
    soft_shadow,
)
from ai4u_edu.snapshot.marks import half_width

OUTLINES = {
    "circle": CircleShape(radius=0.4).outline(),
    "box": BoxShape(size=(2, 1)).outline(),
    "polygon": PolygonShape(vertices=((1, 0), (0, 1), (-1, 0), (0, -2))).outline(),
    "capsule": CapsuleShape(length=1, radius=0.3).outline(),
    "segment": SegmentShape(a=(2, -3), b=(2, 3)).outline(),
}


def normals(mesh: Mesh) -> Array:
    """Twice each triangle's area, along its normal."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def area(mesh: Mesh) -> float:
    """The area of a mesh as seen from above."""
    return float(normals(mesh)[:, 2].sum() / 2)


@pytest.mark.parametrize("name", OUTLINES)
def test_prisms_face_outwards(name: str) -> None:
    outline = np.array(OUTLINES[name])
    mesh = prism(outline, 1.0, 0.02)
    inside = np.array([*outline.mean(axis=0), 0.5])
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    outward = (normals(mesh) * (middles - inside)).sum(axis=1)
    assert (outward > 0).all()


@pytest.mark.parametrize("name", OUTLINES)
def test_prisms_have_a_side_an_edge_and_a_top(name: str) -> None:
    n = len(OUTLINES[name])
    mesh = prism(OUTLINES[name], 2.0, 0.02)
    assert len(mesh.vertices) == 2 * n + 2 * n + n
    assert len(mesh.faces) == 2 * n + 2 * n + (n - 2)
    assert mesh.vertices[:, 2].min() == 0.0
    assert mesh.vertices[:, 2].max() == 2.0


def test_a_flat_prism_keeps_its_shoulder_above_the_ground() -> None:
    mesh = prism(OUTLINES["box"], 0.05, 0.05)
    assert mesh.vertices[:, 2].min() == 0.0
    assert (normals(mesh) != 0).any(axis=1).all()


def test_from_above_a_prism_covers_its_outline() -> None:
    assert area(prism(OUTLINES["box"], 1.0, 0.05)) == pytest.approx(2.0)


def test_a_ring_has_a_hole() -> None:
    ring = flat_mesh(circle(2.0, corners=96), circle(1.0, corners=96))
    assert area(ring) == pytest.approx(math.pi * (4 - 1), rel=0.01)
    assert (normals(ring)[:, 2] > 0).all()
    assert np.linalg.norm(ring.vertices[:, :2], axis=1).min() == pytest.approx(1.0)


def test_outlines_grow_and_shrink_by_a_distance() -> None:
    assert grow(OUTLINES["circle"], 0.1)[:, 0].max() == pytest.approx(0.5, abs=1e-3)
    assert grow(OUTLINES["box"], -0.25).max(axis=0).tolist() == [0.75, 0.25]


def test_a_sharp_corner_grows_no_long_spike() -> None:
    needle = [(5.0, 0.0), (-5.0, 0.05), (-5.0, -0.05)]
    assert grow(needle, 0.1)[:, 0].max() < 6.0


@pytest.mark.parametrize(
    ("name", "expected"), [("circle", 0.4), ("box", 0.5), ("capsule", 0.3), ("segment", 0.1)]
)
def test_half_the_narrowest_width(name: str, expected: float) -> None:
    assert half_width(OUTLINES[name]) == pytest.approx(expected, abs=0.01)


def test_a_soft_shadow_is_a_pile_of_sheets_that_get_smaller() -> None:
    pile = soft_shadow(OUTLINES["circle"], 0.2, 0.05, 5)
    radii = [float(np.linalg.norm(outline, axis=1).max()) for outline, _ in pile]
    assert radii == sorted(radii, reverse=True)
    assert (radii[0], radii[-1]) == pytest.approx((0.5, 0.3), abs=0.01)
    assert [height for _, height in pile] == pytest.approx([0.0, 0.0125, 0.025, 0.0375, 0.05])


def test_joined_meshes_keep_their_triangles() -> None:
    parts = [cap(OUTLINES["box"]), cap(OUTLINES["circle"], 1.0).moved(5, 0)]
    whole = join_meshes(parts)
    assert area(whole) == pytest.approx(sum(area(part) for part in parts))


def test_a_band_between_equal_outlines_stands_upright() -> None:
    wall = band(OUTLINES["box"], 0.0, OUTLINES["box"], 1.0)
    assert np.allclose(normals(wall)[:, 2], 0)


def test_segments_close_the_outline() -> None:
    lines = segments(OUTLINES["box"], 2.0)
    assert lines.shape == (4, 2, 3)
    assert lines[-1, 1].tolist() == lines[0, 0].tolist()
    assert (lines[..., 2] == 2.0).all()


def test_turning_is_counter_clockwise() -> None:
    assert rotate(np.array([[1.0, 0.0]]), math.pi / 2)[0] == pytest.approx([0.0, 1.0])
