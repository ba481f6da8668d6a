// The form of an object's fields.

import { h, visible } from "./dom.js";

const FIELDS = [
  { field: "name", label: "name: what it is", kind: "text", maxlength: 200 },
  { field: "gain_db", label: "gain [dB]", kind: "number", min: -120, max: 60, step: 0.5 },
  { field: "material", label: "material", kind: "text" },
  { field: "thickness_m", label: "thickness [m]", kind: "number", min: 0.00002, max: 10, step: "any" },
  { field: "mass_kg", label: "mass [kg]", kind: "number", min: 0.0001, max: 1e6, step: "any" },
  { field: "vibrates", label: "vibrates", kind: "checkbox" },
  { field: "muted", label: "muted at the start", kind: "checkbox" },
  { field: "locked", label: "loops locked", kind: "checkbox" },
];
const STATE_FIELDS = [
  { field: "intensity", label: "intensity", kind: "number", min: 0.01, max: 1, step: 0.01 },
  { field: "pitch_hz", label: "pitch [Hz]", kind: "number", min: 10, max: 1000, step: 1 },
];

/** The form of an object. `describedBy` numbers ids of elements, since ids of objects are any text. */
export function makeForm(object, corrections, materials) {
  if (!object.editable) return h("p", { class: "quiet" }, "Nothing was inferred of this object, so nothing can be corrected.");
  const list = h("datalist", { id: "materials" }, materials.map((name) => h("option", { value: name })));
  const form = h("form", { class: "form", autocomplete: "off", submit: (event) => event.preventDefault() }, list);
  const rows = FIELDS.map((field) => makeField(object.id, field, null, corrections));
  form.append(...rows.map(({ element }) => element));
  for (const state of object.editable.states) {
    const parts = STATE_FIELDS.map((field) => makeField(object.id, field, state.name, corrections));
    form.append(h("fieldset", {}, h("legend", {}, "State ", h("bdi", {}, state.name)), parts.map(({ element }) => element)));
    rows.push(...parts);
  }
  const reset = h("button", {
    type: "button",
    class: "reset",
    click: () => {
      corrections.reset(object.id);
      for (const { show } of rows) show();
    },
  }, "Undo changes of this object");
  form.append(reset);
  return form;
}

function makeField(id, { field, label, kind, min, max, step, maxlength }, state, corrections) {
  const input = h("input", {
    type: kind,
    min,
    max,
    step,
    maxlength,
    list: field === "material" ? "materials" : null,
    placeholder: kind === "checkbox" ? null : "unknown",
    "data-field": field,
    "data-state": state === null ? null : visible(state),
  });
  const problem = h("span", { class: "problem", role: "alert" });
  const element = h("label", { class: `field ${kind}` }, h("span", {}, label), input, problem);

  function show() {
    const value = corrections.value(id, field, state);
    if (kind === "checkbox") input.checked = Boolean(value);
    else input.value = value ?? "";
    mark("");
  }
  function mark(text) {
    problem.textContent = text;
    input.setAttribute("aria-invalid", String(text !== ""));
    element.classList.toggle("changed", corrections.isChanged(id, field, state));
  }
  input.addEventListener("input", () => {
    if (kind === "checkbox") corrections.set(id, field, input.checked, state);
    else if (kind === "text") corrections.set(id, field, input.value.trim() || null, state);
    else {
      const value = input.value === "" ? null : Number(input.value);
      const isBad = input.validity.badInput || (value !== null && !(value >= min && value <= max));
      if (isBad) {
        // A number out of bounds is never saved; the document's value is restored.
        corrections.set(id, field, null, state);
        mark(`Give a number from ${min} to ${max}.`);
        return;
      }
      corrections.set(id, field, value, state);
    }
    mark("");
  });
  show();
  return { element, show };
}
