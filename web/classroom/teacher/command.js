/** Commands of the teacher's page. */

import { tell } from "../../shared/dialog.js";
import { t } from "../../shared/text.js";

const UNREACHABLE = t("The class can't be reached. Is its program still running?");

/** @typedef {{do: string, [argument: string]: unknown}} Command with its arguments */

/**
 * Send a command.
 * @param {Command} command
 * @returns {Promise<{code?: string, minutes?: number}>} the answer, which only "move code" has
 * @throws {Error} with a sentence for the teacher if it can't be done
 */
export async function command(command) {
  let answer;
  try {
    answer = await fetch("./teacher/command", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify(command),
    });
  } catch {
    throw new Error(UNREACHABLE);
  }
  if (answer.ok) return answer.json();
  const { problem } = await answer.json().catch(() => ({}));
  throw new Error(problem ?? t("The class answered with status {status}.", { status: answer.status }));
}

/**
 * Send a command, and tell the teacher in a dialog if it can't be done. Return true if it was done.
 * @param {Command} wanted
 */
export async function commandOrTell(wanted) {
  try {
    await command(wanted);
    return true;
  } catch (error) {
    await tell(t("That can't be done"), error.message);
    return false;
  }
}
