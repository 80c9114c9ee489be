// The mistakes laboratory: a line of the program is made wrong, and its picture changes.

/**
 * Bring a program to life. One mistake is made at a time.
 * @param {Element} laboratory
 */
export function attachMistakes(laboratory) {
  const selects = [...laboratory.querySelectorAll("select")];
  const rows = /** @type {HTMLElement[]} */ ([...laboratory.querySelectorAll("[data-line]")]);
  const correct = new Map(rows.map((row) => [row, row.querySelector("code")?.textContent ?? ""]));
  const [right, student] = laboratory.querySelectorAll(".pair img");
  for (const select of selects)
    select.addEventListener("change", () => {
      for (const other of selects) if (other !== select) other.value = "";
      const template = laboratory.querySelector(`template[data-mistake="${select.value}"]`);
      const made = template instanceof HTMLTemplateElement ? template.content : null;
      const picture = made?.querySelector("img") ?? right;
      for (const name of ["src", "alt"])
        student.setAttribute(name, picture.getAttribute(name) ?? "");
      for (const [row, code] of correct) {
        const wrong = made?.querySelector(`[data-line="${row.dataset.line}"]`)?.textContent;
        const shown = row.querySelector("code");
        if (shown) shown.textContent = wrong ?? code;
        row.classList.toggle("wrong", wrong !== undefined);
      }
      const hint = made?.querySelector(".hint")?.cloneNode(true);
      laboratory.querySelector(".reply")?.replaceChildren(...(hint ? [hint] : []));
    });
}
