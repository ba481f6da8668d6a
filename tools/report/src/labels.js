// Names of sources and of the selection over the picture: plain elements that follow their objects.

import { h, nameOf } from "./dom.js";

const GAP_PX = 4;

export function makeLabels(layer, report, onSelect) {
  const labels = new Map();
  const labelOf = (id) => {
    if (!labels.has(id)) {
      // Not reached by Tab and hidden from screen readers, since the table of objects has the same names.
      const element = h("span", { class: "label", "aria-hidden": "true", click: () => onSelect(id) }, nameOf(report.name(id)));
      layer.append(element);
      labels.set(id, { element, width: 0, height: 0 });
    }
    return labels.get(id);
  };
  return {
    /** Place labels at [{id, x, y, isSelected, isSource}], the most important first. Labels that overlap are hidden. */
    place(wanted, width) {
      const taken = [];
      const shown = new Set();
      for (const { id, x, y, isSelected, isSource } of wanted) {
        const label = labelOf(id);
        label.element.hidden = false;
        label.element.classList.toggle("selected", isSelected);
        label.element.classList.toggle("source", isSource);
        if (!label.width) {
          label.width = label.element.offsetWidth;
          label.height = label.element.offsetHeight;
        }
        const left = Math.min(Math.max(x - label.width / 2, 2), Math.max(width - label.width - 2, 2));
        let top = Math.max(y - label.height - 8, 2);
        const hits = () =>
          taken.find(
            (other) =>
              left < other.left + other.width + GAP_PX &&
              left + label.width + GAP_PX > other.left &&
              top < other.top + other.height + GAP_PX &&
              top + label.height + GAP_PX > other.top,
          );
        for (let tries = 0; tries < 3 && hits(); tries += 1) top = hits().top - label.height - GAP_PX;
        if ((hits() || top < 0) && !isSelected) continue;
        taken.push({ left, top, width: label.width, height: label.height });
        label.element.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
        shown.add(id);
      }
      for (const [id, { element }] of labels) if (!shown.has(id)) element.hidden = true;
    },
  };
}
