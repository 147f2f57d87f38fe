/** Accessible names for controls that viser leaves without one, for screen readers. */

/** Shortest time between two passes over the page (ms): panels change several times a second. */
const MIN_PASS_MS = 400;
/** Names of icon-only buttons, by a selector of the icon or of the button. */
const ICON_BUTTON_NAMES = {
  ".tabler-icon-adjustments": "Connection and diagnostics",
  ".tabler-icon-arrow-back": "Back to the panel",
  ".tabler-icon-list-search": "Commands",
  ".mantine-Notification-closeButton": "Dismiss",
};

let timer = 0;

new MutationObserver(() => (timer ||= setTimeout(nameAll, MIN_PASS_MS))).observe(document.body, {
  childList: true,
  subtree: true,
});
nameAll();

function nameAll() {
  timer = 0;
  for (const label of document.querySelectorAll("#root label[for], .mantine-Modal-content label[for]")) {
    const row = label.closest(".mantine-Flex-root");
    for (const box of row?.querySelectorAll("input:not([type=hidden]), textarea, [role=slider]") ?? []) {
      if (!box.labels?.length) setName(box, label.textContent);
    }
  }
  for (const file of document.querySelectorAll("#root input[type=file]")) {
    setName(file, file.parentElement.querySelector("button")?.textContent);
  }
  for (const [selector, text] of Object.entries(ICON_BUTTON_NAMES)) {
    for (const found of document.querySelectorAll(selector)) {
      const button = found.closest("button");
      if (!button?.textContent.trim()) setName(button, text);
    }
  }
}

function setName(target, text) {
  // compared each time: viser may reuse the element for another control
  if (target && text && target.ariaLabel !== text) target.ariaLabel = text;
}
