// Gains and intensities as bars with numbers. Names come from scenes, so they become text nodes only.

/** Levels from here to 0 dB have a bar [dB]. */
const LOWEST_DB = -60;

export const decibels = (value) => (value > 0 ? 20 * Math.log10(value) : -Infinity);
const shareOf = (value) => Math.min(Math.max(1 - decibels(value) / LOWEST_DB, 0), 1);

function element(tag, className, ...children) {
  const made = document.createElement(tag);
  made.className = className;
  made.append(...children);
  return made;
}

function makeLevel(name, className = "") {
  const [fill, number, level_db] = [element("div", ""), element("span", "number"), element("span", "decibels")];
  const bar = element("div", "bar", fill);
  bar.setAttribute("role", "meter");
  bar.setAttribute("aria-label", name);
  bar.setAttribute("aria-valuemin", "0");
  bar.setAttribute("aria-valuemax", "1");
  const label = element("span", "name", name);
  label.title = name;
  const row = element("div", `level ${className}`, label, bar, element("span", "value", number, level_db));
  let shown = -1;
  return {
    row,
    show(value) {
      if (value === shown) return;
      shown = value;
      fill.style.width = `${(100 * shareOf(value)).toFixed(2)}%`;
      bar.setAttribute("aria-valuenow", value.toFixed(3));
      number.textContent = value.toFixed(3);
      level_db.textContent = value > 0 ? `${decibels(value).toFixed(1).replace("-", "−")} dB` : "silent";
    },
  };
}

/** Bars of each hand in an element; `show` fills them from a client, `arrange` when hands or sources have changed. */
export function makeGainsView(container) {
  let hands = [];
  return {
    /** @param {import("../scene2hap_client.js").Order} order @param {(id: string) => string} nameOf */
    arrange(order, nameOf) {
      hands = order.hands.map((hand) => {
        const touching = element("span", "touching");
        const intensity = makeLevel("intensity", "intensity");
        const sources = order.sources.map(({ id }) => ({ id, level: makeLevel(nameOf(id)) }));
        for (const { id, level } of sources) level.row.dataset.source = id;
        const title = element("h2", "", `${hand[0].toUpperCase()}${hand.slice(1)} hand`, touching);
        const section = element("section", "hand", title, intensity.row, ...sources.map(({ level }) => level.row));
        section.dataset.hand = hand;
        return { hand, section, touching, intensity, sources };
      });
      const scale = element("div", "scale", element("span", "", `−${-LOWEST_DB} dB`), element("span", "", "0"));
      container.replaceChildren(...hands.map(({ section }) => section), scale);
    },
    /** @param {import("../scene2hap_client.js").Scene2HapClient} client @param {(hand: string) => string} touchedBy */
    show(client, touchedBy) {
      for (const { hand, touching, intensity, sources } of hands) {
        const text = touchedBy(hand);
        if (touching.textContent !== text) touching.textContent = text;
        intensity.show(client.intensity(hand));
        for (const { id, level } of sources) level.show(client.gain(hand, id));
      }
    },
  };
}
