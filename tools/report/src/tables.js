// Tables that can be sorted, searched and navigated by keys.

import { h, nameOf, replaceChildren } from "./dom.js";

const collator = new Intl.Collator(undefined, { numeric: true });

/** Order of two cells: numbers by size, texts by alphabet, unknown values last in both directions. */
export function compared(a, b, direction) {
  const [noA, noB] = [a === null || a === undefined || a === "", b === null || b === undefined || b === ""];
  if (noA || noB) return Number(noA) - Number(noB);
  const order = typeof a === "number" && typeof b === "number" ? a - b : collator.compare(String(a), String(b));
  return direction * order;
}

/**
 * A table: {element, show()}.
 *
 * columns: [{label, value(row), shown(row)?}]: `value` is sorted and searched, `shown` is the shown text if it differs.
 * idOf(row): the object that a row selects, or null.
 */
export function makeTable({ label, columns, rows, search, idOf, store, onFocus }) {
  let sorted = { column: -1, direction: 1 };
  let active = null;
  const body = h("tbody");
  const buttons = columns.map((column, i) => h("button", { type: "button", click: () => sortBy(i) }, column.label));
  const heads = buttons.map((button) => h("th", { scope: "col", "aria-sort": "none" }, button));
  const count = h("p", { class: "quiet count", role: "status" });
  const element = h(
    "div",
    { class: "table-box" },
    h("table", { class: "list", "aria-label": label }, h("thead", {}, h("tr", {}, heads)), body),
    count,
  );
  const textsOf = () => new Map(rows.map((row) => [row, columns.map((column) => textOf(column, row)).join("\n").toLowerCase()]));
  let texts = textsOf();
  const elements = new Map();

  function rowOf(row) {
    if (elements.has(row)) return elements.get(row);
    const id = idOf(row);
    const made = h(
      "tr",
      { tabindex: "-1", focus: () => activate(made), click: () => id !== null && store.set("selected", id), dblclick: () => id !== null && onFocus(id) },
      columns.map((column) => {
        const value = column.value(row);
        return h("td", { class: typeof value === "number" ? "number" : null }, nameOf(textOf(column, row)));
      }),
    );
    made.keyed = id;
    elements.set(row, made);
    return made;
  }

  function activate(row) {
    if (active) active.tabIndex = -1;
    active = row;
    if (active) active.tabIndex = 0;
  }

  function show() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = rows.filter((row) => words.every((word) => texts.get(row).includes(word)));
    if (sorted.column >= 0) {
      const { value } = columns[sorted.column];
      found.sort((a, b) => compared(value(a), value(b), sorted.direction));
    }
    replaceChildren(body, found.map(rowOf));
    count.textContent = found.length === rows.length ? `${rows.length} rows` : `${found.length} of ${rows.length} rows`;
    markSelected(false);
    if (!active?.isConnected) activate(body.firstElementChild);
  }

  function sortBy(i) {
    sorted = { column: i, direction: sorted.column === i ? -sorted.direction : 1 };
    heads.forEach((head, j) => {
      head.setAttribute("aria-sort", j !== i ? "none" : sorted.direction > 0 ? "ascending" : "descending");
    });
    show();
  }

  function markSelected(isMoved) {
    const id = store.get("selected");
    for (const row of elements.values()) {
      const isSelected = row.keyed !== null && row.keyed === id;
      row.setAttribute("aria-selected", String(isSelected));
      if (!isSelected || !row.isConnected) continue;
      if (isMoved) {
        activate(row);
        const box = element;
        const top = row.offsetTop - (element.querySelector("thead")?.offsetHeight ?? 0);
        if (top < box.scrollTop) box.scrollTop = top;
        else if (row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight) {
          box.scrollTop = row.offsetTop + row.offsetHeight - box.clientHeight;
        }
      }
    }
  }

  body.addEventListener("keydown", (event) => {
    const row = event.target.closest("tr");
    const moves = { ArrowDown: row?.nextElementSibling, ArrowUp: row?.previousElementSibling, Home: body.firstElementChild, End: body.lastElementChild };
    if (event.key in moves) {
      event.preventDefault();
      moves[event.key]?.focus();
    } else if (event.key === "Enter" && row?.keyed !== null) {
      event.preventDefault();
      store.set("selected", row.keyed);
    }
  });
  store.on("selected", () => markSelected(true));
  return {
    element,
    show,
    /** Read all values again. */
    refresh() {
      texts = textsOf();
      elements.clear();
      if (element.isConnected) show();
    },
  };
}

const textOf = (column, row) => String((column.shown ?? column.value)(row) ?? "–");
