// The example page. Parameters, in the query or behind #, where a web server does not see them:
//   url, token    of `scene2hap bridge`
//   frames, rate  play the check game of the protocol instead; its lines come as window.scene2hapResults
//   self-test     the protocol's two examples come as window.scene2hapSelfTest
//   draw          least time between two pictures [ms], where the processor draws them

import { HapticOutput, Scene2HapClient, sceneFromThree } from "../scene2hap_client.js";
import { makeDesk } from "./desk.js";
import { gameScene, playGame, selfTest } from "./game.js";
import { makeGainsView } from "./gains_view.js";
import { makeHands, tellPoses } from "./hands.js";
import { makeStage, offerVr } from "./stage.js";

const N_MESSAGES = 6;
const COLOURS = { "Wooden table": 0xb98b5a, Smartphone: 0x3c6ea8, "Electric shaver": 0x2f7d6b, "Coffee mug": 0xd8e0e6 };
const byId = (id) => document.getElementById(id);
const parameters = new URLSearchParams(`${location.search.slice(1)}&${location.hash.slice(1)}`);
if (parameters.has("token")) history.replaceState(null, "", location.pathname); // it would stay in the history

const client = new Scene2HapClient({
  url: parameters.get("url") ?? undefined,
  token: parameters.get("token") ?? undefined,
  name: "scene2hap-browser-example 0.1.0",
});
const drawEvery_ms = Number(parameters.get("draw"));
const gains = makeGainsView(byId("felt"));
showConnection();
if (parameters.has("self-test")) window.scene2hapSelfTest = selfTest();
if (parameters.has("frames")) await playCheck();
else await playDesk();

/** The check game, drawn as boxes. */
async function playCheck() {
  const stage = makeStage(byId("canvas"), { hasShadows: false });
  const { THREE } = stage;
  const nodes = new Map();
  for (const { id, name, geometry, pose } of gameScene().objects) {
    const material = new THREE.MeshStandardMaterial({ color: COLOURS[name], roughness: 0.6 });
    const node = new THREE.Mesh(new THREE.BoxGeometry(...geometry.size_m), material);
    node.position.fromArray(pose.position_m);
    nodes.set(id, node);
    stage.scene.add(node);
  }
  const names = new Map(gameScene().objects.map(({ id, name }) => [id, name]));
  stage.lookAt([0.3, 2, 2.3], [0, 0.6, 0]);
  client.on("playing", (order) => {
    gains.arrange(order, (id) => names.get(id) ?? id);
    showStatus("Playing the check game.", "playing");
  });
  // Drawn seldom: the game may be faster than the screen, and the processor is the server's too.
  stage.run(() => gains.show(client, () => ""), { drawEvery_ms: drawEvery_ms || 250 });
  const settings = { frames: Number(parameters.get("frames")), rate_hz: Number(parameters.get("rate") ?? 0) };
  const moved = (id, position_m) => nodes.get(id).position.fromArray(position_m);
  try {
    window.scene2hapResults = await playGame(client, { ...settings, onMove: moved });
    showStatus("The check game has ended.", "waiting");
  } catch (error) {
    window.scene2hapProblem = String(error);
    showStatus(window.scene2hapProblem, "lost");
  }
}

