// The verdict on an answer to an exercise. The same as app/lecture/exercises.py; what is right, the
// classic mistakes and the replies come from there, as data.

import { TypedError, typedVector } from "./arithmetic.js";

/** @typedef {(number | null)[]} Numbers null where a wrong program has no finite number */
/**
 * @typedef {object} Verdict
 * @property {boolean} right
 * @property {string} text the reply, as the lecture's file has it
 * @property {string} field that it is about, or ""
 * @property {string} mistake its name, or the reply; "" if it is not recognised
 * @property {string} read the step that explains it; "" for the one before the exercise
 * @property {boolean} isAnswer false for a text that could not be read
 */
/** @typedef {{origin: Numbers, direction: Numbers, mistake: string, text: string, read: string}} WrongRay */
/**
 * @typedef {object} Wanted
 * @property {string} name @property {Numbers} value @property {boolean} scaled
 * @property {"arrow" | "point" | "corner"} draw
 * @property {{value: Numbers, text: string}[]} wrong @property {Record<string, string>} texts
 */
/**
 * @typedef {object} Exercise
 * @property {string} step its title @property {string} read the step that explains it
 * @property {Record<string, number>} replies the number of each reply's template
 * @property {string[]} [fields] @property {number} [tolerance] @property {boolean} [scaled]
 * @property {Record<string, string>} [texts] @property {import("./drawn.js").Paper} [paper]
 * @property {{origin: Numbers, direction: Numbers}} [ray] @property {WrongRay[]} [wrong]
 * @property {Wanted[]} [answers]
 * @property {{right: boolean, text: string, mistake: string, read: string, camera?: any}[]} [options]
 * @property {import("./hiding.js").Hiding} [hiding]
 */

/** @param {boolean} right @param {string} text @param {Partial<Verdict>} [more] @returns {Verdict} */
const verdict = (right, text, more) => ({
  right, text, field: "", mistake: "", read: "", isAnswer: true, ...more,
});

/**
 * Return the verdict on an option.
 * @param {Exercise} exercise @param {number} chosen
 */
export function checkOption(exercise, chosen) {
  const { right, text, mistake, read } = (exercise.options ?? [])[chosen];
  return verdict(right, text, { mistake, read });
}

/**
 * Return the verdict on typed texts, by field.
 * @param {Exercise} exercise @param {Record<string, string>} texts
 */
export function checkTexts(exercise, texts) {
  /** @type {Record<string, number[]>} */
  const given = {};
  for (const name of exercise.fields ?? []) {
    try {
      given[name] = typedVector(texts[name] ?? "");
    } catch (error) {
      if (!(error instanceof TypedError)) throw error;
      return verdict(false, escaped(`${name}: ${error.message}`), { field: name, isAnswer: false });
    }
  }
  return exercise.ray ? checkRay(exercise, given) : checkVectors(exercise, given);
}

/** @param {Exercise} exercise @param {Record<string, number[]>} given */
function checkRay(exercise, given) {
  const { ray, wrong = [], texts = {}, tolerance = 0, scaled } = exercise;
  if (!ray) throw new Error("no ray");
  const isSame = scaled ? isMultiple : isClose;
  /** @param {Numbers} exact */
  const isOrigin = (exact) => isClose(given.origin, exact, tolerance);
  /** @param {Numbers} exact */
  const isDirection = (exact) => isSame(given.direction, exact, tolerance);
  const isWrongOrigin = !isOrigin(ray.origin);
  const isWrongDirection = !isDirection(ray.direction);
  if (!isWrongOrigin && !isWrongDirection) return verdict(true, texts.right);
  /** @param {string} field @param {WrongRay} one */
  const made = (field, { text, mistake, read }) => verdict(false, text, { field, mistake, read });
  const whole = wrong.find((one) => isOrigin(one.origin) && isDirection(one.direction));
  if (whole) return made(isWrongOrigin ? "origin" : "direction", whole);
  if (isWrongOrigin) {
    const found = wrong.find((one) => isOrigin(one.origin));
    return found ? made("origin", found) : verdict(false, texts.origin, { field: "origin" });
  }
  const found = wrong.find((one) => isDirection(one.direction));
  const field = "direction";
  if (found) return made(field, found);
  const backwards = given.direction.map((x) => -x);
  for (const [direction, text] of /** @type {const} */ ([
    [given.direction, texts.length],
    [backwards, texts.backwards],
  ]))
    if (isMultiple(direction, ray.direction, tolerance))
      return verdict(false, text, { field, mistake: text });
  return verdict(false, texts.direction, { field });
}

/** @param {Exercise} exercise @param {Record<string, number[]>} given */
function checkVectors(exercise, given) {
  const { answers = [], tolerance = 0, texts = {} } = exercise;
  for (const wanted of answers) {
    const value = given[wanted.name];
    const field = wanted.name;
    if (isRight(wanted, value, tolerance)) continue;
    const isSame = wanted.scaled ? isMultiple : isClose;
    const known = wanted.wrong.find((one) => isSame(value, one.value, tolerance));
    if (known) return verdict(false, known.text, { field, mistake: known.text });
    const { length, opposite } = wanted.texts;
    if (isMultiple(value, wanted.value, tolerance))
      return verdict(false, length, { field, mistake: length });
    if (isMultiple(value.map((x) => -x), wanted.value, tolerance))
      return verdict(false, opposite, { field, mistake: opposite });
    return verdict(false, wanted.texts["not yet"], { field });
  }
  return verdict(true, texts.right);
}

/** @param {Wanted} wanted @param {number[]} value @param {number} tolerance */
export function isRight(wanted, value, tolerance) {
  return (wanted.scaled ? isMultiple : isClose)(value, wanted.value, tolerance);
}

/** @param {Numbers} a */
const norm = (a) => Math.hypot(...a.map((x) => x ?? NaN));

/** @param {number[]} given @param {Numbers} exact @param {number} tolerance */
function isClose(given, exact, tolerance) {
  const off = norm(given.map((x, k) => x - (exact[k] ?? NaN)));
  return off <= tolerance * Math.max(1, norm(exact));
}

/** Return true if two vectors have one direction; never for a vector without one.
 * @param {number[]} given @param {Numbers} exact @param {number} tolerance */
function isMultiple(given, exact, tolerance) {
  const lengths = [norm(given), norm(exact)];
  if (Math.min(...lengths) < 1e-12) return false;
  const off = norm(given.map((x, k) => x / lengths[0] - (exact[k] ?? NaN) / lengths[1]));
  return off <= tolerance;
}

/** Escape a text so that a lecture shows it as typed. @param {string} text */
const escaped = (text) => text.replace(/([\\$*`[])/g, "\\$1");
