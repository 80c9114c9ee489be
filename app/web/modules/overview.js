// The overview: all steps with their pictures, to go to one.

/** Put the steps' pictures into the overview, and return what opens it at a step. @param {Element[]} steps @returns {(number: number) => void} */
export function overview(steps) {
  const dialog = /** @type {HTMLDialogElement} */ (document.getElementById("overview"));
  const links = /** @type {HTMLElement[]} */ ([...dialog.querySelectorAll("a")]);
  links.forEach((link, number) => {
    const picture = steps[number].querySelector(".view :is(img, svg)")?.cloneNode(true);
    if (picture instanceof Element) {
      for (const name of ["role", "aria-label"]) picture.removeAttribute(name);
      picture.setAttribute("aria-hidden", "true");
      picture.setAttribute("alt", "");
      link.prepend(picture);
    }
    link.addEventListener("click", () => dialog.close());
  });
  return (number) => {
    links.forEach((link) => link.removeAttribute("aria-current"));
    links[number].setAttribute("aria-current", "step");
    dialog.showModal();
    links[number].focus();
  };
}
