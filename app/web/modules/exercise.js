// An exercise's form: it takes an answer, replies, and draws what was wrong.

import { typedVector } from "./arithmetic.js";
import { drawing, rayMark, vectorMark } from "./drawn.js";
import { checkPlace } from "./hiding.js";
import { checkOption, checkTexts, isRight } from "./verdict.js";

/** @typedef {import("./verdict.js").Exercise} Exercise */
/** @typedef {import("./verdict.js").Verdict} Verdict */

const LETTERS = "ABCDEFGH";
const SETTLES_MS = 100; // without a move, before pixels are counted
const NOTE = "Full lines are correct, dashed ones yours.";

/**
 * Bring a form to life.
 * @param {HTMLFormElement} form @param {Exercise} exercise
 * @param {import("./answers.js").Answers} answers
 */
export function attach(form, exercise, answers) {
  let isSolved = false;
  const solution = form.querySelector("details");
  solution?.addEventListener("toggle", () => (isSolved ||= solution.open));
  /** @param {Verdict} verdict @param {string} given */
  const judged = (verdict, given) => {
    answers.add(exercise.step, verdict, given, exercise.read, isSolved);
    reply(form, exercise, verdict);
    form.dispatchEvent(new CustomEvent("answered", { bubbles: true }));
  };
  const inputs = [...form.querySelectorAll("input")];
  for (const input of inputs) {
    input.value = answers.typed[input.id] ?? "";
    input.addEventListener("input", () => {
      answers.type(input.id, input.value);
      clear(form);
    });
  }
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const texts = Object.fromEntries(inputs.map((input) => [input.name, input.value]));
    const verdict = checkTexts(exercise, texts);
    for (const input of inputs)
      input.setAttribute("aria-invalid", String(input.name === verdict.field));
    judged(verdict, Object.entries(texts).map((pair) => pair.join(" ")).join("; "));
    const isDrawn = verdict.isAnswer && !verdict.right;
    place(form, ".drawing", ...(isDrawn ? drawn(exercise, texts) : []));
  });
  const options = [...form.querySelectorAll(".options button")];
  options.forEach((button, number) =>
    button.addEventListener("click", () => {
      for (const other of options) other.setAttribute("aria-pressed", String(other === button));
      judged(checkOption(exercise, number), LETTERS[number]);
      const { camera } = (exercise.options ?? [])[number];
      if (camera) /** @type {any} */ (window).lucida?.set(camera); // the step's live figure
    }),
  );
  if (exercise.hiding) attachHiding(form, exercise, (verdict) => judged(verdict, ""));
}

/**
 * Reply to each move of an object in the step's figure. Only the first correct place is kept.
 * @param {HTMLFormElement} form @param {Exercise} exercise @param {(verdict: Verdict) => void} judged
 */
function attachHiding(form, exercise, judged) {
  const { hiding, texts = {} } = exercise;
  let timer = 0, isKept = false;
  form.closest("section")?.addEventListener("shifted", (event) => {
    const { scene, place: where } = /** @type {CustomEvent} */ (event).detail;
    clearTimeout(timer);
    timer = setTimeout(() => {
      const verdict = { ...checkPlace(/** @type {import("./hiding.js").Hiding} */ (hiding), texts, scene, where), field: "", mistake: "", read: "", isAnswer: true };
      if (verdict.right && !isKept) judged(verdict);
      else reply(form, exercise, verdict);
      isKept ||= verdict.right;
    }, SETTLES_MS);
  });
}

/** @param {HTMLFormElement} form */
function clear(form) {
  for (const input of form.querySelectorAll("input")) input.removeAttribute("aria-invalid");
  place(form, ".reply");
  place(form, ".drawing");
}

/** @param {HTMLFormElement} form @param {Exercise} exercise @param {Verdict} verdict */
function reply(form, exercise, verdict) {
  const template = form.querySelector(`template[data-reply="${exercise.replies[verdict.text]}"]`);
  const mark = document.createElement("span");
  mark.className = verdict.right ? "mark right" : "mark wrong";
  mark.textContent = verdict.right ? "\u2713 " : "\u2717 ";
  const said = template instanceof HTMLTemplateElement ? template.content.cloneNode(true) : null;
  place(form, ".reply", mark, said ?? verdict.text.replace(/\\([\\$*`[])/g, "$1"));
}

/** @param {HTMLFormElement} form @param {string} where @param {...(Node | string)} nodes */
function place(form, where, ...nodes) {
  form.querySelector(where)?.replaceChildren(...nodes);
}

/** Return the drawing of a wrong answer. @param {Exercise} exercise
 * @param {Record<string, string>} texts */
function drawn({ paper, ray, answers = [], tolerance = 0 }, texts) {
  if (!paper) return [];
  /** @type {import("./drawn.js").Mark[]} */
  const marks = [];
  if (ray) {
    const [origin, direction] = [ray.origin, ray.direction].map((v) => v.map((x) => x ?? NaN));
    marks.push(rayMark(paper, "right", origin, direction, ""));
    const given = [texts.origin, texts.direction].map(typedVector);
    marks.push(rayMark(paper, "given", given[0], given[1], "yours"));
  }
  for (const wanted of answers) {
    const value = typedVector(texts[wanted.name]);
    if (isRight(wanted, value, tolerance)) continue;
    const exact = wanted.value.map((x) => x ?? NaN);
    const name = wanted.draw === "corner" ? "corner" : wanted.name;
    marks.push(vectorMark(paper, "right", exact, wanted.draw, name));
    marks.push(vectorMark(paper, "given", value, wanted.draw, `your ${name}`));
  }
  return [drawing(paper, marks, "The correct answer and yours, drawn with the camera."), note()];
}

function note() {
  return Object.assign(document.createElement("p"), { className: "note", textContent: NOTE });
}
