/** The WebSocket of the teacher's page and of the projector page: the class's state, drawings and poses. */

/** @import { ClassState, DrawingMessage, PosesMessage } from "../types/class.js" */

import { JsonSocket } from "../shared/socket.js";
import { t } from "../shared/text.js";

const LOST = t("The class can't be reached. Is its program still running? This page tries again by itself.");

/**
 * Open the socket, and open it again whenever it is lost.
 * @param {string} path relative to the page
 * @param {{class: (state: ClassState) => void, drawing: (message: DrawingMessage) => void, poses: (message: PosesMessage) => void}}
 *   receive functions by the type of a message
 * @param {(problem: string) => void} say shows a sentence, or "" when all is well again
 */
export function openClassSocket(path, receive, say) {
  const socket = new JsonSocket(path);
  socket.onopen = () => say("");
  socket.onmessage = (message) => {
    /** @type {keyof typeof receive} */
    const type = message.type;
    receive[type]?.(message);
  };
  socket.onclose = async (refusal) => {
    say(refusal || LOST);
    if (await isTokenAsked()) location.reload();
  };
  addEventListener("offline", () => say(LOST)); // long before the socket notices
  addEventListener("online", () => socket.isOpen && say(""));
  socket.open();
}

/** Return true if the class is there but asks for its token again. Browsers don't say why a handshake failed. */
async function isTokenAsked() {
  try {
    return (await fetch(location.href, { method: "HEAD", cache: "no-store" })).status === 401;
  } catch {
    return false;
  }
}
