// The answers of one reader: kept in the page, in the browser where it allows that, and saved as
// the file that `lucida lecture --results` reads (docs/lectures.md describes its lines).

/** @typedef {import("./verdict.js").Verdict} Verdict */
/**
 * @typedef {object} Line
 * @property {"answer"} lucida @property {string} time in UTC @property {string} sitting
 * @property {string} step @property {boolean} right @property {string} lecture
 * @property {string} answer @property {string} [mistake] @property {string} [reply]
 * @property {string} [read] @property {boolean} [after_solution] @property {string} [name]
 */

export class Answers {
  /** @param {string} lecture its title */
  constructor(lecture) {
    this.lecture = lecture;
    this.key = `lucida answers: ${lecture}`;
    this.sitting = [...crypto.getRandomValues(new Uint8Array(4))]
      .map((byte) => byte.toString(16).padStart(2, "0"))
      .join("");
    /** @type {Line[]} */
    this.lines = [];
    /** @type {Record<string, string>} what was typed last, by the fields' ids */
    this.typed = {};
    this.restore();
  }

  /**
   * Keep an answer.
   * @param {string} step @param {Verdict} verdict @param {string} answer as it was given
   * @param {string} read the step that explains the exercise
   * @param {boolean} isAfterSolution whether the solution was shown before
   */
  add(step, verdict, answer, read, isAfterSolution) {
    if (!verdict.isAnswer) return;
    /** @type {Line} */
    const line = {
      lucida: "answer",
      time: new Date().toISOString().replace(/\.\d+Z$/, "Z"),
      sitting: this.sitting,
      step,
      right: verdict.right,
      lecture: this.lecture,
      answer,
    };
    if (!verdict.right) {
      line.reply = verdict.text;
      line.read = verdict.read || read;
    }
    if (verdict.mistake) line.mistake = verdict.mistake;
    if (isAfterSolution) line.after_solution = true;
    this.lines.push(line);
    this.keep();
  }

  /** @param {string} field its id @param {string} text */
  type(field, text) {
    this.typed[field] = text;
    this.keep();
  }

  /** Return the file's text. @param {string} name of the student; "" for none */
  text(name) {
    return this.lines
      .map((line) => JSON.stringify(name ? { ...line, name } : line) + "\n")
      .join("");
  }

  /** Save the file where the browser puts downloads. @param {string} name of the student */
  save(name) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.text(name)], { type: "application/jsonl" }));
    link.download = `answers-${this.sitting}.jsonl`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  }

  forget() {
    this.lines = [];
    this.typed = {};
    this.keep();
  }

  keep() {
    const { sitting, lines, typed } = this;
    try {
      localStorage.setItem(this.key, JSON.stringify({ sitting, lines, typed }));
    } catch {
      // A browser may deny that to files; then the answers last as long as the page.
    }
  }

  restore() {
    try {
      const kept = JSON.parse(localStorage.getItem(this.key) ?? "null");
      if (kept && Array.isArray(kept.lines)) Object.assign(this, kept);
    } catch {
      // Denied, or written by something else: begin anew.
    }
  }
}
