/** viser's panel on small screens: it lies at the bottom, starts expanded and hides the world. */

/** Longest wait for the panel to appear (ms). */
const MAX_WAIT_MS = 20_000;

/** Windows that have a bottom panel. In wider ones the search below would cost 0.1 s of style computation. */
const SMALL_SCREEN = "(max-width: 60em)";

/** Collapse the bottom panel once, if there is one; a tap on its handle expands it again. */
export function collapseMobilePanel() {
  if (!matchMedia(SMALL_SCREEN).matches) return;
  const observer = new MutationObserver(() => {
    const panel = [...document.querySelectorAll("#root .mantine-Paper-root")].find((paper) => {
      const style = getComputedStyle(paper);
      return style.position === "fixed" && style.bottom === "0px";
    });
    const handle = [...(panel?.querySelectorAll("div") ?? [])].find(
      (part) => part.style.cursor === "pointer",
    );
    if (!handle) return;
    observer.disconnect();
    handle.click();
  });
  observer.observe(document.getElementById("root"), { childList: true, subtree: true });
  setTimeout(() => observer.disconnect(), MAX_WAIT_MS);
}
