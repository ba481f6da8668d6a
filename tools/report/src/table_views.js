// The tables of the page: objects, contacts, credits.

import { h, replaceChildren } from "./dom.js";
import { makeTable } from "./tables.js";

const CREDITS = 2;

export function makeTableViews({ element, report, felt, store, onFocus }) {
  const search = h("input", { type: "search", placeholder: "Search", "aria-label": "Search in the table", class: "search" });
  const level = (object) => felt.highest(object.id, store.get("choice"));
  const db = (value) => (value === null ? null : value.toFixed(1));
  const { low_db, high_db } = report.felt;
  const shownLevel = (object) => {
    const value = level(object);
    if (value === null) return felt.byObject.has(object.id) ? "nothing" : "not on the map";
    if (value <= low_db) return `≤ ${low_db}`;
    return value >= high_db ? `≥ ${high_db}` : db(value);
  };
  const whole = { search, store, onFocus };
  const tables = [
    makeTable({
      ...whole,
      label: "Objects",
      rows: report.objects,
      idOf: (object) => object.id,
      columns: [
        { label: "name", value: (object) => object.name || object.id },
        { label: "object type", value: (object) => object.category },
        { label: "material", value: (object) => object.material },
        { label: "confidence", value: (object) => object.confidence, shown: (object) => `${Math.round(100 * object.confidence)} %` },
        { label: "source", value: (object) => (object.is_source ? object.states.map((state) => state.name).join(", ") || "yes" : "") },
        { label: "felt [dB]", value: level, shown: shownLevel },
        { label: "corrected", value: (object) => (object.override ? Object.keys(object.override).join(", ") : "") },
      ],
    }),
    makeTable({
      ...whole,
      label: "Contacts",
      rows: report.contacts,
      idOf: (contact) => contact.a,
      columns: [
        { label: "object", value: (contact) => report.name(contact.a) },
        { label: "touches", value: (contact) => report.name(contact.b) },
        { label: "passes [dB]", value: (contact) => contact.passes_db, shown: (contact) => db(contact.passes_db) },
        { label: "at [m]", value: (contact) => contact.point_m.map((x) => x.toFixed(2)).join(", ") },
      ],
    }),
    makeTable({
      ...whole,
      label: "Credits",
      rows: report.credits,
      idOf: () => null,
      columns: [
        { label: "used for", value: ([used]) => used },
        { label: "title, author, licence", value: ([, text]) => text },
      ],
    }),
  ];
  store.on("choice", () => tables[0].refresh());
  const text = document.querySelector("#licences");
  text.hidden = false;
  const licences = h("details", { class: "licences" }, h("summary", {}, "Licences of the software in this page"), text);
  const labels = ["Objects", "Contacts", "Credits"];
  let chosen = 0;
  const box = h("div", { class: "table-place", role: "tabpanel", "aria-label": "Table" });
  const tabs = labels.map((label, i) =>
    h("button", { type: "button", role: "tab", click: () => choose(i) }, `${label} (${[report.objects, report.contacts, report.credits][i].length})`),
  );
  function choose(i) {
    chosen = i;
    tabs.forEach((tab, j) => {
      tab.setAttribute("aria-selected", String(j === i));
      tab.tabIndex = j === i ? 0 : -1;
    });
    replaceChildren(box, tables[i].element, i === CREDITS && licences);
    tables[i].show();
  }
  tabs.forEach((tab, i) =>
    tab.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      const next = (i + step + tabs.length) % tabs.length;
      choose(next);
      tabs[next].focus();
    }),
  );
  search.addEventListener("input", () => tables[chosen].show());
  search.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown") {
      event.preventDefault();
      box.querySelector("tbody tr")?.focus();
    }
  });
  replaceChildren(element, h("div", { class: "row table-bar" }, h("div", { class: "tabs", role: "tablist", "aria-label": "Tables" }, tabs), search), box);
  choose(0);
  return { search };
}
