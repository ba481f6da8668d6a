// The picture of a clip: its waveform above its spectrogram, with a playhead over both.

import { h } from "./dom.js";
import { bytesOf } from "./report_document.js";
import { themeColour } from "./theme.js";

const WAVE_HEIGHT = 48;
const MIDDLE = 128;

/** The picture of a clip: {element, showAt(share), repaint()}; `onSeek` is called with a share 0..1 of its length. */
export function makeWave(clip, { title, colour, onSeek }) {
  const bytes = bytesOf(clip.wave);
  const canvas = h("canvas", { class: "wave", width: clip.columns, height: WAVE_HEIGHT, "aria-hidden": "true" });
  const head = h("div", { class: "playhead", "aria-hidden": "true" });
  const [low_hz, high_hz] = clip.spectrogram_hz;
  const both = h(
    "div",
    { class: "wave-box" },
    canvas,
    h("img", { class: "spectrogram", src: clip.spectrogram, alt: `Spectrogram: ${title}, ${low_hz} to ${high_hz} Hz` }),
    h("span", { class: "axis top" }, `${high_hz} Hz`),
    h("span", { class: "axis bottom" }, `${low_hz} Hz`),
    head,
  );
  both.addEventListener("click", (event) => {
    const box = both.getBoundingClientRect();
    onSeek(Math.min(Math.max((event.clientX - box.left) / box.width, 0), 0.999));
  });

  function repaint() {
    const pen = canvas.getContext("2d");
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.fillStyle = themeColour(colour);
    let most = 1;
    for (const byte of bytes) most = Math.max(most, Math.abs(byte - MIDDLE));
    for (let column = 0; column < clip.columns; column += 1) {
      const lowest = (bytes[2 * column] - MIDDLE) / most;
      const highest = (bytes[2 * column + 1] - MIDDLE) / most;
      const top = ((1 - highest) / 2) * WAVE_HEIGHT;
      pen.fillRect(column, top, 1, Math.max(((highest - lowest) / 2) * WAVE_HEIGHT, 1));
    }
  }

  repaint();
  return {
    element: both,
    repaint,
    showAt(share) {
      head.style.left = `${100 * share}%`;
    },
  };
}
