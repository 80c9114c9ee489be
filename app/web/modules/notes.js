// The lecturer's own window: the step's text with its answers, notes, what comes next, the time.
// It is written by the page that opened it, so it works from a disk, and needs no messages.

/**
 * @typedef {object} Given the lecture, as it is given
 * @property {HTMLElement[]} steps @property {number} number
 * @property {(by: 1 | -1) => void} advance @property {(event: KeyboardEvent) => void} key
 */

export class Notes {
  /** @param {Given} slides */
  constructor(slides) {
    this.slides = slides;
    /** @type {Window | null} */
    this.window = null;
    this.begun = Date.now();
  }

  open() {
    this.window = window.open("", "lucida-notes", "width=900,height=700");
    if (!this.window) return;
    const page = this.window.document;
    page.title = `Notes: ${document.title}`;
    page.documentElement.lang = document.documentElement.lang;
    const style = page.createElement("style");
    style.textContent = document.querySelector("style")?.textContent ?? "";
    page.head.replaceChildren(style);
    page.addEventListener("keydown", (event) => this.slides.key(event));
    this.show();
    this.tick();
    this.window.focus();
  }

  /** Show the step that is given. */
  show() {
    const page = this.window?.document;
    if (!page || this.window?.closed) return;
    const { steps, number } = this.slides;
    page.documentElement.dataset.theme = document.documentElement.dataset.theme ?? "";
    const bar = page.createElement("p");
    bar.className = "notes-bar";
    bar.append(
      button(page, "Previous", () => this.slides.advance(-1)),
      button(page, "Next", () => this.slides.advance(1)),
      ` ${steps[number].dataset.number} / ${steps[steps.length - 1].dataset.number} `,
      Object.assign(page.createElement("output"), { id: "clock" }),
    );
    const main = page.createElement("main");
    main.append(bar, ...parts(page, steps[number], "h2, .text, .asked, .solution, .notes"));
    const next = steps[number + 1];
    if (next) {
      const heading = page.createElement("h3");
      heading.textContent = `Next: ${next.querySelector("h2")?.textContent ?? ""}`;
      main.append(heading, ...parts(page, next, ".text"));
    }
    page.body.className = "notes-window";
    page.body.replaceChildren(main);
    this.clock();
  }

  tick() {
    if (!this.window || this.window.closed) return;
    this.clock();
    setTimeout(() => this.tick(), 1000);
  }

  clock() {
    const seconds = Math.floor((Date.now() - this.begun) / 1000);
    const shown = this.window?.document.getElementById("clock");
    const minutes = Math.floor(seconds / 60);
    const time = new Date().toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });
    if (shown) shown.textContent = `${minutes}:${String(seconds % 60).padStart(2, "0")} since the beginning, ${time}`;
  }
}

/** Return copies of a step's parts, all unfolded. @param {Document} page @param {Element} step
 * @param {string} which @returns {Node[]} */
function parts(page, step, which) {
  return [...step.querySelectorAll(which)].map((part) => {
    const copy = /** @type {Element} */ (page.importNode(part, true));
    for (const one of [copy, ...copy.querySelectorAll("*")]) {
      one.removeAttribute("hidden");
      one.removeAttribute("id");
    }
    if (copy.matches("details")) copy.setAttribute("open", "");
    return copy;
  });
}

/** @param {Document} page @param {string} name @param {() => void} action */
function button(page, name, action) {
  const made = page.createElement("button");
  made.textContent = name;
  made.addEventListener("click", action);
  return made;
}
