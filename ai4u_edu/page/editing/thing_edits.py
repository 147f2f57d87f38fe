"""Bodies, floors and areas that are added, removed and changed in a running world."""

import math
from collections.abc import Callable, Mapping

from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    Pose,
    World,
    edit_body,
    insert_body,
    put_region,
    reorder,
    sampled_region,
)

AnyRegion = FloorDescription | AreaDescription
TOLERANCE_M = 1e-6
"""Distance below which a body counts as being where it belongs."""


class ThingEdits:
    """One transaction of changes to the things in a world; :meth:`undo` rolls it back.

    Args:
        world: the world of the things.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._undo_steps: list[Callable[[], object]] = []
        self.has_moved_back = False
        """True if :meth:`restore_poses` had to move a body."""

    def apply(
        self, old: SceneDescription, new: SceneDescription, poses: Mapping[str, Pose]
    ) -> bool:
        """Turn the things of one scene into those of another, and return True if any changed.

        Raises:
            WorldError: it is not possible; everything was rolled back.
        """
        before = {body.name: body for body in old.bodies}
        after = {body.name: body for body in new.bodies}
        try:
            self._apply_regions(old, new)
            for name in before:
                if name not in after:
                    self._remove(name)
            for name, body in after.items():
                if name not in before:
                    self._add(body, poses.get(name))
                elif body != before[name] or name in poses:
                    self._change(before[name], body, poses.get(name))
        except BaseException:
            self.undo()
            raise
        if self._undo_steps:
            reorder(self._world, [thing.name for thing in new.things])
        return bool(self._undo_steps)

    def undo(self) -> None:
        """Roll back all changes."""
        steps, self._undo_steps = self._undo_steps, []
        for step in reversed(steps):
            step()
        self._undo_steps = []  # undoing an edit adds an undo step of its own

    def restore_poses(self, poses: Mapping[str, Pose]) -> None:
        """Move bodies back to where a person put them, if the reset moved them.

        Randomization or an actuator may have done that.
        """
        for name, pose in poses.items():
            if name in self._world.bodies and self._distance(name, pose) > TOLERANCE_M:
                edit_body(self._world, self._world[name].description, pose)
                self.has_moved_back = True

    def pose(self, name: str) -> Pose:
        """Return the present pose of a body."""
        x, y, _, heading = self._world[name].pose
        return x, y, heading

    def _apply_regions(self, old: SceneDescription, new: SceneDescription) -> None:
        before = _regions(old)
        after = _regions(new)
        for name in dict.fromkeys((*before, *after)):
            if before.get(name) != after.get(name):
                self._change_region(name, before.get(name), after.get(name))

    def _change_region(self, name: str, old: AnyRegion | None, new: AnyRegion | None) -> None:
        """Add, change or remove a floor or an area; None stands for one that is not there."""
        world = self._world
        sampled_before = None if old is None else sampled_region(world, name)
        sampled = new
        if old is not None and new is not None and sampled_before is not None:
            here = (old.position, old.heading_deg, old.shape)
            if here == (new.position, new.heading_deg, new.shape):  # it stays where chance put it
                kept = ("position", "heading_deg", "shape")
                sampled = new.model_copy(update={k: getattr(sampled_before, k) for k in kept})
        put_region(world, name, new, sampled)
        self._undo_steps.append(lambda: put_region(world, name, old, sampled_before))

    def _distance(self, name: str, pose: Pose) -> float:
        return math.dist(self.pose(name)[:2], pose[:2])

    def _add(self, body: BodyDescription, pose: Pose | None) -> None:
        if pose is None:
            insert_body(self._world, body)
        else:
            here = {"position": pose[:2], "heading_deg": math.degrees(pose[2]), "random": None}
            insert_body(self._world, body.model_copy(update=here))
            edit_body(self._world, body, pose)
        self._undo_steps.append(lambda: self._world.remove(body.name))

    def _remove(self, name: str) -> None:
        body, pose = self._world[name].description, self.pose(name)
        self._world.remove(name)
        self._undo_steps.append(lambda: self._add(body, pose))

    def _change(self, old: BodyDescription, new: BodyDescription, pose: Pose | None) -> None:
        pose_before = self.pose(new.name)
        place_before = (old.position, old.heading_deg, old.z)
        if pose is None and place_before != (new.position, new.heading_deg, new.z):
            pose = (*new.position, math.radians(new.heading_deg))
        edit_body(self._world, new, pose)
        self._undo_steps.append(lambda: edit_body(self._world, old, pose_before))


def _regions(scene: SceneDescription) -> dict[str, AnyRegion]:
    """Return a scene's floors and areas by name."""
    regions: tuple[AnyRegion, ...] = (*scene.floors, *scene.areas)
    return {region.name: region for region in regions}
