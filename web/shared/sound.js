/**
 * Sounds of a drive, made of a few oscillators: motor, bump, collect, speak, win and fall.
 *
 * They are quiet, and on until somebody mutes them; in a class only if its teacher has turned them on. Browsers allow sound only after a
 * key or a click, which is where the first one comes from.
 */

import { roomOfPage } from "./room.js";
import { recall, remember } from "./storage.js";

const STORAGE_KEY = "sound";
const VOLUME = 0.06;
const NOTE_S = 0.12;
const WIN_HZ = [523.25, 659.25, 783.99, 1046.5];
const COLLECT_HZ = [880, 1174.66];
const BUMP_HZ = [130];
const SPEAK_HZ = [660, 990];
const MOTOR_HZ = 58;
/** Volume of the motor, as a share of that of notes. */
const MOTOR_SHARE = 0.35;
/** Time in which the motor starts and stops (s). */
const MOTOR_FADE_S = 0.08;
/** Length of a fall's falling tone (s). */
const FALL_S = 0.6;
/** Shortest time between two bumps, and between two things that are collected (ms). */
const MIN_INTERVAL_MS = 180;

export class Sounds {
  /** @type {AudioContext | null} */
  #audio = null;
  /** @type {GainNode | null} */
  #motor = null;
  #isMotorOn = false;
  /**
   * Times of the latest sounds that are limited (ms, performance.now), by name.
   * @type {Record<string, number>}
   */
  #playedAt = {};

  /** True in a class, unless its teacher has turned sounds on. */
  isForbidden = roomOfPage() !== "";

  get isOn() {
    return !this.isForbidden && recall(STORAGE_KEY, true) !== false;
  }

  set isOn(isOn) {
    remember(STORAGE_KEY, isOn);
    if (!isOn) this.motor(false);
  }

  bump() {
    if (this.#isDue("bump")) this.#play(BUMP_HZ, "sine");
  }

  collect() {
    if (this.#isDue("collect")) this.#play(COLLECT_HZ, "triangle");
  }

  speak() {
    if (this.#isDue("speak")) this.#play(SPEAK_HZ, "sine");
  }

  win() {
    this.#play(WIN_HZ, "triangle");
  }

  fall() {
    const audio = this.isOn ? this.#context() : null;
    if (audio === null) return;
    const now = audio.currentTime;
    const tone = new OscillatorNode(audio, { frequency: 520, type: "triangle" });
    const volume = new GainNode(audio, { gain: VOLUME });
    tone.frequency.exponentialRampToValueAtTime(90, now + FALL_S);
    volume.gain.linearRampToValueAtTime(0, now + FALL_S);
    tone.connect(volume).connect(audio.destination);
    tone.start(now);
    tone.stop(now + FALL_S);
  }

  /**
   * Let the motor hum, or stop it.
   * @param {boolean} isRunning
   */
  motor(isRunning) {
    const isOn = isRunning && this.isOn;
    if (isOn === this.#isMotorOn) return;
    this.#isMotorOn = isOn;
    const audio = isOn ? this.#context() : this.#audio;
    if (audio === null) return;
    if (this.#motor === null) {
      this.#motor = new GainNode(audio, { gain: 0 });
      const hum = new OscillatorNode(audio, { frequency: MOTOR_HZ, type: "sawtooth" });
      hum.connect(new BiquadFilterNode(audio, { type: "lowpass", frequency: 220 })).connect(this.#motor).connect(audio.destination);
      hum.start();
    }
    this.#motor.gain.setTargetAtTime(isOn ? VOLUME * MOTOR_SHARE : 0, audio.currentTime, MOTOR_FADE_S);
  }

  /** @param {string} name of a sound that comes often */
  #isDue(name) {
    const now = performance.now();
    if (now - (this.#playedAt[name] ?? -Infinity) < MIN_INTERVAL_MS) return false;
    this.#playedAt[name] = now;
    return true;
  }

  /**
   * @param {number[]} notes (Hz)
   * @param {OscillatorType} type
   */
  #play(notes, type) {
    const audio = this.isOn ? this.#context() : null;
    if (audio !== null) schedule(audio, notes, type, VOLUME);
  }

  #context() {
    if (typeof AudioContext === "undefined") return null;
    this.#audio ??= new AudioContext();
    if (this.#audio.state === "suspended") void this.#audio.resume();
    return this.#audio;
  }
}

/**
 * Play notes (Hz) in turn, as loud as a room of people needs.
 * @param {number[]} notes
 */
export function playNotes(notes) {
  if (typeof AudioContext === "undefined") return;
  const audio = new AudioContext();
  schedule(audio, notes, "triangle", 0.15).addEventListener("ended", () => audio.close());
}

/**
 * Return the last one of notes that are played in turn.
 * @param {AudioContext} audio
 * @param {number[]} notes (Hz)
 * @param {OscillatorType} type
 * @param {number} gain
 */
function schedule(audio, notes, type, gain) {
  const volume = new GainNode(audio, { gain });
  volume.connect(audio.destination);
  /** @type {OscillatorNode} */
  let last;
  notes.forEach((frequency, index) => {
    const start = audio.currentTime + index * NOTE_S;
    last = new OscillatorNode(audio, { frequency, type });
    last.connect(volume);
    last.start(start);
    last.stop(start + NOTE_S);
  });
  return last;
}
