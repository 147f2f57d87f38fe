/** Requests about the scene that runs. Addresses are relative: the page may be served below a path. */

import { t } from "../shared/text.js";

/**
 * Request JSON.
 *
 * @param {string} path relative to the page
 * @param {object} [body] sent by POST
 * @throws {Error} with the server's sentence, to be shown to a person
 */
export async function request(path, body) {
  const options = body && {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  };
  let answer;
  try {
    answer = await fetch(path, options);
  } catch {
    throw new Error(t("The world can't be reached. Is it still running?"));
  }
  if (answer.ok) return answer.json();
  if (answer.status === 404) throw new Error(t("The scene of this world can't be changed or shared from here."));
  throw new Error((await answer.text()).trim());
}

/** Return where the changes of the present scene are kept, as a sentence; empty if there are none to keep. */
export async function unsavedSentence() {
  const { is_changed: isChanged, is_autosaved: isAutosaved } = await request("api/scene");
  if (!isChanged) return "";
  return isAutosaved
    ? t("Your scene is kept; find it under Unsaved.")
    : t("Your scene has changes that are not saved. Undo brings it back.");
}
