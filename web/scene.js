/** Which part of the window the world has: viser's panels stand beside it, and can be moved. */

/** How long the world may take to appear (ms). */
const PATIENCE = 20_000;

/** Tells the styles how far the world's edges are from the window's: --ai4u-left and --ai4u-right. */
export function followScene() {
  const style = document.documentElement.style;
  const tell = (canvas) => {
    const { left, right } = canvas.getBoundingClientRect();
    style.setProperty("--ai4u-left", `${Math.max(0, left)}px`);
    style.setProperty("--ai4u-right", `${Math.max(0, innerWidth - right)}px`);
  };
  const root = document.getElementById("root");
  const appeared = new MutationObserver(() => {
    const canvas = root.querySelector("canvas");
    if (canvas === null) return;
    appeared.disconnect();
    new ResizeObserver(() => tell(canvas)).observe(canvas);
    addEventListener("resize", () => tell(canvas));
  });
  appeared.observe(root, { childList: true, subtree: true });
  setTimeout(() => appeared.disconnect(), PATIENCE);
}
