/** The teacher's page: how to join, and who is here. */

import { element, keyed, setText } from "./dom.js";
import { ask, tell } from "./question.js";

const POLL_MS = 1000;
const find = (selector) => document.querySelector(selector);
/** Sentences by a seat's state; "in" needs none. */
const STATES = { left: "left", kicked: "sent out; may join again", banned: "may not come back" };
let isOpen = true;

find("#new-code").addEventListener("click", async () => {
  const text = "Students who are here stay. Whoever comes later needs the new code.";
  if (await ask({ title: "A new code?", text, yes: "New code" })) await send({ do: "new code" });
});
find("#open").addEventListener("click", () => send({ do: isOpen ? "close" : "open" }));
poll();

async function poll() {
  await refresh();
  setTimeout(poll, POLL_MS);
}

async function refresh() {
  try {
    const answer = await fetch("./teacher/state", { cache: "no-store" });
    if (answer.status === 401) location.reload(); // asks for the token
    show(await answer.json());
    setText(find("#status"), "");
  } catch {
    setText(find("#status"), "The class can't be reached. Is its program still running? This page tries again.");
  }
}

function show(state) {
  isOpen = state.open;
  setText(find("#address"), state.address);
  setText(find("#code"), state.code);
  if (find("#qr").src !== state.qr) find("#qr").src = state.qr;
  find("#open").setAttribute("aria-pressed", String(!isOpen));
  const here = state.seats.filter((seat) => seat.state === "in");
  setText(find("#count"), here.length ? `(${here.length})` : "");
  keyed(find("#seats"), state.seats, (seat) => seat.number, seatCard, updateCard);
  find("#seats").removeAttribute("aria-busy");
}

function seatCard(seat) {
  const kick = element("button", { type: "button", className: "ai4u-plain", textContent: "Send out" });
  const ban = element("button", { type: "button", className: "ai4u-plain", textContent: "Ban" });
  kick.addEventListener("click", () => send({ do: "kick", seat: seat.number }));
  ban.addEventListener("click", async () => {
    const text = "This seat can't be used again. Its work stays.";
    if (await ask({ title: `Ban ${seat.name}?`, text, yes: "Ban" })) await send({ do: "ban", seat: seat.number });
  });
  const dot = element("span", { className: "ai4u-dot" });
  dot.style.background = seat.colour;
  return element(
    "li",
    {},
    dot,
    element("span", { className: "ai4u-name" }),
    element("span", { className: "ai4u-facts" }),
    element("span", { className: "ai4u-actions" }, kick, ban),
  );
}

function updateCard(card, seat) {
  setText(card.querySelector(".ai4u-name"), seat.name);
  const world = seat.running ? "world is running" : "world sleeps";
  setText(card.querySelector(".ai4u-facts"), STATES[seat.state] ?? world);
  card.querySelector(".ai4u-actions").hidden = seat.state !== "in";
}

async function send(command) {
  try {
    const answer = await fetch("./teacher/command", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(command),
    });
    if (!answer.ok) await tell("That can't be done", (await answer.json()).problem);
  } catch {
    await tell("That can't be done", "The class can't be reached. Is its program still running?");
  }
  await refresh();
}
