// Synchronous players of a sound and of its tactile loop: both start together, and the second follows the first.

import { h } from "./dom.js";
import { makeWave } from "./waves.js";

const DRIFT_S = 0.04;
const PARTS = ["sound", "touch"];
const LABELS = { sound: "Sound", touch: "Touch" };

/** Players of a state: {element, toggle(), stop(), repaint()}. */
export function makePlayers(state) {
  const audio = {};
  const waves = {};
  const audible = { sound: true, touch: true };
  const switches = {};
  for (const part of PARTS) {
    audio[part] = h("audio", { src: state[part].audio, loop: true, preload: "auto", "data-part": part });
    waves[part] = makeWave(state[part], { title: LABELS[part], colour: `--${part}`, onSeek: seek });
    switches[part] = h("button", {
      type: "button",
      class: "switch",
      "data-part": part,
      click: () => hear({ ...audible, [part]: !audible[part] }),
    });
  }
  const play = h("button", { type: "button", class: "play", title: "Space", click: toggle }, "Play");
  const compare = h("button", { type: "button", class: "compare", title: "Hear one, then the other" }, "A/B");
  compare.addEventListener("click", () => hear({ sound: !isOnly("sound"), touch: isOnly("sound") }));
  const time = h("span", { class: "time" });
  const isOnly = (part) => PARTS.every((other) => audible[other] === (other === part));
  const problem = h("p", { class: "problem", role: "status", hidden: true });
  let isPlaying = false;

  function hear(choice) {
    for (const part of PARTS) {
      audible[part] = choice[part];
      audio[part].muted = !choice[part];
      switches[part].setAttribute("aria-pressed", String(choice[part]));
      switches[part].textContent = `${LABELS[part]}: ${choice[part] ? "on" : "off"}`;
    }
  }

  async function toggle() {
    if (isPlaying) return stop();
    isPlaying = true;
    show();
    audio.touch.currentTime = audio.sound.currentTime % state.touch.seconds;
    try {
      await Promise.all(PARTS.map((part) => audio[part].play()));
      follow();
    } catch (cause) {
      if (cause.name === "AbortError") return undefined; // stopped before it began
      stop();
      problem.textContent = `The browser does not play this: ${cause.message}`;
      problem.hidden = false;
    }
    return undefined;
  }

  function stop() {
    isPlaying = false;
    for (const part of PARTS) audio[part].pause();
    show();
  }

  function seek(share) {
    audio.sound.currentTime = share * state.sound.seconds;
    audio.touch.currentTime = (share * state.sound.seconds) % state.touch.seconds;
    place();
  }

  function show() {
    play.textContent = isPlaying ? "Pause" : "Play";
    play.setAttribute("aria-pressed", String(isPlaying));
  }

  function place() {
    for (const part of PARTS) waves[part].showAt(Math.min(audio[part].currentTime / state[part].seconds, 1));
    time.textContent = `${audio.sound.currentTime.toFixed(1)} of ${state.sound.seconds.toFixed(1)} s`;
  }

  function follow() {
    if (!isPlaying) return;
    const wanted = audio.sound.currentTime % state.touch.seconds;
    const drift = Math.abs(audio.touch.currentTime - wanted);
    // Near the seam only one of the two may have started again, which is not drift.
    if (drift > DRIFT_S && drift < state.touch.seconds - 2 * DRIFT_S) audio.touch.currentTime = wanted;
    place();
    requestAnimationFrame(follow);
  }

  hear(audible);
  show();
  place();
  const element = h(
    "div",
    { class: "players" },
    h("div", { class: "row" }, play, switches.sound, switches.touch, compare),
    problem,
    PARTS.map((part) => h("figure", {}, h("figcaption", {}, captionOf(part, state), part === "sound" && time), waves[part].element, audio[part])),
  );
  return {
    element,
    toggle,
    stop,
    repaint: () => PARTS.forEach((part) => waves[part].repaint()),
  };
}

function captionOf(part, state) {
  const clip = state[part];
  return `${part === "sound" ? "Sound" : "Touch: tactile loop"}, ${clip.seconds.toFixed(1)} s at ${clip.rate_hz} Hz`;
}
