// The spectrum of a tactile loop with the threshold of touch.

import uPlot from "uplot";
import { themeColour } from "./theme.js";

const HEIGHT = 210;

/** Draw into `element`, which must already be in the page, since its width is needed. Returns the chart. */
export function drawSpectrum(element, { hz, touch_db, threshold_db }) {
  element.replaceChildren();
  const finite = [...touch_db, ...threshold_db].filter(Number.isFinite);
  // Empty bands lie far below all relevant levels.
  const high = Math.ceil(Math.max(...finite, -20) / 10) * 10 + 5;
  const low = Math.max(Math.floor(Math.min(...finite) / 10) * 10, high - 105);
  const font = "12px system-ui, sans-serif";
  const axis = {
    font,
    labelFont: font,
    stroke: themeColour("--text"),
    grid: { stroke: themeColour("--line"), width: 1 },
    ticks: { stroke: themeColour("--line"), width: 1 },
  };
  const number = (_, value) => (value === null || value === undefined ? "–" : value.toFixed(1));
  return new uPlot(
    {
      width: Math.max(element.clientWidth, 200),
      height: HEIGHT,
      padding: [8, 26, 0, 0],
      cursor: { y: false, drag: { x: false, y: false } },
      scales: { x: { time: false, distr: 3, log: 10 }, y: { range: [low, high] } },
      axes: [
        { ...axis, label: "Frequency [Hz]", labelSize: 20, size: 34 },
        { ...axis, label: "Level [dB]", labelSize: 20, size: 46 },
      ],
      series: [
        { label: "Hz", value: number },
        { label: "touch", stroke: themeColour("--touch"), width: 2, points: { show: false }, value: number },
        {
          label: "threshold of touch",
          stroke: themeColour("--threshold"),
          width: 2,
          dash: [6, 4],
          points: { show: false },
          value: number,
        },
      ],
    },
    [hz, touch_db, threshold_db],
    element,
  );
}
