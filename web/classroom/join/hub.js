/** A student's page of a class at a JupyterHub: the name in the class, and the way to the own notebooks. */

import { find } from "../../shared/dom.js";
import { t } from "../../shared/text.js";

const UNREACHABLE = t("The class can't be reached. Reload in a moment.");

try {
  const answer = await fetch("./api/me", { cache: "no-store" });
  if (answer.status === 401) location.reload(); // the sign-in has run out: the page asks for it again
  const told = await answer.json();
  if (answer.ok) show(told);
  else find("#problem").textContent = told.problem;
} catch {
  find("#problem").textContent = UNREACHABLE;
}

/** @param {{name: string, colour: string, notebooks: string, world: string}} student with the addresses of notebooks and world */
function show({ name, colour, notebooks, world }) {
  find("#name").textContent = name;
  find(".ai4u-dot").style.background = colour;
  find("#notebooks").setAttribute("href", notebooks);
  find("#world").setAttribute("href", world);
  find("#self").hidden = find("#ways").hidden = false;
}
