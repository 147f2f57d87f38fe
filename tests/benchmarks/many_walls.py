"""The cost of hundreds of walls on one spot: ``python -m tests.benchmarks.many_walls``.

Walls may overlap. An overlap with a new wall is searched among the bodies that can move; a query of
the space would return all other walls, too. Both ways are timed in turn, in one run.
"""

import time
from collections.abc import Callable
from typing import Any

from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.yaml.file import write_yaml
from ai4u_edu.world import World
from ai4u_edu.world.placement import is_overlap
from ai4u_edu.world.world import _level

WALLS = 499
TIMES = 3


def query(space_world: Any, body: Any) -> Any:
    """Search an overlap by a query of the space."""
    for shape in body._shapes:
        for hit in space_world.space.shape_query(shape):
            other = space_world.owners.get(hit.shape)
            if other is None or other is body or not (body.moves or other.moves):
                continue
            found = [point.distance for point in hit.contact_point_set.points]
            if _level(body, other) and is_overlap(shape, body._pm, hit.shape, other._pm, found):
                return other
    return None


def walls(count: int = WALLS) -> str:
    """Return the text of a scene with ``count`` bodies, nearly all of them walls in one place."""
    plain = Scene.load("box_chase").plain()
    plain["bodies"] = list(plain["bodies"])
    while len(plain["bodies"]) < count:
        wall = {"shape": {"type": "box", "size": [1, 1]}, "kind": "static", "position": [5, 5]}
        plain["bodies"].append({"name": f"wall {len(plain['bodies'])}", **wall})
    return write_yaml(plain)


def timed(text: str, way: Callable[[Any, Any], Any]) -> float:
    """Return the processor time (s) to load a scene, run 40 ticks, and dump it."""
    before = vars(World)["find_overlap"]
    setattr(World, "find_overlap", way)  # noqa: B010 - mypy: a method
    try:
        began = time.process_time()
        scene = Scene.loads(text)
        sim = scene.build()
        sim.reset(1)
        for _ in range(40):
            sim.tick()
        scene.dumps()
        return time.process_time() - began
    finally:
        setattr(World, "find_overlap", before)  # noqa: B010 - mypy: a method


def main() -> None:
    """Print the fastest run of both ways."""
    text = walls()
    both = [(timed(text, query), timed(text, World.find_overlap)) for _ in range(TIMES)]
    asked, now = (min(times) for times in zip(*both, strict=True))
    print(f"{WALLS} walls on one spot: load, 40 ticks, dump: {asked:.2f} s, now {now:.2f} s")


if __name__ == "__main__":
    main()
