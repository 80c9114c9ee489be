// The builds of a lecture's steps, one at a time: keys, overview, address, theme.

import { Answers } from "./answers.js";
import { attach } from "./exercise.js";
import { LiveFigures } from "./live.js";
import { Notes } from "./notes.js";
import { overview } from "./overview.js";

const THEMES = ["dark", "light", "contrast"];
const TYPED_INTO = "input:not([type=range], [type=radio], [type=checkbox]), textarea, dialog";
const OWN_KEYS = "input, textarea, [role=slider], dialog";
const OWN_SWIPES = ".live-figure, pre, input";
const SWIPE_PX = 40;

/** @template {Element} T @param {string} id @param {new () => T} kind @returns {T} */
function byId(id, kind) {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`no ${id}`);
  return found;
}

class Slides {
  constructor() {
    this.steps = /** @type {HTMLElement[]} */ ([...document.querySelectorAll("section.step")]);
    this.number = 0;
    this.typed = "";
    this.told = byId("told", HTMLElement);
    this.notes = new Notes(this);
    this.openOverview = overview(this.steps.filter(({ id }) => !id.includes(".")));
  }

  get step() {
    return this.steps[this.number];
  }

  /** Go to a build. @param {number} number of all, from 0 */
  go(number) {
    const next = Math.min(Math.max(number, 0), this.steps.length - 1);
    if (next === this.number) return;
    const isOther = this.steps[next].dataset.number !== this.step.dataset.number;
    this.number = next;
    history.replaceState(null, "", `#${this.step.id}`);
    crossFade(() => {
      this.show();
      if (isOther) {
        scrollTo(0, 0);
        this.step.querySelector("h2")?.focus({ preventScroll: true });
      } else this.told.textContent = this.step.querySelector(".text")?.lastElementChild?.textContent ?? "";
    });
  }

  /** Go to the step whose number was typed. @param {string} typed */
  goToTyped(typed) {
    const found = this.steps.findIndex((step) => step.dataset.number === String(Number(typed)));
    if (found >= 0) this.go(found);
    else this.told.textContent = `There is no step ${typed}`;
  }

  /** @param {1 | -1} by */
  advance(by) {
    this.go(this.number + by);
  }

  /** Scroll while there is more of the step below; then go on. */
  pageDown() {
    const below = document.documentElement.scrollHeight - innerHeight - scrollY;
    if (below > 8) scrollBy(0, 0.85 * innerHeight);
    else this.advance(1);
  }

  show() {
    this.steps.forEach((step, number) => step.classList.toggle("current", number === this.number));
    const last = this.steps.length - 1;
    byId("place", HTMLElement).textContent = `${this.step.dataset.number} / ${this.steps[last].dataset.number}`;
    byId("previous", HTMLButtonElement).disabled = this.number === 0;
    byId("next", HTMLButtonElement).disabled = this.number === last;
    document.dispatchEvent(new CustomEvent("step", { detail: this.step }));
    this.notes.show();
  }

  /** Do what a key asks for. @param {KeyboardEvent} event */
  key(event) {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const at = event.target instanceof Element ? event.target : document.body;
    const name = event.key === " " ? "Space" : event.key;
    const owner = name.startsWith("Page") ? "dialog" : name.length === 1 ? TYPED_INTO : OWN_KEYS;
    const isField = at.closest(owner) !== null;
    const typed = this.typed;
    this.typed = "";
    const isPressed = name === "Space" && at.closest("button, summary, a") !== null;
    const action = isField || isPressed ? undefined : this.actions(event.shiftKey, typed)[name];
    if (!action) return;
    event.preventDefault();
    if (document.body.classList.contains("blank")) blank();
    else action();
  }

  /** @param {boolean} shift @param {string} typed the digits before @returns {Record<string, () => void>} */
  actions(shift, typed) {
    const [on, back] = [() => this.advance(1), () => this.advance(-1)];
    const digits = [..."0123456789"].map((digit) => [digit, () => (this.typed = typed + digit)]);
    const letters = {
      ...Object.fromEntries(digits),
      ...(typed ? { Enter: () => this.goToTyped(typed) } : {}),
      o: () => this.openOverview(Number(this.step.dataset.number) - 1),
      n: () => this.notes.open(),
      t: nextTheme,
      b: blank,
      ".": blank,
      "?": () => byId("help", HTMLDialogElement).showModal(),
    };
    return {
      ...(byId("letters", HTMLInputElement).checked ? letters : {}),
      ArrowRight: on,
      ArrowLeft: back,
      PageDown: () => this.pageDown(),
      PageUp: back,
      Space: shift ? back : () => this.pageDown(),
      Home: () => this.go(0),
      End: () => this.go(this.steps.length - 1),
    };
  }
}