/** The desk, to touch. */
async function playDesk() {
  const stage = makeStage(byId("canvas"));
  const { desk, movable, halfSize_m } = makeDesk();
  stage.scene.add(desk);
  stage.lookAt([0.1, 1.5, 0.95], [0, 0.74, -0.5]);
  const { scene, nodes } = sceneFromThree(desk);
  const names = new Map(scene.objects.map(({ id, name }) => [id, name]));
  const nameOf = (id) => names.get(id) ?? id;

  const slides = byId("slides");
  slides.checked = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const onDrag = (id) => (slides.checked = slides.checked && id !== "phone");
  const hands = makeHands(stage, nodes, { movable, halfSize_m, onDrag });
  const haptics = new HapticOutput();
  let session = null; // of WebXR
  let slid_s = 0;
  let last_s = performance.now() / 1000;

  stage.run(
    () => {
      const now_s = performance.now() / 1000;
      if (slides.checked) slid_s += Math.min(now_s - last_s, 0.1);
      last_s = now_s;
      if (slides.checked) nodes.get("phone").position.x = -0.32 + 0.2 * Math.sin(0.6 * slid_s);
      tellPoses(client, nodes);
      hands.tell(client);
      client.sendFrame(now_s);
      haptics.update((hand) => client.intensity(hand), { inputSources: session?.inputSources });
      gains.show(client, (hand) => (hands.touchedBy(hand) ? `on ${nameOf(hands.touchedBy(hand))}` : "touches nothing"));
    },
    { drawEvery_ms },
  );
  hands.placeFromAbove("left", -0.5, -0.3);
  hands.placeFromAbove("right", -0.05, -0.3);

  byId("hint").hidden = byId("controls").hidden = false;
  for (const radio of document.querySelectorAll("input[name=hand]")) {
    radio.addEventListener("change", () => hands.use(radio.value));
  }
  byId("rumble").addEventListener("change", ({ target }) => (haptics.isRumbleOn = target.checked));
  byId("vibrate").addEventListener("change", ({ target }) => (haptics.isVibrateOn = target.checked));
  byId("vibrate").parentElement.hidden = !navigator.vibrate;
  offerVr(byId("enter-vr"), stage.renderer, (found) => {
    session = found;
    if (!found) haptics.stop();
  });
  // Errors are shown by the "error" event, so `ignore` loses nothing.
  const ignore = () => {};
  byId("strike").addEventListener("click", () => client.strike("table", [0.25, 0.75, -0.4], { speed_m_s: 1 }));
  byId("pause").addEventListener("click", ({ target }) => {
    const isPaused = target.getAttribute("aria-pressed") === "true";
    const done = isPaused ? client.unpause() : client.pause();
    done.then(() => target.setAttribute("aria-pressed", String(!isPaused)), ignore);
  });
  byId("explain").addEventListener("click", () => {
    const asked = ["left", "right"].map((hand) => client.explain(hand));
    Promise.all(asked).then((answers) => {
      byId("explanation").textContent = answers.map(({ text }) => text).join("\n\n");
      byId("explanation").hidden = false;
    }, ignore);
  });
  const arrange = (detail) => {
    gains.arrange(client.order, nameOf);
    showSources(client.order.sources, nameOf);
    if (detail.type === "playing") showStatus("Playing.", "playing");
  };
  client.on("playing", arrange);
  client.on("order", arrange);
  client.on("impact", (detail) => {
    const felt = Object.entries(detail.felt).map(([hand, amplitude]) => `${hand} ${amplitude.toFixed(3)}`);
    say(`Impact on ${nameOf(detail.object)}: ${felt.join(", ")}`);
  });
  addEventListener("pagehide", () => {
    haptics.stop();
    client.leave();
    client.close();
  });
  // For tests, and for the console.
  window.scene2hapExample = { client, haptics, hands, nodes, scene, stage };

  try {
    await client.connect();
    const { job } = await client.bake({ scene });
    await client.play({ job, moving: movable });
  } catch (error) {
    showStatus(error.message, "lost");
  }
}

function showSources(sources, nameOf) {
  const rows = sources.map(({ id, is_on }) => {
    const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: is_on });
    box.addEventListener("change", () => client.setSource(id, { on: box.checked }));
    const label = document.createElement("label");
    label.append(box, nameOf(id));
    return label;
  });
  byId("sources").replaceChildren(...rows);
}

function showConnection() {
  showStatus(`Connecting to ${client.url}`, "waiting");
  client.on("online", () => showStatus("Connected.", "waiting"));
  client.on("progress", (detail) => showStatus(`Baking: ${detail.stage} ${detail.done} of ${detail.of}`, "waiting"));
  client.on("offline", (detail) => {
    const next = detail.wait_s === null ? "" : ` Next attempt in ${detail.wait_s} s.`;
    showStatus(`${detail.message}${next}`, "lost");
  });
  client.on("warning", (detail) => say(detail.message));
  client.on("error", (detail) => say(`${detail.error}: ${detail.message}`, "problem"));
}

function showStatus(text, is) {
  byId("status").textContent = text;
  byId("status").dataset.is = is;
}

function say(text, className = "") {
  const line = Object.assign(document.createElement("li"), { textContent: text, className });
  byId("messages").prepend(line);
  while (byId("messages").children.length > N_MESSAGES) byId("messages").lastChild.remove();
}
