// The panel of the selected object, or of the scene if nothing is selected.

import { h, nameOf, pathOf, replaceChildren, shownNumber, visible } from "./dom.js";
import { makeForm } from "./editing.js";
import { shownLevel } from "./felt_levels.js";
import { makePlayers } from "./players.js";
import { drawSpectrum } from "./spectrum.js";

export function makePanel({ element, report, felt, store, corrections, onFocus }) {
  const materials = [...new Set(report.objects.map((object) => object.editable?.material).filter(Boolean))].sort();
  let players = null;
  let spectrum = null;

  function show() {
    players?.stop();
    spectrum?.chart.destroy();
    players = null;
    spectrum = null;
    const object = report.byId.get(store.get("selected"));
    replaceChildren(element, object ? objectParts(object) : sceneParts());
    element.scrollTop = 0;
    if (object) showState(object, object.states[0]);
  }

  function sceneParts() {
    const made = Object.entries(report.made ?? {}).filter(([, value]) => value !== null && value !== "");
    return [
      h("h2", {}, nameOf(report.scene)),
      h("p", {}, "Select an object in the picture or in the table."),
      table(["", ""], [["type of scene", report.category], ...report.counters, ...made], "Scene"),
      h("h3", {}, "Sources"),
      report.felt.sources.length > 1
        ? h("ul", { class: "plain" }, report.objects.filter((object) => object.is_source).map((object) => h("li", {}, link(object.id))))
        : h("p", { class: "quiet" }, "Nothing in this scene vibrates."),
      report.warnings.length > 0 && section("Warnings", [h("ul", {}, report.warnings.map((text) => h("li", {}, nameOf(text))))]),
      report.left_out.length > 0 && section("Left out, and why", [report.left_out.map(leftOut)]),
      section("What the bake took", [account()]),
      h("h3", {}, "Keys"),
      table(
        ["", ""],
        [
          ["F", "camera to the selection, or to the whole scene"],
          ["Space", "play or pause"],
          ["arrows", "turn the picture, or move in a table"],
          ["+ and -", "zoom in the picture"],
          ["Enter", "select the row of a table"],
          ["/", "search"],
          ["Esc", "select nothing"],
        ],
        "Keys",
      ),
    ].filter(Boolean);
  }

  function leftOut({ why, objects }) {
    return h("details", {}, h("summary", {}, `${objects.length} `, nameOf(why)), h("p", { class: "plain" }, objects.map((id) => [link(id), " "])));
  }

  function account() {
    if (!report.account) return h("p", { class: "quiet" }, "Unknown: no account of the bake was beside the bundle.");
    const { rows, problems } = report.account;
    return [
      table(["", ""], rows, "What the bake took"),
      problems.length > 0 && h("details", {}, h("summary", {}, `${problems.length} problems and doubts`), table(["", ""], problems, "Problems and doubts")),
    ];
  }

  function objectParts(object) {
    const marks = [
      object.is_source && "source",
      object.override && "corrected by a person",
      object.editable?.muted && "muted",
      object.editable?.locked && "locked",
    ].filter(Boolean);
    return [
      h("header", { class: "panel-head" }, h("h2", {}, nameOf(object.name || object.id)), h("button", { type: "button", title: "F", click: () => onFocus(object.id) }, "Focus")),
      h("p", { class: "quiet" }, "id ", h("code", {}, nameOf(object.id)), marks.map((mark) => [" ", h("span", { class: "mark" }, mark)])),
      object.pictures.length > 0 && h("div", { class: "pictures" }, object.pictures.map((picture, i) => h("img", { src: picture, alt: `Picture ${i + 1} of the object` }))),
      h("p", { class: "felt-here" }),
      object.states.length > 0 && h("section", { class: "states", "aria-label": "States" }, stateTabs(object), h("div", { class: "state" })),
      section("Inferred", [
        confidence(object.confidence),
        table(["", "value", "from"], object.facts, "What was inferred"),
        object.reasons.length > 0 && h("details", { open: true }, h("summary", {}, "Reasons"), table(["", ""], object.reasons, "Reasons")),
      ]),
      object.constants.length > 0 &&
        section("Material constants", [
          table(
            ["", "unit", "value", "table"],
            object.constants.map(([label, unit, value, known]) => [label, unit, shownNumber(value), known === null ? "not in the table" : shownNumber(known)]),
            "Material constants",
            (row) => (row[3] !== "not in the table" && row[2] !== row[3] ? "differs" : ""),
          ),
        ]),
      object.override && section("Corrected by a person", [table(["", ""], Object.entries(object.override).map(([field, value]) => [field, shownValue(value)]), "Corrections")]),
      section("Edit", [makeForm(object, corrections, materials)]),
      contactsOf(object),
    ].filter(Boolean);
  }

  function stateTabs(object) {
    return h(
      "div",
      { class: "row tabs", role: "group", "aria-label": "State" },
      object.states.map((state, i) =>
        h("button", { type: "button", "aria-pressed": String(i === 0), click: (event) => {
          for (const button of event.target.closest(".tabs").children) button.setAttribute("aria-pressed", String(button.contains(event.target)));
          showState(object, state);
        } }, nameOf(state.name)),
      ),
    );
  }

  function showState(object, state) {
    showFelt();
    if (!state) return;
    players?.stop();
    spectrum?.chart.destroy();
    players = state.sound && state.touch ? makePlayers(state) : null;
    const chart = state.spectrum ? h("div", { class: "spectrum" }) : null;
    const box = element.querySelector(".state");
    replaceChildren(box, [
      h("p", {}, nameOf(state.sentence)),
      table(["", ""], stateRows(state), "State"),
      players ? players.element : h("p", { class: "quiet" }, "This state has no loop."),
      chart && h("h4", {}, "Spectrum of touch, in twelfths of octaves"),
      chart,
      state.credit && h("p", { class: "quiet" }, "Sound: ", nameOf(state.credit)),
      state.choices && h("details", {}, h("summary", {}, "Candidates"), h("pre", { tabindex: "0" }, state.choices)),
    ]);
    spectrum = chart ? { box: chart, data: state.spectrum, chart: drawSpectrum(chart, state.spectrum) } : null;
  }

  function stateRows(state) {
    const hz = (value) => (value === null || value === undefined ? null : `${shownNumber(value)} Hz`);
    const level = (value) => (value === null || value === undefined ? null : `${value.toFixed(1)} dB`);
    const touch = (felt) => {
      if (!felt?.target_hz) return null;
      const isMoved = felt.own_hz && Math.abs(felt.own_hz - felt.target_hz) >= 1;
      return `${hz(felt.target_hz)}${isMoved ? `, moved from ${hz(felt.own_hz)}` : ""}${felt.rough_hz ? `, rough at ${hz(felt.rough_hz)}` : ""}`;
    };
    return [
      ["intensity", shownNumber(state.intensity)],
      ["keywords", state.keywords],
      ["needs contact with", state.needs_contact],
      ["level at the source", level(state.felt?.level_db)],
      ["level wanted", level(state.felt?.asked_level_db)],
      ["frequency of the sound", hz(state.felt?.raw_hz)],
      ["frequency of touch", touch(state.felt)],
    ].filter(([, value]) => value);
  }

  function showFelt() {
    const box = element.querySelector(".felt-here");
    const id = store.get("selected");
    if (!box || id === null) return;
    const choice = store.get("choice");
    const what = choice.source === report.felt.sources[0] ? "all sources" : nameOf(report.name(choice.source));
    const where = choice.band === report.felt.bands[0] ? "" : `, ${choice.band}`;
    const path = felt.arriving(felt.loudest(id, choice), choice)[0]?.path;
    replaceChildren(box, felt.byObject.has(id)
      ? ["Highest level on it, of ", what, where, ": ", h("strong", {}, shownLevel(felt.highest(id, choice), report.felt)), path?.length > 1 && [choice.source === report.felt.sources[0] ? ", the strongest over " : ", over ", pathOf(path.map(report.name))]]
      : "No point of the felt map lies on it.");
  }

  function contactsOf(object) {
    const rows = report.contactsOf.get(object.id);
    if (rows.length === 0) return null;
    const strongest = new Map();
    for (const { other, passes_db } of rows) {
      const earlier = strongest.get(other);
      if (earlier === undefined || (passes_db ?? -Infinity) > (earlier ?? -Infinity)) strongest.set(other, passes_db);
    }
    return section("Contacts", [
      table(["object", "passes"], [...strongest].map(([other, passes_db]) => [link(other), passes_db === null ? "nothing" : `${passes_db.toFixed(1)} dB`]), "Contacts"),
    ]);
  }

  function link(id) {
    return h("button", { type: "button", class: "link", click: () => store.set("selected", id) }, nameOf(report.name(id)));
  }

  store.on("selected", show);
  store.on("choice", showFelt);
  show();
  return {
    togglePlayers: () => players?.toggle(),
    repaint() {
      players?.repaint();
      if (spectrum) {
        spectrum.chart.destroy();
        spectrum.chart = drawSpectrum(spectrum.box, spectrum.data);
      }
    },
    resize() {
      if (spectrum) spectrum.chart.setSize({ width: Math.max(spectrum.box.clientWidth, 200), height: spectrum.chart.height });
    },
  };
}

const section = (title, parts) => h("section", {}, h("h3", {}, title), parts);

function confidence(value) {
  const bar = h("meter", { min: 0, max: 1, value, "aria-label": "confidence" });
  return h("p", { class: "confidence" }, "confidence ", bar, ` ${Math.round(100 * value)} %`);
}

function table(heads, rows, label, classOf = () => "") {
  return h(
    "table",
    { class: "facts", "aria-label": label },
    heads.some(Boolean) && h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col" }, head)))),
    h("tbody", {}, rows.map((row) =>
      h("tr", { class: classOf(row) || null }, row.map((cell, i) =>
        i === 0 && !(cell instanceof Node) ? h("th", { scope: "row" }, nameOf(cell)) : h("td", {}, cell instanceof Node ? cell : nameOf(cell ?? "–"))),
      ))),
  );
}

function shownValue(value) {
  return value !== null && typeof value === "object" ? visible(JSON.stringify(value)) : String(value);
}
