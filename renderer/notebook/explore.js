// The live widget: an image that the mouse and the keys move, sliders, and a marked pixel's ray.
//
// The kernel traces the images (widget.py). The browser asks for two of them at most before it has
// an answer, with all that the user did since the last question. Therefore nothing queues up while
// the kernel is busy, and the way there and back costs no time in which nothing is traced.

const HALF_TURN = Math.PI; // a drag over the image's whole height
const KEY_TURN = Math.PI / 36;
const KEY_PAN = 0.05; // of the image's height
const CLICK = 3; // pixels of the screen that a click may move
const REST_MS = 120; // without a change, before the full image
const AGAIN_MS = 100; // before asking again for an image that was not ready
const MOST_ASKED = 2;
const BUSY_MS = 700; // without an answer, before the status line says so
const STEPS = 1000; // of a slider

const HINT =
  "Drag: orbit. Shift or right button: pan. Wheel: nearer, farther. Click: a pixel's ray. " +
  "Keys: arrows, Shift+arrows, + and -, Enter (the middle pixel), Escape, Home (reset).";

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// Add a move to those that are not sent yet, merged with the last one if they are of one kind.
function add(moves, move) {
  const last = moves.at(-1);
  const same = last && ["do", "name", "drag"].every((key) => last[key] === move[key]);
  if (!same || move.do === "project") {
    moves.push(move);
  } else if (move.do === "orbit") {
    last.right += move.right;
    last.up += move.up;
  } else if (move.do === "zoom") {
    Object.assign(last, move, { steps: last.steps + move.steps });
  } else {
    Object.assign(last, move, move.do === "pan" ? { start: last.start } : {});
  }
}

