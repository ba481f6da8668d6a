// Elements made without HTML text: names in a document are data and become only text nodes.

/** Make an element. Attributes that are functions become listeners, `class` and `data-*` are as in HTML. */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, "");
    else element.setAttribute(key, String(value));
  }
  append(element, children);
  return element;
}

function append(element, children) {
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    element.append(child instanceof Node ? child : visible(child));
  }
}

export function replaceChildren(element, ...children) {
  element.replaceChildren();
  append(element, children);
}

/** Text with control characters as escapes, so that an escape sequence is visible and has no effect. */
export function visible(text) {
  return String(text).replace(
    /[\u0000-\u0008\u000b-\u001f\u007f-\u009f]/g,
    (mark) => `\\x${mark.charCodeAt(0).toString(16).padStart(2, "0")}`,
  );
}

/** A name inside other text: `bdi` keeps right-to-left marks from reordering its neighbours. */
export function nameOf(text) {
  return h("bdi", { class: "name" }, text);
}

/** Objects from a source to a touched one, as names with arrows between them. */
export function pathOf(names) {
  return h("span", { class: "path" }, names.map((name, i) => [i > 0 && " \u2192 ", nameOf(name)]));
}

/** A name where only text is possible, such as a label of an element or the page's title. */
export function isolated(text) {
  return `\u2068${visible(text).replace(/[\u202a-\u202e\u2066-\u2069]/g, "")}\u2069`;
}

/** A number as text: three digits, powers of ten from a million. */
export function shownNumber(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-3)) {
    const [digits, power] = value.toExponential(2).split("e");
    return `${Number(digits)}e${Number(power)}`;
  }
  return String(Number(value.toPrecision(4)));
}
