/** Where the keys of an agent lie: four of them crosswise, whatever they are called. */

/** What may lie at a place of the cross, first come first served. */
const PLACES = {
  up: ["forward", "up"],
  left: ["turn_left", "left"],
  down: ["backward", "down"],
  right: ["turn_right", "right"],
};

/** For each place of the cross that is taken, in the order of the places, the action there. */
export function cross(bindings) {
  const found = Object.entries(PLACES).map(([place, actions]) => [
    place,
    actions.find((action) => action in bindings),
  ]);
  return new Map(found.filter(([, action]) => action !== undefined));
}