function render({ model, el }) {
  const [width, height] = model.get("_size");
  const canvas = element("canvas", { width, height, tabIndex: 0 });
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", `Ray traced image, ${width} x ${height}. ${HINT}`);
  const mark = element("div", { className: "mark", hidden: true });
  const status = element("div", { className: "hint" });
  status.setAttribute("role", "status");
  const problem = element("div", { className: "problem" });
  problem.setAttribute("role", "alert");
  const projection = element("select", {}, ...["perspective", "parallel"].map((name) => new Option(name)));
  projection.setAttribute("aria-label", "projection");
  const reset = element("button", { type: "button", textContent: "Reset" });
  const groups = element("div", { className: "groups" });
  const hit = element("table", { className: "hit" });
  hit.setAttribute("aria-live", "polite");
  const stage = element("div", { className: "stage" }, canvas, mark);
  const root = element(
    "div",
    { className: "lucida" },
    element("div", { className: "picture" }, stage, problem, status),
    element(
      "div",
      { className: "panel" },
      element("div", { className: "row" }, "projection", projection, reset),
      groups,
      hit,
    ),
  );
  root.dataset.lmSuppressShortcuts = "true"; // keys are ours, not JupyterLab's
  el.append(root);
  status.textContent = HINT;

  // Asking.

  const view = Math.random(); // several views may show one model
  let moves = [];
  let count = 0;
  const asked = new Set(); // questions without an answer
  let isFull = false; // the full image has come, or is asked for
  let restTimer = 0;
  let busyTimer = 0;
  let isClosed = false;

  function ask(moving) {
    if (asked.size >= (moving ? MOST_ASKED : 1) || isClosed) return;
    clearTimeout(restTimer);
    const question = `${view}:${++count}`;
    asked.add(question);
    isFull = !moving;
    model.send({ ask: question, moves, moving });
    moves = [];
    expect();
  }

  function expect() {
    clearTimeout(busyTimer);
    if (asked.size) busyTimer = setTimeout(() => (status.textContent = "The kernel is busy."), BUSY_MS);
  }

  function act(move) {
    problem.textContent = "";
    add(moves, move);
    ask(move.do !== "mark");
  }

  function rest(ms, moving = false) {
    clearTimeout(restTimer);
    restTimer = setTimeout(() => ask(moving), ms);
  }

  function onAnswer(answer, buffers) {
    if (answer.sliders) showNumbers(answer);
    if (answer.problem) problem.textContent = answer.problem;
    if (answer.type) {
      showImage(new Blob([buffers[0]], { type: answer.type }), answer.factor);
      showHit(answer.hit);
    }
    if (!asked.delete(answer.answer)) return; // another view's, or one that a cell has sent
    expect();
    status.textContent = answer.pending ?? HINT;
    if (moves.length) ask(moves.some((move) => move.do !== "mark"));
    else if (asked.size) return;
    else if (answer.pending) rest(AGAIN_MS, !isFull);
    else if (!answer.full && answer.type) rest(REST_MS);
  }

  const onChange = () => {
    isFull = false;
    if (!asked.size) rest(REST_MS);
  };
  model.on("msg:custom", onAnswer);
  model.on("change:camera", onChange);
  model.on("change:pixel", onChange);

  // Showing.

  const context = canvas.getContext("2d");
  let rows = []; // of sliders
  let begun = 0;
  let drawn = 0;

  async function showImage(blob, factor) {
    const number = ++begun;
    const bitmap = await createImageBitmap(blob);
    if (number < drawn) return; // a newer one was decoded before
    drawn = number;
    context.imageSmoothingEnabled = false;
    context.drawImage(bitmap, 0, 0, width, height);
    bitmap.close();
    canvas.dataset.images = drawn;
    canvas.dataset.factor = factor;
  }

  function showHit(found) {
    hit.classList.toggle("old", !found && !mark.hidden); // a coarse image has no new numbers
    if (mark.hidden) hit.replaceChildren();
    if (!found) return;
    const cells = found.map(([name, text]) =>
      element("tr", {}, element("th", { textContent: name, scope: "row" }), element("td", { textContent: text })),
    );
    if (found.some(([name]) => name === "t")) {
      const relation = element("td", { textContent: "point = origin + t * direction", colSpan: 2 });
      cells.push(element("tr", {}, relation));
    }
    hit.replaceChildren(...cells);
  }

  function showNumbers({ sliders, projection: name, pixel }) {
    projection.value = name;
    mark.hidden = !pixel;
    if (pixel) {
      mark.style.left = `${((pixel[1] + 0.5) / width) * 100}%`;
      mark.style.top = `${((pixel[0] + 0.5) / height) * 100}%`;
    }
    const names = sliders.map((slider) => slider.name).join();
    if (groups.dataset.names !== names) {
      rows = sliders.map(newRow);
      const boxes = {}; // one a vector, one for single numbers
      rows.forEach((row, k) => {
        const [vector, part] = sliders[k].name.split(".");
        (boxes[part ? vector : ""] ??= element("div")).append(row);
      });
      groups.replaceChildren(...Object.values(boxes));
      groups.dataset.names = names;
    }
    sliders.forEach((slider, k) => rows[k].show(slider));
  }

  function newRow({ name, label }) {
    const range = element("input", { type: "range", min: 0, max: STEPS, step: "any" });
    const number = element("input", { type: "number", step: "any" });
    for (const input of [range, number]) input.setAttribute("aria-label", label);
    const row = element("label", { className: "row" }, label, range, number);
    let now;
    row.show = (slider) => {
      now = slider;
      const { value, low, high } = slider;
      const part = slider.logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
      if (!range.matches(":active")) range.value = part * STEPS;
      range.setAttribute("aria-valuetext", short(value));
      if (document.activeElement !== number && root.getRootNode().activeElement !== number) number.value = short(value);
    };
    range.oninput = () => {
      const { low, high, logarithmic } = now;
      const part = range.value / STEPS;
      const value = logarithmic ? low * (high / low) ** part : low + part * (high - low);
      act({ do: "set", name, value: Number(value.toPrecision(6)) });
    };
    let typed = "";
    const enter = () => {
      if (number.value && number.value !== typed) act({ do: "set", name, value: Number(number.value) });
      typed = number.value;
    };
    number.onfocus = () => (typed = number.value);
    number.onchange = enter;
    number.onkeydown = (event) => {
      if (event.key === "Enter") enter(); // notebooks may keep Enter from becoming a change
    };
    number.onblur = () => (number.value = short(now.value));
    return row;
  }

  const short = (value) => String(Number(value.toPrecision(6)));

  // The mouse and the keys.

  let drag = null;

  // Return [row, column] of a place on the screen; integers are pixels' centres.
  function place(event) {
    const box = canvas.getBoundingClientRect();
    return [
      ((event.clientY - box.top) / box.height) * height - 0.5,
      ((event.clientX - box.left) / box.width) * width - 0.5,
    ];
  }

  canvas.onpointerdown = (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const kind = event.button === 0 && !event.shiftKey ? "orbit" : "pan";
    drag = { kind, id: Math.random(), start: place(event), first: event, last: event, moved: false };
  };

  canvas.onpointermove = (event) => {
    if (!drag) return;
    const { first, last, kind } = drag;
    const far = Math.hypot(event.clientX - first.clientX, event.clientY - first.clientY) > CLICK;
    drag.moved ||= far;
    if (!drag.moved) return;
    const angle = HALF_TURN / canvas.getBoundingClientRect().height;
    const right = (event.clientX - last.clientX) * angle;
    const up = (last.clientY - event.clientY) * angle;
    if (kind === "orbit") act({ do: "orbit", right, up });
    else {
      act({ do: "pan", drag: drag.id, start: drag.start, end: place(event) });
      drag.start = place(event);
    }
    drag.last = event;
  };

  canvas.onpointerup = (event) => {
    if (drag && !drag.moved && event.button === 0) {
      const [row, column] = place(event).map(Math.round);
      if (row >= 0 && row < height && column >= 0 && column < width) act({ do: "mark", at: [row, column] });
    }
    drag = null;
  };
  canvas.onpointercancel = () => (drag = null);
  canvas.oncontextmenu = (event) => {
    event.preventDefault();
    event.stopPropagation();
  };

  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 0 ? event.deltaY / 100 : event.deltaY / 3;
      act({ do: "zoom", at: place(event), steps: -lines });
    },
    { passive: false },
  );

  const middle = [(height - 1) / 2, (width - 1) / 2];
  const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

  canvas.onkeydown = (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const [right, up] = ARROWS[event.key] ?? [];
    if (right !== undefined && event.shiftKey) {
      const end = [middle[0] - up * KEY_PAN * height, middle[1] + right * KEY_PAN * height];
      act({ do: "pan", drag: Math.random(), start: middle, end });
    } else if (right !== undefined) act({ do: "orbit", right: right * KEY_TURN, up: up * KEY_TURN });
    else if (event.key === "+" || event.key === "=") act({ do: "zoom", at: middle, steps: 1 });
    else if (event.key === "-") act({ do: "zoom", at: middle, steps: -1 });
    else if (event.key === "Enter") act({ do: "mark", at: middle.map(Math.floor) });
    else if (event.key === "Escape") act({ do: "mark", at: null });
    else if (event.key === "Home") act({ do: "reset" });
    else return;
    event.preventDefault();
    event.stopPropagation();
  };

  projection.onchange = () => act({ do: "project" });
  reset.onclick = () => act({ do: "reset" });
  ask(false);

  return () => {
    isClosed = true;
    clearTimeout(restTimer);
    clearTimeout(busyTimer);
    model.off("msg:custom", onAnswer);
    model.off("change:camera", onChange);
    model.off("change:pixel", onChange);
  };
}

export default { render };
