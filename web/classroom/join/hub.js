/** A student's page of a class at a JupyterHub: the name in the class, and the way to the own notebooks. */

const find = (selector) => document.querySelector(selector);
const UNREACHABLE = "The class can't be reached. Reload in a moment.";

try {
  const answer = await fetch("./api/me", { cache: "no-store" });
  if (answer.status === 401) location.reload(); // the sign-in has run out: the page asks for it again
  const told = await answer.json();
  if (answer.ok) show(told);
  else find("#problem").textContent = told.problem;
} catch {
  find("#problem").textContent = UNREACHABLE;
}

function show({ name, colour, notebooks, world }) {
  find("#name").textContent = name;
  find(".ai4u-dot").style.background = colour;
  find("#notebooks").href = notebooks;
  find("#world").href = world;
  find("#self").hidden = find("#ways").hidden = false;
}
