/** The dialog that deletes everything of a seat. */

/** @import { Seat } from "../../types/class.js" */
/** @import { RealNames } from "./real_names.js" */

import { command } from "./command.js";
import { showForm } from "../../shared/form_dialog.js";
import { t } from "../../shared/text.js";

/**
 * @param {Seat} seat
 * @param {RealNames} realNames
 */
export async function showForget(seat, realNames) {
  const text = t(
    "Deletes drives, programs, networks, progress and stars of this seat from this computer, and tournaments in which its networks have played. What stands in a world that others have, too, stays. This can’t be undone.",
  );
  const isForgotten = await showForm({ title: t("Forget {name}?", { name: seat.name }), text, content: [], yes: t("Forget"), isDanger: true }, () =>
    command({ do: "forget seat", seat: seat.number }),
  );
  if (isForgotten) realNames.forgetSeat(seat);
}
