/** viser's panel on small screens: a sheet at the bottom, which begins open and hides the world. */

/** How long it may take to appear (ms). */
const PATIENCE = 20_000;

/** A wider window has no sheet, and asking for styles at each change costs it a tenth of a second. */
const SMALL = "(max-width: 60em)";

/** Folds the sheet once, if there is one; a tap on its handle opens it again. */
export function foldSheet() {
  if (!matchMedia(SMALL).matches) return;
  const observer = new MutationObserver(() => {
    const sheet = [...document.querySelectorAll("#root .mantine-Paper-root")].find((paper) => {
      const style = getComputedStyle(paper);
      return style.position === "fixed" && style.bottom === "0px";
    });
    const handle = [...(sheet?.querySelectorAll("div") ?? [])].find(
      (part) => part.style.cursor === "pointer",
    );
    if (!handle) return;
    observer.disconnect();
    handle.click();
  });
  observer.observe(document.getElementById("root"), { childList: true, subtree: true });
  setTimeout(() => observer.disconnect(), PATIENCE);
}
