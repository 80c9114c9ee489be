// Elements of the page. All text is inserted as text nodes.

/**
 * Return a new element.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag @param {Record<string, string | boolean>} [attributes] @param {(Node | string)[]} content
 * @returns {HTMLElementTagNameMap[K]}
 */
export function element(tag, attributes = {}, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(name, "");
    else if (value !== false) made.setAttribute(name, value);
  }
  made.append(...content);
  return made;
}

/** Return a new element of SVG. @param {string} tag @param {Record<string, string | number>} attributes @param {(Node | string)[]} content */
export function svgElement(tag, attributes = {}, ...content) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...content);
  return made;
}

/** Return a number as text, with at most so many digits. @param {number} x @param {number} [digits] */
export function numberText(x, digits = 4) {
  return String(Number(x.toPrecision(digits))).replace("-", "\u2212");
}

/** Return numbers in parentheses. @param {Iterable<number>} numbers @param {number} [digits] */
export const vectorText = (numbers, digits = 4) => `(${Array.from(numbers, (x) => numberText(x, digits)).join(", ")})`;
