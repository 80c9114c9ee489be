// Numbers and vectors as people type them: 1/8, -0.125, 1/sqrt(2), (0, 1, -3/4).
// The same texts as app/ui/explaining/arithmetic.py takes, with the same complaints.

const LONGEST = 80; // characters of one number
const NUMBERS =
  /^(?:0[xX](?:_?[\da-fA-F])+|0[oO](?:_?[0-7])+|0[bB](?:_?[01])+|(?:\d(?:_?\d)*)?\.\d(?:_?\d)*(?:[eE][+-]?\d(?:_?\d)*)?|\d(?:_?\d)*\.(?:[eE][+-]?\d(?:_?\d)*)?|\d(?:_?\d)*[eE][+-]?\d(?:_?\d)*|0(?:_?0)*(?![\d_])|[1-9](?:_?\d)*)(?![\w.])/;
/** @type {Record<string, string>} */
const PLAIN = { "\u2212": "-", "\u00b7": "*", "\u221a": "sqrt", "\u03c0": "pi" };

/** What is wrong with a typed text. */
export class TypedError extends Error {
  /** @param {string} problem @param {string} remedy */
  constructor(problem, remedy) {
    super(`${problem}; ${remedy}`.replace(/\s+/g, " "));
  }
}

/**
 * Return the value of a number: decimals, fractions, sums, products, brackets, sqrt() and pi.
 * @param {string} text
 */
export function typedNumber(text) {
  const shown = quoted(text.trim());
  const tidy = text.trim().replace(/[\u2212\u00b7\u221a\u03c0]/g, (sign) => PLAIN[sign]);
  if (!tidy) throw new TypedError("is empty", "give a number such as 0.25 or 1/4");
  if (tidy.length > LONGEST)
    throw new TypedError("is too long", "give a number such as 0.25 or 1/4");
  const reader = new Reader(tidy.replace(/#.*$/, ""));
  const value = reader.sum();
  if (reader.isDividedByZero) throw new TypedError(`${shown} divides by zero`, "correct it");
  if (value === null || !reader.isAtEnd())
    throw new TypedError(`${shown} is not a number`, "give one such as 0.25, 1/4 or 1/sqrt(2)");
  if (!Number.isFinite(value)) throw new TypedError(`${shown} is not finite`, "give a finite number");
  return value;
}

/**
 * Return three numbers, separated by commas, semicolons or blanks, with or without brackets.
 * @param {string} text @returns {[number, number, number]}
 */
export function typedVector(text) {
  let tidy = text.trim();
  if (/^[([]/.test(tidy) && /[)\]]$/.test(tidy) && isEnclosed(tidy)) tidy = tidy.slice(1, -1);
  const separator = [";", ","].find((sign) => tidy.includes(sign));
  const parts = separator ? tidy.split(separator) : tidy.trim().split(/\s+/).filter(Boolean);
  if (parts.length !== 3)
    throw new TypedError(
      tidy ? `${quoted(text.trim())} is not three numbers` : "enter three numbers",
      "give a vector such as (1/8, 0, -1)",
    );
  if (!parts.every((part) => part.trim()))
    throw new TypedError("one of the three numbers is missing", "give all three");
  const [x, y, z] = parts.map(typedNumber);
  return [x, y, z];
}

/** Return true if the last sign closes the first bracket, and nothing closes it before.
 * @param {string} text */
function isEnclosed(text) {
  let depth = 0;
  for (let at = 0; at < text.length; at++) {
    depth += Number("([".includes(text[at])) - Number(")]".includes(text[at]));
    if (depth === 0) return at === text.length - 1;
  }
  return false;
}

/** Return a text between quotation marks, as Python writes it.
 * @param {string} text */
function quoted(text) {
  const mark = text.includes("'") && !text.includes('"') ? '"' : "'";
  const inside = text.replaceAll("\\", "\\\\").replaceAll("\t", "\\t");
  return mark + (mark === "'" ? inside.replaceAll("'", "\\'") : inside) + mark;
}

/** Reads a sum from left to right. null: what stands there is no number. */
class Reader {
  /** @param {string} text */
  constructor(text) {
    this.rest = text.trim();
    this.isDividedByZero = false;
  }

  isAtEnd() {
    return this.rest === "";
  }

  /** Take a text if it comes next. @param {string} text */
  take(text) {
    if (!this.rest.startsWith(text)) return false;
    this.rest = this.rest.slice(text.length).trimStart();
    return true;
  }

  /** @returns {number | null} */
  sum() {
    let value = this.product();
    for (;;) {
      const sign = this.take("+") ? 1 : this.take("-") ? -1 : 0;
      if (value === null || !sign) return value;
      const next = this.product();
      value = next === null ? null : value + sign * next;
    }
  }

  /** @returns {number | null} */
  product() {
    let value = this.signed();
    for (;;) {
      const isOver = this.take("/");
      if (value === null || !(isOver || this.take("*"))) return value;
      const next = this.signed();
      if (isOver && next === 0) this.isDividedByZero = true;
      value = next === null ? null : isOver ? value / next : value * next;
    }
  }

  /** @returns {number | null} */
  signed() {
    if (this.take("+")) return this.signed();
    if (!this.take("-")) return this.atom();
    const value = this.signed();
    return value === null ? null : -value;
  }

  /** @returns {number | null} */
  atom() {
    const name = /^(?:sqrt|pi)(?!\w)/.exec(this.rest)?.[0];
    if (name) this.take(name);
    if (name === "pi") return Math.PI;
    if (this.take("(")) {
      const value = this.sum();
      if (!this.take(")") || value === null) return null;
      return name && value < 0 ? null : name ? Math.sqrt(value) : value;
    }
    const found = name ? null : NUMBERS.exec(this.rest);
    if (!found) return null;
    this.take(found[0]);
    return Number(found[0].replaceAll("_", ""));
  }
}
