/** The dialog with the code for a seat whose browser has lost it, or that was sent out. */

/** @import { Seat } from "../../types/class.js" */

import { command } from "./command.js";
import { ask, tell } from "../../shared/dialog.js";

/** @param {Seat} seat */
export async function showMoveCode(seat) {
  try {
    const { code, minutes } = await command({ do: "move code", seat: seat.number });
    const text = `${seat.name} types it on the join page of another device, once, within ${minutes} minutes, and has this seat and its work there.`;
    await ask({ title: `Code for ${seat.name}: ${code}`, text, yes: "Close", no: "" });
  } catch (error) {
    await tell("That can't be done", error.message);
  }
}
