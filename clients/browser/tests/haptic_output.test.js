// Pulses of controllers, by a clock of the test's own.

import assert from "node:assert/strict";
import { afterEach, beforeEach, test } from "node:test";
import { HapticOutput } from "../scene2hap_client.js";

let now_ms;
let sent;

beforeEach(() => {
  now_ms = 0;
  sent = [];
});

const output = (options) => new HapticOutput({ now_s: () => now_ms / 1000, ...options });

function controller(handedness) {
  const pulse = (value, ms) => {
    sent.push([handedness, now_ms, value, ms]);
    return Promise.resolve(true);
  };
  return { handedness, gamepad: { hapticActuators: [{ pulse }] } };
}

/** Update every 10 ms for a while. */
function play(haptics, lasts_ms, intensities, devices) {
  for (const end_ms = now_ms + lasts_ms; now_ms < end_ms; now_ms += 10) {
    haptics.update((hand) => intensities[hand] ?? 0, devices);
  }
}

test("a pulse every 50 ms that lasts 100 ms, then one of 0 and none", () => {
  const haptics = output();
  const devices = { inputSources: [controller("left"), controller("right")] };
  play(haptics, 200, { left: 0.5 }, devices);
  play(haptics, 1000, {}, devices);
  assert.deepEqual(sent, [
    ["left", 0, 0.5, 100],
    ["left", 50, 0.5, 100],
    ["left", 100, 0.5, 100],
    ["left", 150, 0.5, 100],
    ["left", 200, 0, 0],
  ]);
});

test("an impact between two pulses is felt with the next", () => {
  const haptics = output();
  const devices = { inputSources: [controller("right")] };
  play(haptics, 10, { right: 0.25 }, devices);
  play(haptics, 10, { right: 0.75 }, devices);
  play(haptics, 200, {}, devices);
  assert.deepEqual(sent, [
    ["right", 0, 0.25, 100],
    ["right", 50, 0.75, 100],
    ["right", 100, 0, 0],
  ]);
});

test("intensities are multiplied with the strength, clamped, and cut off below what is felt", () => {
  const devices = { inputSources: [controller("left"), controller("right")] };
  play(output({ strength: 2 }), 10, { left: 0.75, right: 0.25 }, devices);
  play(output({ least: 0.1 }), 10, { left: 0.09, right: 0.1 }, devices);
  assert.deepEqual(
    sent.map(([hand, , value]) => [hand, value]),
    [
      ["left", 1],
      ["right", 0.5],
      ["right", 0.1],
    ],
  );
});

test("a controller of no hand gets the stronger one", () => {
  play(output(), 10, { left: 0.25, right: 0.5 }, { inputSources: [controller("none")] });
  assert.deepEqual(sent, [["none", 0, 0.5, 100]]);
});

test("controllers with vibrationActuator alone, without any, and that refuse", () => {
  const effects = [];
  const vibrationActuator = { playEffect: (...given) => effects.push(given) };
  const inputSources = [
    { handedness: "left", gamepad: { vibrationActuator } },
    { handedness: "right", gamepad: { hapticActuators: [] } },
    { handedness: "none", gamepad: null },
    { handedness: "right", gamepad: { hapticActuators: [{ pulse: () => Promise.reject(new Error("asleep")) }] } },
    {
      handedness: "none",
      gamepad: {
        hapticActuators: [
          {
            pulse: () => {
              throw new Error("gone");
            },
          },
        ],
      },
    },
  ];
  const haptics = output();
  play(haptics, 60, { left: 0.5, right: 0.5 }, { inputSources });
  haptics.stop();
  assert.deepEqual(
    effects.map(([kind, { duration, strongMagnitude }]) => [kind, duration, strongMagnitude]),
    [
      ["dual-rumble", 100, 0.5],
      ["dual-rumble", 100, 0.5],
      ["dual-rumble", 0, 0],
    ],
  );
});

test("gamepads rumble only when the user has switched it on", () => {
  const effects = [];
  const vibrationActuator = { playEffect: (kind, effect) => effects.push({ kind, ...effect }) };
  const pad = { index: 2, connected: true, vibrationActuator };
  const haptics = output();
  const devices = { gamepads: [null, pad] };
  play(haptics, 100, { left: 0.5, right: 0.25 }, devices);
  assert.deepEqual(effects, []);
  haptics.isRumbleOn = true;
  play(haptics, 10, { left: 0.5, right: 0.25 }, devices);
  assert.deepEqual(effects, [{ kind: "dual-rumble", duration: 100, strongMagnitude: 0.5, weakMagnitude: 0.25 }]);
});

test("stop is at once, and once", () => {
  const haptics = output();
  const devices = { inputSources: [controller("left")] };
  play(haptics, 10, { left: 1 }, devices);
  haptics.stop();
  haptics.stop();
  assert.deepEqual(sent, [
    ["left", 0, 1, 100],
    ["left", 10, 0, 0],
  ]);
});

let own;
beforeEach(() => (own = Object.getOwnPropertyDescriptor(globalThis, "navigator")));
afterEach(() => (own ? Object.defineProperty(globalThis, "navigator", own) : delete globalThis.navigator));

test("phones run their motor for a part of each interval", () => {
  const calls = [];
  Object.defineProperty(globalThis, "navigator", {
    configurable: true,
    value: { vibrate: (ms) => (calls.push([now_ms, ms]), true) },
  });
  const haptics = output();
  play(haptics, 10, { left: 1 });
  assert.deepEqual(calls, []); // not switched on
  haptics.isVibrateOn = true;
  play(haptics, 90, { left: 0.3, right: 0.5 });
  play(haptics, 100, { left: 1 });
  play(haptics, 200, {});
  assert.deepEqual(calls, [
    [10, 50],
    [110, 200],
    [210, 0],
  ]);
});
