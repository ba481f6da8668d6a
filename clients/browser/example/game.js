// The game of "Check a client" in docs/bridge-protocol.md, without anything to see.

import { decodeGains, encodeFrame } from "../scene2hap_client.js";

const TABLE_SIZE_M = [2.4, 0.04, 0.8];
const PHONE_SIZE_M = [0.07, 0.008, 0.15];
const SHAVER_SIZE_M = [0.05, 0.04, 0.16];
const CUP_SIZE_M = [0.08, 0.09, 0.08];

const cupId = (k) => `cup_${String(k).padStart(2, "0")}`;

/** Positions of all 30 objects in frame i [m]. Operations stand in the order in which the page has them. */
export function positions(i) {
  const found = [
    [0, 0.7, 0],
    [-1 + i / 1800, 0.724, 0.2],
    [0.5, i % 3600 >= 1200 && i % 3600 < 1800 ? 0.94 : 0.74, -0.2],
  ];
  for (let k = 3; k < 30; k += 1) {
    const d = Math.abs(((i + 37 * k) % 240) - 120) / 120;
    found.push([-0.9 + 0.2 * ((k - 3) % 9) + 0.05 * d, 0.765, [-0.35, 0, 0.35][Math.floor((k - 3) / 9)]]);
  }
  return found;
}

/** What each hand touches in frame i: an object's id and a point, or null. */
export function touches(i) {
  const at = positions(i);
  const [[px, py, pz], [cx, cy, cz]] = [at[1], at[12]];
  return {
    left: i % 600 >= 540 ? null : { object: "table", point_m: [-0.5, 0.72, 0.1] },
    right:
      i % 1200 < 600
        ? { object: "phone", point_m: [px, py + 0.004, pz] }
        : { object: cupId(12), point_m: [cx, cy + 0.045, cz] },
  };
}

/** @returns {import("../scene2hap_client.js").SceneJson} the scene as it is in frame 0 */
export function gameScene() {
  const at = positions(0);
  const things = [
    ["table", "Wooden table", TABLE_SIZE_M],
    ["phone", "Smartphone", PHONE_SIZE_M],
    ["shaver", "Electric shaver", SHAVER_SIZE_M],
    ...Array.from({ length: 27 }, (_, n) => [cupId(n + 3), "Coffee mug", CUP_SIZE_M]),
  ];
  const objects = things.map(([id, name, size_m], i) => ({
    id,
    name,
    pose: { position_m: at[i] },
    geometry: { kind: "box", size_m },
  }));
  return { format: "scene2hap/scene", version: 1, name: "check", up_axis: "y", objects };
}

/** A gains message as a line: sequence, and the loudest band of each source at each hand, with 9 significant digits. */
export function line({ sequence, n_bands, gains }) {
  const cells = [];
  for (let at = 0; at < gains.length; at += n_bands) {
    cells.push(Math.max(...gains.subarray(at, at + n_bands)).toPrecision(9));
  }
  return [sequence, ...cells].join();
}

/**
 * Play the game to its end.
 *
 * @param {import("../scene2hap_client.js").Scene2HapClient} client not yet connected
 * @param {{frames: number, rate_hz: number, onMove?: (id: string, position_m: number[]) => void}} settings
 *   `rate_hz` 0: one frame after the other, as gains come
 * @returns {Promise<string[]>} a line for each gains message
 */
export async function playGame(client, { frames, rate_hz, onMove = () => {} }) {
  const lines = [];
  const scene = gameScene();
  const moving = scene.objects.map(({ id }) => id);
  let finish = () => {};
  const isFinished = new Promise((resolve) => (finish = resolve));
  let timer;
  let started_ms = 0;

  /** Send the next frame: after a lost connection, the one after the last that the server took. */
  function send() {
    const i = client.sequence;
    if (i >= frames) return;
    positions(i).forEach((position_m, k) => {
      client.setPose(moving[k], [...position_m, 0, 0, 0, 1]);
      onMove(moving[k], position_m);
    });
    for (const [hand, touch] of Object.entries(touches(i))) {
      if (touch) client.touch(hand, touch.object, touch.point_m);
      else client.lift(hand);
    }
    const isSent = client.sendFrame(i / 60) !== 0;
    // Not sent: the connection is lost, and "playing" goes on; or the socket is full, and a later attempt succeeds.
    if (isSent ? rate_hz === 0 : !client.isPlaying) return;
    const due_ms = rate_hz === 0 ? 0 : started_ms + (1000 * (i + 1)) / rate_hz - performance.now();
    timer = setTimeout(send, Math.max(due_ms, 1));
  }

  let heard = 0;
  client.on("gains", (detail) => {
    // After a lost connection the server repeats the last gains.
    if (detail.sequence <= heard) return;
    heard = detail.sequence;
    lines.push(line(detail));
    if (heard >= frames) finish();
    else if (rate_hz === 0 && heard === client.sequence) send();
  });
  client.on("playing", (detail) => {
    clearTimeout(timer);
    // Frames are timed from the first on; a connection that was lost moves the rest.
    started_ms = performance.now() - (rate_hz === 0 ? 0 : (1000 * detail.sequence) / rate_hz);
    send();
  });

  await client.connect();
  const { job } = await client.bake({ scene });
  await client.play({ job, moving, frames: "every" });
  await isFinished;
  await client.leave();
  client.close();
  return lines;
}

/** The page's two examples: the frame in hexadecimal, and the values of the gains. */
export function selfTest() {
  const frame = encodeFrame({
    layout: 1,
    key: "00112233445566ff",
    sequence: 7,
    time_s: 0.5,
    poses: [[0.25, 0.724, 0, 0, 0, 0, 1]],
    touches: [{ hand: 0, object: 1, point_m: [0.5, 0.72, 0] }],
  });
  const gains = decodeGains(fromHex(GAINS_HEX));
  return {
    frame: [...new Uint8Array(frame)].map((byte) => byte.toString(16).padStart(2, "0")).join(""),
    gains: { ...gains, intensities: [...gains.intensities], gains: [...gains.gains] },
  };
}

const GAINS_HEX =
  "53324842020101000000000000000000" +
  "0700000000000000000000000000e03f" +
  "02000100010000000000003e00000000" +
  "0000003f00000000";

export function fromHex(text) {
  return Uint8Array.from(text.replace(/\s/g, "").match(/../g) ?? [], (byte) => parseInt(byte, 16)).buffer;
}
