"""Bodies that come, go and are changed in a running world."""

import math
from collections.abc import Callable, Mapping

from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import BodyDescription, Pose, World, edit_body, insert_body, reorder

NEAR = 1e-6
"""Bodies closer to where they belong than this (m) are there."""


class Furniture:
    """The bodies of a world.

    Args:
        world: theirs.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._undo: list[Callable[[], object]] = []
        self.is_astray = False
        """Whether something had to be put elsewhere than where its episode began."""

    def rearrange(
        self, old: SceneDescription, new: SceneDescription, places: Mapping[str, Pose]
    ) -> bool:
        """Makes those of one scene out of those of another; whether anything was done.

        Raises:
            WorldError: it can't be; then all is as it was.
        """
        before = {body.name: body for body in old.bodies}
        after = {body.name: body for body in new.bodies}
        try:
            for name in before:
                if name not in after:
                    self._remove(name)
            for name, body in after.items():
                if name not in before:
                    self._add(body, places.get(name))
                elif body != before[name] or name in places:
                    self._change(before[name], body, places.get(name))
        except BaseException:
            self.undo()
            raise
        if self._undo:
            reorder(self._world, [thing.name for thing in new.things])
        return bool(self._undo)

    def undo(self) -> None:
        """All as it was."""
        undo, self._undo = self._undo, []
        for step in reversed(undo):
            step()
        self._undo = []  # each of these steps could be taken back in turn

    def put_where_they_belong(self, places: Mapping[str, Pose]) -> None:
        """After a reset: chance, or an actuator, may have put elsewhere what a person placed."""
        for name, pose in places.items():
            if name in self._world.bodies and math.dist(self.pose(name)[:2], pose[:2]) > NEAR:
                edit_body(self._world, self._world[name].description, pose)
                self.is_astray = True

    def pose(self, name: str) -> Pose:
        """Where a body is now."""
        x, y, _, heading = self._world[name].pose
        return x, y, heading

    def _add(self, body: BodyDescription, pose: Pose | None) -> None:
        if pose is None:
            insert_body(self._world, body)
        else:
            here = {"position": pose[:2], "heading_deg": math.degrees(pose[2]), "random": None}
            insert_body(self._world, body.model_copy(update=here))
            edit_body(self._world, body, pose)
        self._undo.append(lambda: self._world.remove(body.name))

    def _remove(self, name: str) -> None:
        body, pose = self._world[name].description, self.pose(name)
        self._world.remove(name)
        self._undo.append(lambda: self._add(body, pose))

    def _change(self, old: BodyDescription, new: BodyDescription, pose: Pose | None) -> None:
        was = self.pose(new.name)
        if pose is None and (old.position, old.heading_deg, old.z) != (
            new.position,
            new.heading_deg,
            new.z,
        ):
            pose = (*new.position, math.radians(new.heading_deg))
        edit_body(self._world, new, pose)
        self._undo.append(lambda: edit_body(self._world, old, was))
