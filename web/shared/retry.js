/** Another try of what failed because the network, or a busy server, did for a moment. */

import { limits } from "./limits.js";

/** Most tries; the pause before each is twice as long as the one before. */
const TRIES = 5;

/**
 * Return what a function's promise gives, calling it again after a while if it fails.
 * @template Result
 * @param {() => Promise<Result>} load such as an import of a module, which browsers fetch again after a failure
 */
export async function retried(load) {
  for (let tries = 1, pause = limits.retryMs; ; tries += 1, pause *= 2) {
    try {
      return await load();
    } catch (error) {
      if (tries === TRIES) throw error;
      await new Promise((resolve) => setTimeout(resolve, pause));
    }
  }
}
