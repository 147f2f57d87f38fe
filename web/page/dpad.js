/** The directional pad: which four of an agent's actions lie crosswise on the screen. */

/** Actions by direction of the pad; the first one that the agent has is taken. */
const DIRECTION_ACTIONS = {
  up: ["forward", "up"],
  left: ["turn_left", "left"],
  down: ["backward", "down"],
  right: ["turn_right", "right"],
};

/**
 * Return the actions on the pad by direction (up, left, down, right), without empty directions.
 * @param {object} bindings of the agent, by action
 */
export function dpadActions(bindings) {
  /** @type {Map<string, string>} */
  const pad = new Map();
  for (const [direction, actions] of Object.entries(DIRECTION_ACTIONS)) {
    const bound = actions.find((action) => action in bindings);
    if (bound !== undefined) pad.set(direction, bound);
  }
  return pad;
}
