/** Times after which the page tries again or gives up; a test, or a page for very slow computers, may change them. */
export const pageLimits = {
  /** Time until a file that could not be loaded is asked for again; twice as long after each failure (ms). */
  retryMs: 500,
  /** Time in which a connection opens; a room of a class may have to start first (ms). */
  openMs: 20_000,
  /** Time without a message after which a connection counts as lost, if its server sends `keepalive`, which it does every
   * 2 s: a network that is gone closes no connection (ms). */
  silenceMs: 8000,
};
