// Binary messages, and the positions of the check game.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fromHex, gameScene, line, positions, touches } from "../example/game.js";
import { decodeGains, encodeFrame, encodePicture } from "../scene2hap_client.js";

// The examples as the page of the protocol has them.
const PAGE = new URL("../../../docs/bridge-protocol.md", import.meta.url);
const blocks = readFileSync(PAGE, "utf8").matchAll(/```\n(53324842[0-9a-f\s]+)```/g);
const [FRAME, GAINS] = [...blocks].map((found) => found[1]);

test("a frame has the bytes of the page", () => {
  const frame = encodeFrame({
    layout: 1,
    key: "00112233445566ff",
    sequence: 7,
    time_s: 0.5,
    poses: [[0.25, 0.724, 0, 0, 0, 0, 1]],
    touches: [{ hand: 0, object: 1, point_m: [0.5, 0.72, 0] }],
  });
  assert.deepEqual(new Uint8Array(frame), new Uint8Array(fromHex(FRAME)));
});

test("gains have the values of the page", () => {
  const found = decodeGains(fromHex(GAINS));
  assert.deepEqual([...found.intensities], [0.125, 0]);
  assert.deepEqual([...found.gains], [0.5, 0]);
  assert.equal(found.sequence, 7);
  assert.equal(found.time_s, 0.5);
  assert.equal(found.layout, 1);
  assert.equal(found.isPaused, false);
});

test("what is no gains message is refused", () => {
  const whole = new Uint8Array(fromHex(GAINS));
  for (const [at, value] of [
    [0, 0x54],
    [4, 1],
    [5, 2],
    [32, 3],
  ]) {
    const broken = whole.slice();
    broken[at] = value;
    assert.throws(() => decodeGains(broken.buffer), { kind: "WrongMessage" }, `byte ${at}`);
  }
  for (const n of [0, 3, 39, whole.length - 1]) {
    assert.throws(() => decodeGains(whole.slice(0, n).buffer), { kind: "WrongMessage" }, `${n} bytes`);
  }
});

test("flags tell of a pause and of a field that is prepared", () => {
  const bytes = new Uint8Array(fromHex(GAINS));
  bytes[38] = 2;
  const found = decodeGains(bytes.buffer);
  assert.deepEqual([found.isPaused, found.isPreparing], [false, true]);
});

test("a picture has its text and its bytes", () => {
  const meta = { object: "Tür", kind: "isolated", view: "front" };
  const found = Buffer.from(encodePicture(meta, Uint8Array.of(0x89, 0x50)));
  assert.equal(found.subarray(0, 4).toString(), "S2HB");
  assert.deepEqual([...found.subarray(4, 6)], [3, 1]);
  const n = found.readUInt16LE(6);
  assert.deepEqual(JSON.parse(found.subarray(8, 8 + n).toString("utf8")), meta);
  assert.deepEqual([...found.subarray(8 + n)], [0x89, 0x50]);
});

test("the game's objects are where the page says", () => {
  assert.equal(gameScene().objects.length, 30);
  const at = positions(1234);
  assert.deepEqual(at[0], [0, 0.7, 0]);
  assert.deepEqual(at[1], [-1 + 1234 / 1800, 0.724, 0.2]);
  assert.deepEqual(at[2], [0.5, 0.94, -0.2]); // 1200 <= 1234 < 1800
  // Object 12: c = 0, (1234 + 444) mod 240 = 238, d = 118 / 120; the second row.
  assert.deepEqual(at[12], [-0.9 + 0.05 * (118 / 120), 0.765, 0]);
  // Object 29: c = 26 mod 9 = 8, (1234 + 1073) mod 240 = 147, d = 27 / 120; the third row.
  assert.deepEqual(at[29], [-0.9 + 0.2 * 8 + 0.05 * (27 / 120), 0.765, 0.35]);
  assert.deepEqual(positions(1800)[2], [0.5, 0.74, -0.2]);
  assert.deepEqual(touches(1234).right, { object: "phone", point_m: [at[1][0], 0.728, 0.2] });
  assert.equal(touches(600).right?.object, "cup_12");
  assert.deepEqual([touches(539).left?.object, touches(540).left], ["table", null]);
});

test("a line has the loudest band of each source", () => {
  const gains = Float32Array.of(0.25, 0.5, 0, 0.125); // two hands, one source, two bands
  assert.equal(line({ sequence: 9, n_bands: 2, gains }), "9,0.500000000,0.125000000");
});
