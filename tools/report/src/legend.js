// The legend: levels of the felt map with the threshold of touch and the colour of all other surfaces; widths of contacts.

import { NOTHING, colourAt, cssColour } from "./colour_scales.js";
import { CLASSES } from "./contact_lines.js";
import { h, replaceChildren } from "./dom.js";

const STEPS = 24;

export function makeLegend(element, { felt, objects }, store) {
  const onMap = new Set(felt.patches.map((patch) => patch.object));
  const grey = objects.every(({ id }) => onMap.has(id)) ? "nothing arrives" : "nothing arrives, or not on the map";
  const show = () => {
    const isFelt = store.get("show") === "felt";
    element.hidden = !isFelt && !store.get("contacts");
    const bar = h("div", { class: "legend-bar", "aria-hidden": "true" });
    const colours = Array.from({ length: STEPS + 1 }, (_, i) => cssColour(colourAt(store.get("scale"), i / STEPS)));
    bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
    const ticks = h("div", { class: "legend-ticks" });
    for (let level = Math.ceil(felt.low_db / 10) * 10; level <= felt.high_db; level += 10) {
      const tick = h("span", { class: level === 0 ? "tick threshold" : "tick" }, String(level));
      tick.style.left = `${((level - felt.low_db) / (felt.high_db - felt.low_db)) * 100}%`;
      ticks.append(tick);
    }
    const square = h("span", { class: "legend-square", "aria-hidden": "true" });
    square.style.background = cssColour(NOTHING);
    replaceChildren(
      element,
      isFelt && [
        h("div", { class: "legend-title" }, "Level over the threshold of touch [dB]"),
        h("div", { class: "legend-scale" }, bar, ticks),
        h("div", {}, square, `${grey}. Below 0 dB: not felt.`),
      ],
      store.get("contacts") && h("div", { class: "legend-contacts" }, "Contacts, strongest source:", CLASSES.map(lineOf)),
    );
  };
  store.on("contacts", show);
  store.on("scale", show);
  store.on("show", show);
  show();
}

function lineOf({ width, opacity, label }) {
  const line = h("span", { class: "legend-line", "aria-hidden": "true" });
  line.style.borderTopWidth = `${width}px`;
  line.style.opacity = String(opacity);
  return h("span", { class: "legend-item" }, line, label);
}
