/** The position of viser's canvas in the window: its panels stand beside it and can be moved. */

/** Longest wait for the canvas to appear (ms). */
const MAX_WAIT_MS = 20_000;

/** Keep the canvas's distances from the window's sides in the CSS variables --ai4u-left, --ai4u-right and --ai4u-bottom. */
export function trackCanvasEdges() {
  const style = document.documentElement.style;
  const update = (/** @type {Element} */ canvas) => {
    const { left, right, bottom } = canvas.getBoundingClientRect();
    style.setProperty("--ai4u-left", `${Math.max(0, left)}px`);
    style.setProperty("--ai4u-right", `${Math.max(0, innerWidth - right)}px`);
    style.setProperty("--ai4u-bottom", `${Math.max(0, innerHeight - bottom)}px`);
  };
  const root = document.getElementById("root");
  const appeared = new MutationObserver(() => {
    const canvas = root.querySelector("canvas");
    if (canvas === null) return;
    appeared.disconnect();
    new ResizeObserver(() => update(canvas)).observe(canvas);
    addEventListener("resize", () => update(canvas));
  });
  appeared.observe(root, { childList: true, subtree: true });
  setTimeout(() => appeared.disconnect(), MAX_WAIT_MS);
}
