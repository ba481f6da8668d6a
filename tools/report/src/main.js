// The report page: reads the document in the page, and connects the parts.

import { makeCorrections } from "./corrections.js";
import { h, isolated, nameOf, pathOf, replaceChildren } from "./dom.js";
import { LOWEST_CODE, feltLevels, shownLevel } from "./felt_levels.js";
import { makeLegend } from "./legend.js";
import { makePanel } from "./panel.js";
import { readDocument, textOf } from "./report_document.js";
import { download, isServed, send } from "./saving.js";
import { makeSceneView } from "./scene_view.js";
import { makeStore } from "./store.js";
import { makeTableViews } from "./table_views.js";
import { makeTheme } from "./theme.js";
import { makeToolbar } from "./toolbar.js";

/** Largest number of sources whose paths the tooltip shows, the strongest first. */
const MOST_PATHS = 3;
// Width of A4 and Letter inside their margins [px of CSS].
const PAPER_PX = 700;

const one = (selector) => document.querySelector(selector);

textOf(one("#report").textContent)
  .then((text) => start(readDocument(text)))
  .catch((cause) => {
    // The data is incomplete or of another version: show the error on the page and in the console.
    one("#problem").textContent = `This report cannot be shown: ${cause.message}`;
    one("#problem").hidden = false;
    throw cause;
  });

function start(report) {
  const felt = feltLevels(report.felt);
  const [source, model, band] = [report.felt.sources[0], report.felt.models[0], report.felt.bands[0]];
  const store = makeStore({
    selected: null,
    choice: { source, model, band },
    show: report.felt.sources.length > 1 ? "felt" : "colours",
    scale: "viridis",
    walls: "cut",
    contacts: false,
    names: true,
  });
  document.title = `${isolated(report.scene)} – scene2hap`;
  replaceChildren(one("#scene-name"), nameOf(report.scene));
  const corrections = makeCorrections(report, showCorrections);
  const onFocus = (id) => {
    store.set("selected", id);
    view?.focus(id);
  };
  // Before the other parts: they read colours of the theme.
  let isMade = false;
  let savedCount = -1;
  makeTheme(one("#theme"), () => isMade && repaint());
  addEventListener("beforeprint", () => keepViewOnPaper(true));
  addEventListener("afterprint", () => keepViewOnPaper(false));
  const panel = makePanel({ element: one("#panel"), report, felt, store, corrections, onFocus });
  const tables = makeTableViews({ element: one("#tables"), report, felt, store, onFocus });
  makeToolbar(one("#toolbar"), report, store);
  makeLegend(one("#legend"), report, store);
  const view = makeSceneView({ canvas: one("#canvas"), layer: one("#labels"), report, felt, store, onHover: showTip, onFirstFrame: ready });
  isMade = true;
  showSaving();
  showCorrections();
  if (view) view.showTheme();
  else {
    document.documentElement.dataset.webgl = "0";
    one("#no-webgl").hidden = false;
    requestAnimationFrame(ready);
  }

  function ready() {
    document.documentElement.dataset.ready = "1";
  }

  // The picture and its labels keep their size on paper, since the page is not drawn again for it.
  function keepViewOnPaper(isPrinting) {
    const { style, clientWidth, clientHeight } = one("#view");
    style.width = isPrinting ? `${clientWidth}px` : "";
    style.height = isPrinting ? `${clientHeight}px` : "";
    style.zoom = isPrinting ? Math.min(1, PAPER_PX / clientWidth) : "";
    if (isPrinting) view?.draw();
  }

  function repaint() {
    view?.showTheme();
    panel.repaint();
  }

  function showTip(found, x, y) {
    const tip = one("#tip");
    tip.hidden = found === null;
    if (found === null) return;
    const index = felt.nearest(found.id, found.point.toArray());
    const level = index < 0 ? "no point of the felt map" : shownLevel(felt.level(felt.codes(store.get("choice"))[index]), report.felt);
    replaceChildren(tip, h("strong", {}, nameOf(report.name(found.id))), h("span", { class: "tip-level" }, level), pathsAt(index));
    const box = one("#view").getBoundingClientRect();
    const left = Math.min(x - box.left + 14, box.width - tip.offsetWidth - 4);
    const below = y - box.top + 18;
    const top = below + tip.offsetHeight > box.height ? y - box.top - tip.offsetHeight - 10 : below;
    tip.style.transform = `translate(${Math.round(Math.max(left, 4))}px, ${Math.round(Math.max(top, 4))}px)`;
  }

  /** Paths of the sources whose vibration arrives at a point, with the level of each if there are several. */
  function pathsAt(index) {
    const choice = store.get("choice");
    const arriving = index < 0 ? [] : felt.arriving(index, choice);
    if (arriving.length > 0 && arriving[0].path === null) return h("span", { class: "quiet" }, "over all paths at once");
    // The strongest source, and all others above the lowest level of the page.
    const told = arriving.filter(({ code }, i) => i === 0 || code > LOWEST_CODE).slice(0, MOST_PATHS);
    const shown = told.map(({ code, path }) =>
      h("span", { class: "tip-path" }, pathOf(path.map(report.name)), arriving.length > 1 && ` (${shownLevel(felt.level(code), report.felt)})`),
    );
    const rest = arriving.length - shown.length;
    return [shown, rest > 0 && h("span", { class: "quiet" }, `and ${rest} weaker`)];
  }

  function showCorrections() {
    const { count } = corrections;
    one("#save").disabled = count === 0;
    one("#send").disabled = count === 0;
    one("#changes").textContent = count === 0 ? "no changes" : count === 1 ? "1 change" : `${count} changes`;
    savedCount = -1;
  }

  function showSaving() {
    const tell = (text, isBad = false) => {
      one("#saved").textContent = text;
      one("#saved").classList.toggle("problem", isBad);
    };
    one("#save").addEventListener("click", () => {
      download(corrections.file());
      savedCount = corrections.count;
      tell("Downloaded overrides.json.");
    });
    one("#send").hidden = !isServed();
    one("#send").addEventListener("click", async () => {
      try {
        tell(await send(corrections.file()));
        savedCount = corrections.count;
      } catch (cause) {
        tell(`Not saved: ${cause.message}. Download the file instead.`, true);
      }
    });
    addEventListener("beforeunload", (event) => {
      if (corrections.count > 0 && savedCount !== corrections.count) event.preventDefault();
    });
  }

  addEventListener("resize", () => panel.resize());
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target instanceof Element ? event.target : document.body;
    const isField = target.closest("input:not([type=checkbox]), select, textarea") !== null;
    if (isField) {
      // Leave the field, so that the other keys work again.
      if (event.key === "Escape") target.blur();
      return;
    }
    if (event.key === "Escape") store.set("selected", null);
    if (event.key === "f" || event.key === "F") view?.focus(store.get("selected"));
    else if (event.key === "/") {
      event.preventDefault();
      tables.search.focus();
    } else if (event.key === " " && target.closest("button, input, summary, a") === null) {
      event.preventDefault();
      panel.togglePlayers();
    }
  });

  window.scene2hapReport = {
    select: (id) => store.set("selected", report.byId.has(id) ? id : null),
    selected: () => store.get("selected"),
    pick: (x, y) => view?.pick(x, y) ?? null,
    setFelt: (choice) => store.set("choice", { ...store.get("choice"), ...choice }),
    felt: () => ({ ...store.get("choice") }),
    focus: onFocus,
    project: (id) => view?.project(id) ?? null,
    overrides: () => corrections.file(),
  };
}
