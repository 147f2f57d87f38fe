/**
 * Times after which the page gives up; a test, or a page for very slow computers, may change them at any time.
 *
 * `programS` and `callMs` limit a call of the program. Python ends it after `programS` seconds and names the line, but looks
 * at the clock only between two lines; after `callMs` milliseconds the page ends the worker.
 */
export const codeLimits = {
  programS: 1,
  callMs: 2000,
  /** Time in which a call begins, also on a machine that is very busy (ms). */
  beginMs: 10_000,
  /** Time for which the world's first answer is waited for (ms). */
  connectMs: 10_000,
  /** Time for which the world's word for the end of an episode is waited for (ms). */
  outcomeMs: 1000,
  /** Time until a file that could not be loaded is asked for again; twice as long after each failure (ms). */
  retryMs: 500,
  /** Time in which a connection of the page opens; a room of a class may have to start first (ms). */
  openMs: 20_000,
  /** Time without a message after which such a connection counts as lost, if its server sends `keepalive`, which it does
   * every 2 s: a network that is gone closes no connection (ms). */
  silenceMs: 8000,
};
