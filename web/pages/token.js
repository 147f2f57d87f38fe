/** The page that asks for a world's token. Without this script the form works too. */

import { t } from "../shared/text.js";

const form = document.querySelector("form");
const input = /** @type {HTMLInputElement} */ (document.querySelector("#token"));
const button = document.querySelector("button");
const problem = document.querySelector("#problem");

// a wrong token must not stay in the address and the history
history.replaceState(null, "", addressWith(null));

form.addEventListener("submit", async (event) => {
  event.preventDefault();
  button.disabled = true;
  problem.textContent = "";
  try {
    // the answer to the right token is a cookie and a redirect, which need not be followed
    const answer = await fetch(addressWith(tokenIn(input.value)), { redirect: "manual", cache: "no-store" });
    if (answer.type === "opaqueredirect" || answer.ok) {
      location.reload(); // keeps what stands after the #, such as a shared scene
      return;
    }
    problem.textContent = sentence(answer);
  } catch {
    problem.textContent = t("The world can't be reached. Is it still running?");
  }
  button.disabled = false;
  input.focus();
  input.select();
});

/**
 * Return the token in a text that may be a whole link.
 * @param {string} text
 */
function tokenIn(text) {
  const query = text.trim().match(/[?&](token=[^#\s]*)/)?.[1];
  return query ? new URLSearchParams(query).get("token") : text.trim();
}

/**
 * Return this page's address with another token in its query; null for none.
 * @param {string | null} token
 */
function addressWith(token) {
  const address = new URL(location.href);
  address.searchParams.delete("token");
  if (token !== null) address.searchParams.set("token", token);
  return address.href;
}

/** @param {Response} answer */
function sentence(answer) {
  if (answer.status === 401) return t("That token is wrong.");
  if (answer.status !== 429) return t("The world answers with error {status}.", { status: answer.status });
  return t("Too many wrong tokens came from this address. Try again in {seconds} s.", { seconds: answer.headers.get("Retry-After") });
}
