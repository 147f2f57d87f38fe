/** A short tone when a person reaches the goal; off until it is turned on in the help. */

import { recall, remember } from "./storage.js";

const NOTES_HZ = [523.25, 783.99];
const NOTE_S = 0.12;
const VOLUME = 0.15;
const STORAGE_KEY = "tone";

export function isToneOn() {
  return recall(STORAGE_KEY, false) === true;
}

/** @param {boolean} isOn */
export function setTone(isOn) {
  remember(STORAGE_KEY, isOn);
}

/** Play the tone if it is on. Browsers allow sound only after a key or click, and a win follows one. */
export function playTone() {
  if (isToneOn()) playNotes(NOTES_HZ);
}

/**
 * Play notes (Hz) one after another.
 * @param {number[]} notes
 */
export function playNotes(notes) {
  if (typeof AudioContext === "undefined") return;
  const audio = new AudioContext();
  const volume = new GainNode(audio, { gain: VOLUME });
  volume.connect(audio.destination);
  notes.forEach((frequency, index) => {
    const note = new OscillatorNode(audio, { frequency, type: "triangle" });
    const start = audio.currentTime + index * NOTE_S;
    note.connect(volume);
    note.start(start);
    note.stop(start + NOTE_S);
    if (index === notes.length - 1) note.addEventListener("ended", () => audio.close());
  });
}
