/** The page on which a student joins a class. */

import { element, find } from "../../shared/dom.js";
import { chosenIn } from "../../shared/form_dialog.js";
import { randomId } from "../../shared/ids.js";
import { t } from "../../shared/text.js";

const code = /** @type {HTMLInputElement} */ (find("#code"));
const join = /** @type {HTMLButtonElement} */ (find("#join"));
const problem = find("#problem");

/** True if a seat of another device will be used here, too. */
let isMoving = false;

const given = new URLSearchParams(location.search).get("code");
if (given) code.value = given; // else what was typed already stays
find("#move").addEventListener("click", () => moveHere(!isMoving));
find("#others").addEventListener("click", showNames);
find("form").addEventListener("submit", (event) => {
  event.preventDefault();
  sendRequest();
});
showNames();
if (given) join.focus();

/**
 * Ask for the code that another device shows, in place of the class's code and a name.
 * @param {boolean} isMove
 */
function moveHere(isMove) {
  isMoving = isMove;
  find("#code-label").textContent = isMove ? t("Code on your other device") : t("Code on the board");
  find("#choice").hidden = isMove;
  find("#move-note").hidden = !isMove;
  find("#move").textContent = isMove ? t("Join with the code on the board") : t("Continue from another device");
  join.textContent = isMove ? t("Continue") : t("Join");
  problem.textContent = "";
  code.value = isMove ? "" : (given ?? "");
  code.focus();
}

async function showNames() {
  try {
    const { names } = await (await fetch("./api/names", { cache: "no-store" })).json();
    find("#names").replaceChildren(...names.map(nameChoice));
  } catch {
    problem.textContent = t("The class can't be reached. Is this device in the right network?");
  }
}

/**
 * @param {string} name
 * @param {number} index
 */
function nameChoice(name, index) {
  return element(
    "label",
    {},
    element("input", { type: "radio", name: "name", value: name, checked: index === 0 }),
    element("span", { textContent: name }),
  );
}

async function sendRequest() {
  join.disabled = true;
  problem.textContent = "";
  const name = isMoving ? "" : chosenIn(find("#names"));
  try {
    const answer = await fetch("./api/join", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ code: code.value, name, request: requestId() }),
    });
    const told = await answer.json();
    if (answer.ok) {
      location.assign(told.room);
      return;
    }
    problem.textContent = told.problem;
    if (answer.status === 409) await showNames();
  } catch {
    problem.textContent = t("The class can't be reached. Is this device in the right network?");
  }
  join.disabled = false;
}

/** Return an id that stays the same if the request is repeated: the answer may have got lost. */
function requestId() {
  const key = "ai4u-join-request";
  try {
    const known = sessionStorage.getItem(key) ?? randomId();
    sessionStorage.setItem(key, known);
    return known;
  } catch {
    return randomId(); // storage is blocked here
  }
}
