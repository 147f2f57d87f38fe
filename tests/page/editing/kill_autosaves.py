"""Autosaves that are killed in the middle.

``python -m tests.page.editing.kill_autosaves --times 60``

A process changes a scene as fast as it can, and is killed (SIGKILL) at any moment. What is offered
then must be one of the states that the scene was in, whole.
"""

import argparse
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ai4u_edu.page.editing.autosave import Autosave, latest

SAVER = """
import sys
import time
from pathlib import Path
from ai4u_edu import Scene
from ai4u_edu.page.editing import EditState, autosave
autosave.WRITE_DELAY_S = autosave.MAX_WRITE_DELAY_S = 0.0
scene = Scene.load("soccer")
saver = autosave.Autosave(Path(sys.argv[1]), "soccer")
print("saving", flush=True)
number = 0
while True:
    number += 1
    fields = {"goal": f"{number} " * 100, "title": str(number)}
    saver.schedule(EditState(scene.description.model_copy(update=fields)))
    time.sleep(0.0005)
"""


def run(times: int, seed: int = 1, saver: str = SAVER) -> list[str]:
    """Kill the process `times` times, and return what was wrong."""
    rng = random.Random(seed)
    wrong, found = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for number in range(times):
            before = set(folder.glob("*.unsaved"))
            with subprocess.Popen(
                [sys.executable, "-c", saver, name], stdout=subprocess.PIPE, text=True
            ) as process:
                assert process.stdout is not None
                process.stdout.readline()
                while process.poll() is None and set(folder.glob("*.unsaved")) <= before:
                    time.sleep(0.001)  # real time: until the next look for its file
                # real time: any moment after the first write is right
                time.sleep(rng.uniform(0.0, 0.15))
                if process.poll() is not None:
                    wrong.append(f"kill {number}: it had ended by itself")
                process.kill()
            unsaved = latest(folder)
            if unsaved is None:
                wrong.append(f"kill {number}: what is there can't be read")
                continue
            description = unsaved.scene().description
            if description.goal != f"{description.title} " * 100:
                wrong.append(f"kill {number}: of two states")
            found += 1
        Autosave(folder, "soccer").stop()  # the next start
        left = [path.name for path in folder.iterdir() if path.suffix != ".unsaved"]
        wrong += [f"{name} is left for ever" for name in left]
    print(f"{times} kills; {found} times there was something, {len(wrong)} times not whole")
    return wrong


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    wrong = run(options.times, options.seed)
    print("\n".join(wrong) or "never half written")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
