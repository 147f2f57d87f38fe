"""One long drive through a scene, as bytes; also run as a process of its own."""

import hashlib
import struct
import sys
from typing import Any

import numpy as np

from ai4u_edu import LocalBrain, Scene


def trajectory(name: str, seed: int, decisions: int = 300) -> str:
    """The digest of every pose and percept of a drive by a seeded random driver."""
    chance = np.random.default_rng(seed)
    sim = Scene.load(name).build()

    def wander(_percept: Any) -> dict[str, Any]:
        return {"move": chance.uniform([-1, -1, 0, 0], 1).tolist()}

    for agent in sim.agents:
        agent.use_brain(LocalBrain(controller=wander))
    sim.reset(seed)
    digest = hashlib.sha256()
    for _ in range(decisions):
        percept = sim.step()
        for body in sim.world.bodies.values():
            digest.update(struct.pack("<6d", *body.pose, *body.velocity))
        digest.update(percept.data)
        digest.update(struct.pack("<d", sim.agents[0].reward))
        if sim.agents[0].done:
            sim.reset()
    return digest.hexdigest()


if __name__ == "__main__":
    print(trajectory(sys.argv[1], int(sys.argv[2])))
