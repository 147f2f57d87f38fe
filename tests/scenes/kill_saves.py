"""Saves that are killed in the middle: ``python -m tests.scenes.kill_saves --times 60``.

A process saves two scenes to one file in turn, as fast as it can, and is killed (SIGKILL) at any
moment. What is in the file then must be the one or the other, whole.
"""

import argparse
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from ai4u_edu.base.atomic_write import remove_leftovers
from ai4u_edu.scenes import Scene

PADDING_CHARS = 280_000
"""Length of a comment that makes writing the scene file slow enough to interrupt."""
SAVER = """
import sys
from pathlib import Path
from ai4u_edu.scenes import Scene
one, other, file = map(Path, sys.argv[1:])
scenes = []
for path in (one, other):
    scene = Scene.load("box_chase")
    scene.dumps = path.read_text().__str__
    scenes.append(scene)
print("saving", flush=True)
while True:
    for scene in scenes:
        scene.save(file)
"""


def run(times: int, seed: int = 1, saver: str = SAVER) -> list[str]:
    """Kill the process `times` times, and return what was wrong."""
    rng = random.Random(seed)
    wrong = []
    found: dict[str, int] = {}
    with tempfile.TemporaryDirectory() as folder:
        texts = {}
        for name in ("box_chase", "sample_scene"):
            text = Scene.load(name).dumps()
            padding = ("# " + "x" * 97 + "\n") * (PADDING_CHARS // 100)
            texts[name] = text + padding
            Path(folder, f"{name}.yaml").write_text(texts[name], encoding="utf-8")
        sources = [str(Path(folder, f"{name}.yaml")) for name in texts]
        file = Path(folder, "saved.yaml")
        Scene.load("box_chase").save(file)
        texts["before"] = file.read_text(encoding="utf-8")
        for number in range(times):
            before = file.stat().st_mtime_ns
            process = subprocess.Popen(
                [sys.executable, "-c", saver, *sources, str(file)],
                stdout=subprocess.PIPE,
                text=True,
            )
            with process:
                assert process.stdout is not None
                process.stdout.readline()
                while process.poll() is None and file.stat().st_mtime_ns == before:
                    time.sleep(0.001)  # real time: until the next look for its first save
                # real time: any moment after the first save is right
                time.sleep(rng.uniform(0.0, 0.15))
                if process.poll() is not None:
                    wrong.append(f"kill {number}: it had ended by itself")
                process.kill()
            saved = file.read_text(encoding="utf-8")
            name = next((name for name, text in texts.items() if text == saved), "")
            found[name] = found.get(name, 0) + 1
            if not name:
                wrong.append(f"kill {number}: {len(saved)} characters, of neither scene")
        remove_leftovers(Path(folder))
        names = {f"{name}.yaml" for name in ("saved", "box_chase", "sample_scene")}
        left = {path.name for path in Path(folder).iterdir()} - names
        wrong += [f"{name} is left for ever" for name in left]
        if not wrong:
            Scene.load(file)
    print(f"{times} kills; in the file was {found}")
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
