/** Names for what viser leaves without one, so that a screen reader can say what it is. */

/** Milliseconds between two looks; a panel changes several times a second. */
const PACE = 400;
/** What a button with nothing but a picture does, by a class of the picture or the button. */
const PICTURES = {
  ".tabler-icon-adjustments": "Connection and diagnostics",
  ".tabler-icon-arrow-back": "Back to the panel",
  ".tabler-icon-list-search": "Commands",
  ".mantine-Notification-closeButton": "Dismiss",
};

let timer = 0;

new MutationObserver(() => (timer ||= setTimeout(nameAll, PACE))).observe(document.body, {
  childList: true,
  subtree: true,
});
nameAll();

function nameAll() {
  timer = 0;
  for (const label of document.querySelectorAll("#root label[for], .mantine-Modal-content label[for]")) {
    const row = label.closest(".mantine-Flex-root");
    for (const box of row?.querySelectorAll("input:not([type=hidden]), textarea, [role=slider]") ?? []) {
      if (!box.labels?.length) name(box, label.textContent);
    }
  }
  for (const file of document.querySelectorAll("#root input[type=file]")) {
    name(file, file.parentElement.querySelector("button")?.textContent);
  }
  for (const [where, text] of Object.entries(PICTURES)) {
    for (const picture of document.querySelectorAll(where)) {
      const button = picture.closest("button");
      if (!button?.textContent.trim()) name(button, text);
    }
  }
}

function name(part, text) {
  // viser may use the same element for something else later
  if (part && text && part.ariaLabel !== text) part.ariaLabel = text;
}
