"""Pictures a second that a page draws while A is held: ``python -m tests.benchmarks.picture_rate``.

The page counts the frames in which WebGL draws, in headless Chromium without a graphics chip. It is
loaded several times, since it begins with the resolution that it found the last time.
"""

import argparse

from tests.chromium import browser
from tests.playing import played

COUNT = """
window.drawn = 0;
let isDrawn = false;
for (const name of ["drawElements", "drawElementsInstanced", "drawArrays", "drawArraysInstanced"]) {
  const draw = WebGL2RenderingContext.prototype[name];
  WebGL2RenderingContext.prototype[name] = function (...given) {
    isDrawn = true;
    return draw.apply(this, given);
  };
}
(function count() {
  window.drawn += isDrawn;
  isDrawn = false;
  requestAnimationFrame(count);
})();
"""
SIZE = """() => {
  const { width, height } = document.querySelector("canvas[data-engine]");
  return `${width}x${height}`;
}"""


def main() -> None:
    """Run the benchmark and print a line for each load."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--size", default="1366x768")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--loads", type=int, default=3)
    parser.add_argument("--camera", default="", help="name of its button; default: the first one")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    with played(options.scene, "--seed", "1") as server, browser() as chromium:
        page = chromium.new_page(viewport={"width": width, "height": height})
        page.add_init_script(COUNT)
        page.set_default_timeout(180_000)
        for load in range(options.loads):
            page.goto(server.url)
            page.locator(".ai4u-cameras button").first.wait_for()
            page.wait_for_timeout(5000)
            if options.camera:
                page.get_by_role("button", name=options.camera, exact=True).click()
                page.wait_for_timeout(3000)
            page.keyboard.down("KeyA")  # the robot turns in place, and so never falls
            page.wait_for_timeout(1000)
            before = page.evaluate("[drawn, performance.now()]")
            page.wait_for_timeout(1000 * options.seconds)
            after = page.evaluate("[drawn, performance.now()]")
            page.keyboard.up("KeyA")
            rate = 1000 * (after[0] - before[0]) / (after[1] - before[1])
            print(f"load {load + 1}: {rate:.1f} pictures a second, {page.evaluate(SIZE)} pixels")


if __name__ == "__main__":
    main()
