/** viser's own notices in the page's language. */

import { pageCatalogue, t } from "../shared/text.js";

/** @type {Record<string, string>} */
const WORDS = {
  "Could not detect browser version": t("Could not detect browser version"),
  "Your browser version could not be detected. It may not be supported.": t("Your browser version could not be detected. It may not be supported."),
  "Unsupported browser": t("Unsupported browser"),
  "WebGL unavailable": t("WebGL unavailable"),
  "WebGL is unavailable. This may be caused by hardware acceleration being disabled — check your browser settings.": t("WebGL is unavailable. This may be caused by hardware acceleration being disabled — check your browser settings."),
  "Connection rejected": t("Connection rejected"),
  "That didn't work": t("That didn't work"),
};
const OUTDATED = /^Your browser \((.{1,80})\) is outdated, which may cause problems\. Consider updating\.$/;
const NOTICES = ".mantine-Notifications-root";

/**
 * Return a text of viser in the page's language.
 * @param {string} text
 */
export function viserText(text) {
  const browser = OUTDATED.exec(text)?.[1];
  if (browser) return t("Your browser ({browser}) is outdated, which may cause problems. Consider updating.", { browser });
  return Object.hasOwn(WORDS, text) ? WORDS[text] : text;
}

/** Translate the notices that viser shows, from now on. */
export function translateNotices() {
  if (pageCatalogue().language === "en") return;
  const notices = new MutationObserver((changes) => changes.flatMap(({ addedNodes }) => [...addedNodes]).forEach(translate));
  // viser makes the lists of its notices once, with all else; later it changes much that is none
  const begin = () => {
    const lists = document.querySelectorAll(NOTICES);
    if (lists.length) waiting.disconnect();
    for (const list of lists) {
      translate(list);
      notices.observe(list, { childList: true, subtree: true });
    }
  };
  const waiting = new MutationObserver(begin);
  waiting.observe(document.body, { childList: true, subtree: true });
  begin();
}

/** @param {Node} node */
function translate(node) {
  const walker = document.createTreeWalker(node, NodeFilter.SHOW_TEXT);
  for (let text = walker.nextNode(); text; text = walker.nextNode()) {
    const translated = viserText(text.nodeValue ?? "");
    if (translated !== text.nodeValue) text.nodeValue = translated; // the node stays viser's
  }
}
