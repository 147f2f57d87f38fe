"""Plays a file again, in a process of its own, and tells the digest of all that was sensed."""

import hashlib
import struct
import sys

from ai4u_edu.recording import Episode, Replay


def digest(episode: Episode) -> str:
    """Return a hash of every percept, pose, action and reward of every agent."""
    found = hashlib.sha256()
    replay = Replay(episode)
    assert replay.verdict.exact, replay.verdict.why
    for agent in episode.ids:
        for moment in replay.moments(agent):
            found.update(moment.percept.data)
            for body in moment.snapshot.bodies:
                found.update(
                    struct.pack("<6d", body.x, body.y, body.z, body.heading, body.vx, body.vy)
                )
            found.update(repr((moment.decision.action, moment.decision.reward_terms)).encode())
    return found.hexdigest()


if __name__ == "__main__":
    print(digest(Episode.load(sys.argv[1])))
