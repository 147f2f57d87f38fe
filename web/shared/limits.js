/** Times after which the page tries again or gives up; a test, or a page for very slow computers, may change them at any time. */
export const limits = {
  /** Time until a file that could not be loaded is asked for again; twice as long after each failure (ms). */
  retryMs: 500,
  /** Time in which a connection opens; a room of a class may have to start first (ms). */
  openMs: 20_000,
  /** Time without a message after which a connection counts as lost, if its server sends `keepalive`, which it does every
   * 2 s: a network that is gone closes no connection (ms). */
  silenceMs: 8000,
  /** Time after which Python ends a call of the student's program, and names the line; it looks at the clock only between
   * two lines (s). */
  programS: 1,
  /** Time after which the page ends the worker of such a call (ms). */
  callMs: 2000,
  /** Time in which such a call begins, also on a machine that is very busy (ms). */
  beginMs: 10_000,
  /** Time for which the world's first answer is waited for (ms). */
  connectMs: 10_000,
  /** Time for which the world's word for the end of an episode is waited for (ms). */
  outcomeMs: 1000,
};
