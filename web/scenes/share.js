/**
 * Sharing by link: a link to this page holds the whole scene after its "#", which no browser sends to a server.
 */

import { element } from "../shared/dom.js";
import { ask, tell } from "../shared/dialog.js";
import { t } from "../shared/text.js";
import { programIn, withoutProgram, withProgram } from "./program_link.js";
import { request, unsavedSentence } from "./api.js";
import { keepShared } from "./shared_program.js";

const PREFIX = "#scene=";
const BRINGS_PROGRAM = t("It contains a program, which the tab “Code” offers you. It does not run by itself.");
const ONLY_HERE = t("In a browser it opens on this computer only. To give the scene to someone else, send its file (World, Download).");
let isAsking = false;

/**
 * Copy a link to the present scene and its seed; where the browser does not allow it, show the link.
 *
 * @param {{agent: string, source: string}} [program] that the link shall bring along
 * @returns {Promise<string>} a sentence about what happened, to be shown to a person
 */
export async function copyLink(program = null) {
  let made;
  try {
    made = await request("api/scene/link");
    if (program !== null) made.fragment = await withProgram(made.fragment, program);
  } catch (error) {
    return error.message;
  }
  const link = new URL(`./#${made.fragment}`, location.href.replace(/[?#].*/, "")).href;
  const needs = made.needs.length ? t("It needs this too, which a link can't carry: {names}.", { names: made.needs.join(", ") }) : "";
  try {
    await navigator.clipboard.writeText(link);
  } catch {
    await showLink(made.title, link); // no secure page, or in a frame that may not copy
    return sentences(t("Here is the link."), needs);
  }
  return sentences(t("Link copied."), isThisComputer() && ONLY_HERE, needs);
}

/** Return true if the page's address leads to its world from this computer only. */
export function isThisComputer() {
  return /^(localhost|127(\.\d+){3}|\[::1\])$/.test(location.hostname);
}

/**
 * @param {string} title of the scene
 * @param {string} link
 */
async function showLink(title, link) {
  const box = element("textarea", { readOnly: true, value: link, ariaLabel: t("Link"), spellcheck: false });
  box.addEventListener("focus", () => box.select());
  const answered = ask({
    title: t("Link to “{title}”", { title }),
    text: sentences(t("Select the link and copy it (Ctrl+C, or ⌘C)."), isThisComputer() && ONLY_HERE),
    yes: t("Close"),
    no: "",
    content: [box],
  });
  box.focus();
  await answered;
}

/**
 * Ask whether to open the scene in this page's address, now and whenever another link is put there.
 *
 * @param {() => void} [onopen] called after the scene was opened
 */
export function watchSharedScene(onopen = () => {}) {
  const look = (/** @type {string} */ fragment) => fragment.startsWith(PREFIX) && offerSharedScene(fragment, onopen);
  addEventListener("hashchange", () => look(location.hash));
  look(document.documentElement.dataset.ai4uFragment || location.hash);
}

/**
 * @param {string} link
 * @param {() => void} onopen
 */
async function offerSharedScene(link, onopen) {
  if (isAsking) return;
  isAsking = true;
  // so that reloading the page, or a bookmark of it, does not ask again
  history.replaceState(history.state, "", location.pathname + location.search);
  try {
    const program = await programIn(link);
    const { title, name } = await request("api/scene/link", { link: withoutProgram(link) });
    const text = sentences(program && BRINGS_PROGRAM, await unsavedSentence());
    if (await ask({ title: t("Open the shared scene “{title}”?", { title }), text, yes: t("Open") })) {
      await request("api/scene", { link: withoutProgram(link) });
      if (program !== null) keepShared({ scene: name, ...program });
      onopen();
    }
  } catch (error) {
    await tell(t("The shared scene can't be opened"), error.message);
  } finally {
    isAsking = false;
  }
}

/**
 * Return sentences as one text.
 * @param {(string | false | null)[]} parts what is empty, false or null is left out
 */
function sentences(...parts) {
  return parts.filter(Boolean).join(" ");
}
