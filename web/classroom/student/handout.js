/** The program that a teacher gives to begin with, as the event of the class has it. */

/** @import { StartingProgram } from "../../types/class.js" */

/** @type {StartingProgram | null} */
let given = null;

/** Tells of a change with the event "change". */
export const handouts = new EventTarget();

/**
 * Note what an event of the class has.
 * @param {StartingProgram | null} program
 */
export function noteHandout(program) {
  if (given?.scene === program?.scene && given?.source === program?.source) return;
  given = program;
  handouts.dispatchEvent(new Event("change"));
}

/**
 * Return the program that is given for a scene; null if there is none.
 * @param {string} scene
 */
export function handoutFor(scene) {
  const isFor = given !== null && (given.scene === "" || given.scene === scene);
  return isFor ? given.source : null;
}
