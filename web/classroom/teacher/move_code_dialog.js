/** The dialog with the code for a seat whose browser has lost it, or that was sent out. */

/** @import { Seat } from "../../types/class.js" */

import { command } from "./command.js";
import { ask, tell } from "../../shared/dialog.js";
import { t, tn } from "../../shared/text.js";

/** @param {Seat} seat */
export async function showMoveCode(seat) {
  try {
    const { code, minutes } = await command({ do: "move code", seat: seat.number });
    const { name } = seat;
    const text = tn(
      "{name} types it on the join page of another device, once, within {n} minute, and has this seat and its work there.",
      "{name} types it on the join page of another device, once, within {n} minutes, and has this seat and its work there.",
      minutes,
      { name },
    );
    await ask({ title: t("Code for {name}: {code}", { name, code }), text, yes: t("Close"), no: "" });
  } catch (error) {
    await tell(t("That can't be done"), error.message);
  }
}
