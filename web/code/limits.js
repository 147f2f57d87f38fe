/**
 * Times after which the tab "Code" gives up; a test, or a page for very slow computers, may change them at any time.
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
};
