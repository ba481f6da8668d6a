// Choice of the picture's content: felt map or colours, source, model, band, colour scale, walls, contacts, names.

import { SCALES } from "./colour_scales.js";
import { h, replaceChildren } from "./dom.js";

export function makeToolbar(element, report, store) {
  const choose = (label, options, value, onChange) => {
    const list = h("select", { "aria-label": label, "data-choice": label }, options.map(([key, text]) => h("option", { value: key }, text)));
    list.value = value;
    list.addEventListener("change", () => onChange(list.value));
    return { list, element: h("label", { class: "choice" }, h("span", {}, label), list) };
  };
  const check = (label, key) => {
    const box = h("input", { type: "checkbox", checked: store.get(key) });
    box.addEventListener("change", () => store.set(key, box.checked));
    return h("label", { class: "choice check" }, box, h("span", {}, label));
  };
  const part = (key) => (value) => store.set("choice", { ...store.get("choice"), [key]: value });
  const plain = (values) => values.map((value) => [value, value]);
  const choice = store.get("choice");
  const sources = report.felt.sources.map((id, i) => [id, i === 0 ? "all sources" : report.name(id)]);
  const lists = {
    source: choose("source", sources, choice.source, part("source")),
    model: choose("model", plain(report.felt.models), choice.model, part("model")),
    band: choose("band", report.felt.bands.map((band, i) => [band, i === 0 ? "whole band" : band]), choice.band, part("band")),
  };
  const scale = choose("scale", plain(SCALES), store.get("scale"), (value) => store.set("scale", value));
  const show = choose("show", [["felt", "felt map"], ["colours", "objects"]], store.get("show"), (value) => store.set("show", value));
  const walls = choose("walls", [["cut", "cut open"], ["all", "whole"], ["none", "hidden"]], store.get("walls"), (value) => store.set("walls", value));
  const isFelt = () => {
    for (const { list } of [...Object.values(lists), scale]) list.disabled = store.get("show") !== "felt";
  };
  store.on("choice", (chosen) => {
    for (const [key, { list }] of Object.entries(lists)) list.value = chosen[key];
  });
  store.on("show", isFelt);
  isFelt();
  const hasShells = report.objects.some((object) => object.is_shell);
  replaceChildren(element, [
    show.element,
    ...Object.values(lists).map((one) => one.element),
    scale.element,
    hasShells && walls.element,
    check("contacts", "contacts"),
    check("names", "names"),
  ]);
}
