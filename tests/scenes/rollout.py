"""One long drive through a scene, as bytes; also run as a process of its own."""

import hashlib
import struct
import sys

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.check.rollout import RandomDrive


def trajectory(name: str, seed: int, decisions: int = 300) -> str:
    """The digest of every pose and percept of a drive by a seeded random driver."""
    sim = Scene.load(name).build()
    for number, agent in enumerate(sim.agents):
        drive = RandomDrive(agent)
        drive.restart(seed + number)
        agent.use_brain(LocalBrain(controller=drive))
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
    for name in sys.argv[2:]:
        print(name, trajectory(name, int(sys.argv[1])))