/** Fade from what is shown to what a change shows, unless motion is to be reduced. @param {() => void} change */
function crossFade(change) {
  const cuts = matchMedia("(prefers-reduced-motion: reduce)").matches || !document.startViewTransition;
  if (cuts) change();
  else document.startViewTransition(change).ready.catch(() => undefined); // a second change ends the first
}

/** Let a finger go on and back. @param {Slides} slides */
function bindSwipes(slides) {
  const main = /** @type {HTMLElement} */ (document.querySelector("main"));
  let start = /** @type {PointerEvent | null} */ (null);
  main.addEventListener("pointerdown", (event) => {
    const isSwipe = event.isPrimary && event.pointerType === "touch";
    start = isSwipe && !(/** @type {Element} */ (event.target).closest(OWN_SWIPES)) ? event : null;
  });
  main.addEventListener("pointerup", ({ clientX, clientY }) => {
    const [x, y] = start ? [clientX - start.clientX, clientY - start.clientY] : [0, 0];
    start = null;
    if (Math.abs(x) > Math.max(SWIPE_PX, 2 * Math.abs(y))) slides.advance(x < 0 ? 1 : -1);
  });
}

function nextTheme() {
  const root = document.documentElement;
  root.dataset.theme = THEMES[(THEMES.indexOf(root.dataset.theme ?? "") + 1) % THEMES.length];
  byId("told", HTMLElement).textContent = `Theme: ${root.dataset.theme}`;
}

/** Blank the screen, or show it again. */
function blank() {
  document.body.classList.toggle("blank");
}

/** @param {Answers} answers */
function bindAnswers(answers) {
  const count = () => {
    const { length } = answers.lines;
    byId("kept", HTMLElement).textContent = length === 1 ? "1 answer" : `${length} answers`;
    byId("save", HTMLButtonElement).disabled = length === 0;
  };
  document.addEventListener("answered", count);
  byId("save", HTMLButtonElement).addEventListener("click", () =>
    answers.save(byId("student", HTMLInputElement).value.trim().slice(0, 60)),
  );
  byId("forget", HTMLButtonElement).addEventListener("click", () => {
    answers.forget();
    for (const form of document.forms) form.reset();
    count();
  });
  count();
}

/** Start the lecture. */
export function start() {
  const data = JSON.parse(byId("lucida-data", HTMLElement).textContent ?? "{}");
  const live = new LiveFigures(data);
  document.addEventListener("step", () => live.show(slides.step));
  const slides = new Slides();
  const answers = new Answers(data.title);
  for (const form of /** @type {NodeListOf<HTMLFormElement>} */ (
    document.querySelectorAll("form.exercise")
  )) {
    const exercise = data.exercises[form.dataset.step ?? ""];
    if (exercise) attach(form, exercise, answers);
  }
  bindAnswers(answers);
  /** @type {Record<string, () => void>} */
  const clicks = {
    previous: () => slides.advance(-1),
    next: () => slides.advance(1),
    theme: nextTheme,
    "open-overview": () => slides.openOverview(Number(slides.step.dataset.number) - 1),
    "open-notes": () => slides.notes.open(),
    print: () => print(),
  };
  for (const [id, action] of Object.entries(clicks))
    byId(id, HTMLButtonElement).addEventListener("click", action);
  for (const name of ["answers", "help"])
    byId(`open-${name}`, HTMLButtonElement).addEventListener("click", () =>
      byId(name, HTMLDialogElement).showModal(),
    );
  document.addEventListener("keydown", (event) => slides.key(event));
  bindSwipes(slides);
  const addressed = () => slides.go(slides.steps.findIndex((step) => `#${step.id}` === location.hash));
  addEventListener("hashchange", addressed);
  const isLight = matchMedia("(prefers-color-scheme: light)").matches;
  document.documentElement.dataset.theme = isLight ? "light" : "dark";
  document.body.classList.add("live");
  slides.show();
  addressed();
}
