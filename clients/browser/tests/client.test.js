// The client against a scripted server: order of requests, frames, lost connections, silence.

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";
import { Scene2HapClient } from "../scene2hap_client.js";
import { FakeSocket, PLAYING, WELCOME, gainsOf, settled } from "./fake_socket.js";

const SCENE = {
  format: "scene2hap/scene",
  version: 1,
  name: "study",
  up_axis: "y",
  objects: [
    { id: "table", name: "Table", pose: { position_m: [0, 0.7, 0] }, geometry: { kind: "box", size_m: [1, 0.04, 1] } },
    {
      id: "phone",
      name: "Phone",
      pose: { position_m: [0.25, 0.724, 0] },
      geometry: { kind: "box", size_m: [0.1, 0.01, 0.1] },
    },
  ],
};

let clock_s;
let heard;

beforeEach(() => {
  mock.timers.enable({ apis: ["setTimeout"] });
  FakeSocket.opened.length = 0;
  clock_s = 100;
  heard = [];
});
afterEach(() => mock.timers.reset());

function makeClient(options = {}) {
  const client = new Scene2HapClient({ url: "ws://test/", WebSocket: FakeSocket, now_s: () => clock_s, ...options });
  for (const type of ["online", "offline", "playing", "order", "error", "gains", "impact"]) {
    client.on(type, (detail) => heard.push({ of: type, ...detail }));
  }
  return client;
}

const heardOf = (type) => heard.filter((one) => one.of === type);

async function online() {
  FakeSocket.last.open();
  FakeSocket.last.answer("hello", WELCOME);
  await settled();
}

function answerWatch(session = PLAYING.session) {
  const { key, sequence, ...order } = PLAYING; // who watches gets neither
  FakeSocket.last.answer("watch", { ...order, session, type: "watching" });
}

async function playing(client, fields = {}, request = {}) {
  client.connect();
  await online();
  const baked = client.bake({ scene: SCENE });
  await settled();
  FakeSocket.last.answer("bake", { type: "baking", job: 1 });
  FakeSocket.last.say({ type: "baked", job: 1, objects: [] });
  const { job } = await baked;
  const order = client.play({ job, moving: ["phone"], ...request });
  await settled();
  FakeSocket.last.answer("play", { ...PLAYING, ...fields });
  await order;
}

test("hello, bake and play come in this order, each once", async () => {
  const client = makeClient({ token: "secret", name: "test 1" });
  await playing(client);
  const messages = FakeSocket.last.messages;
  assert.deepEqual(
    messages.map(({ type }) => type),
    ["hello", "bake", "play"],
  );
  assert.deepEqual(messages[0], { type: "hello", version: 1, client: "test 1", token: "secret", id: 1 });
  assert.deepEqual(messages[1].scene, SCENE);
  assert.deepEqual(messages[2], { type: "play", job: 1, moving: ["phone"], id: 3 });
  assert.equal(heardOf("playing")[0].isResumed, false);
  assert.equal(client.isPlaying, true);
  assert.doesNotMatch(JSON.stringify([heard, client, messages.slice(1)]), /secret/);
});

test("a frame has what was set, and poses only while the server may lack them", async () => {
  const client = makeClient();
  await playing(client);
  client.touch("right", "table", [0.5, 0.72, 0]);
  assert.equal(client.sendFrame(1), 1);
  const [first] = FakeSocket.last.frames;
  assert.equal(first.byteLength, 40 + 28 + 20);
  assert.equal(first.getFloat32(40, true), 0.25); // from the scene that was baked
  assert.deepEqual([first.getUint32(68, true), first.getUint32(72, true)], [1, 1]); // right, table
  assert.equal(first.getFloat64(24, true), 1);

  client.sendFrame(2); // not answered yet: the server may drop the first for this one
  assert.equal(FakeSocket.last.frames[1].getUint32(32, true), 1);
  FakeSocket.last.bytes(gainsOf({ sequence: 2 }));
  client.sendFrame(3);
  assert.equal(FakeSocket.last.frames[2].getUint32(32, true), 0);

  client.setPose("phone", [0.5, 0.724, 0, 0, 0, 0, 1]);
  client.lift("right");
  client.sendFrame(4);
  const last = FakeSocket.last.frames[3];
  assert.deepEqual([last.getUint32(32, true), last.getUint32(36, true)], [1, 0]);
  assert.equal(last.getFloat32(40, true), 0.5);
  assert.equal(last.getUint32(16, true), 4);
});

test("a pose that is the same in single precision is no movement", async () => {
  const client = makeClient();
  await playing(client);
  client.setPose("phone", [0.1, 0.724, 0, 0, 0, 0, 1]);
  client.sendFrame(1);
  FakeSocket.last.bytes(gainsOf({ sequence: 1 }));
  client.setPose("phone", [0.1, 0.724, 0, 0, 0, 0, 1]);
  client.sendFrame(2);
  assert.equal(FakeSocket.last.frames[1].getUint32(32, true), 0);
});

test("a socket that is full gets no frame, and later the newest", async () => {
  const client = makeClient();
  await playing(client);
  FakeSocket.last.bufferedAmount = 1_000_000;
  for (let i = 0; i < 100; i += 1) {
    client.setPose("phone", [i, 0, 0, 0, 0, 0, 1]);
    assert.equal(client.sendFrame(i), 0);
  }
  FakeSocket.last.bufferedAmount = 0;
  assert.equal(client.sendFrame(100), 1);
  assert.equal(FakeSocket.last.frames.length, 1);
  assert.equal(FakeSocket.last.frames[0].getFloat32(40, true), 99);
});

test("gains and intensities are those of the last message, and 0 after watchdog_s", async () => {
  const client = makeClient();
  await playing(client);
  assert.equal(client.intensity("left"), 0);
  FakeSocket.last.bytes(gainsOf({ sequence: 1, intensities: [0.125, 0.25], gains: [0.5, 0.75] }));
  assert.deepEqual([client.gain("left", "phone"), client.gain("right", "phone")], [0.5, 0.75]);
  assert.deepEqual([client.intensity("left"), client.intensity("right")], [0.125, 0.25]);
  assert.deepEqual([client.gain("left", "table"), client.gain("nose", "phone"), client.intensity("nose")], [0, 0, 0]);
  clock_s += 0.099;
  assert.equal(client.gain("left", "phone"), 0.5);
  clock_s += 0.002;
  assert.deepEqual([client.isFelt, client.gain("left", "phone"), client.intensity("right")], [false, 0, 0]);
});

test("of several bands the loudest counts, and each can be asked for", async () => {
  const client = makeClient();
  await playing(client, { n_bands: 2 });
  FakeSocket.last.bytes(gainsOf({ sequence: 1, gains: [0.25, 0.5, 0.125, 0], n_bands: 2 }));
  assert.deepEqual([client.gain("left", "phone"), client.gain("left", "phone", 0)], [0.5, 0.25]);
  assert.equal(client.gain("right", "phone"), 0.125);
});

test("gains of an older layout are read by that layout's order", async () => {
  const client = makeClient();
  await playing(client);
  const sources = [{ ...PLAYING.sources[0], id: "fan" }, PLAYING.sources[0]];
  const { key, session, ...order } = PLAYING;
  FakeSocket.last.say({ ...order, type: "order", layout: 2, objects: ["phone", "table", "fan"], sources });
  FakeSocket.last.bytes(gainsOf({ layout: 1, sequence: 1, gains: [0.5, 0] }));
  assert.equal(client.gain("left", "phone"), 0.5);
  FakeSocket.last.bytes(gainsOf({ layout: 2, sequence: 2, gains: [0.125, 0.25, 0, 0] }));
  assert.deepEqual([client.gain("left", "fan"), client.gain("left", "phone")], [0.125, 0.25]);
  client.touch("left", "fan", [0, 0, 0]);
  client.sendFrame(1);
  const frame = FakeSocket.last.frames[0];
  assert.equal(frame.getUint16(6, true), 2);
  assert.equal(frame.getUint32(40 + 28 + 4, true), 2);
  assert.equal(client.order.key, PLAYING.key); // an order has none
  assert.deepEqual(heardOf("error"), []);
});

test("a lost connection is resumed with growing waits of at most 5 s", async () => {
  const client = makeClient();
  await playing(client);
  client.sendFrame(1);
  FakeSocket.last.bytes(gainsOf({ sequence: 1 }));
  assert.equal(client.sendFrame(1.5), 2); // does not reach the server
  FakeSocket.last.fail();
  assert.deepEqual([client.isPlaying, client.sendFrame(2), client.gain("left", "phone")], [false, 0, 0]);

  for (const [i, wait_s] of [0.25, 0.5, 1, 2, 4, 5, 5].entries()) {
    if (i > 0) FakeSocket.last.fail();
    const n = FakeSocket.opened.length;
    mock.timers.tick(wait_s * 1000 - 1);
    assert.equal(FakeSocket.opened.length, n);
    mock.timers.tick(1);
    assert.equal(FakeSocket.opened.length, n + 1);
  }
  await online();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "resume"],
  );
  const { session, key } = FakeSocket.last.messages[1];
  assert.deepEqual([session, key], [PLAYING.session, PLAYING.key]);
  FakeSocket.last.answer("resume", { ...PLAYING, sequence: 1 });
  assert.equal(heardOf("playing").at(-1).isResumed, true);
  assert.equal(client.sendFrame(3), 2); // as the server counts
  assert.equal(FakeSocket.last.frames[0].getUint32(32, true), 1); // poses again
  assert.deepEqual(heardOf("error"), []);
  FakeSocket.last.fail(); // waits begin anew after a welcome
  assert.equal(heardOf("offline").at(-1).wait_s, 0.25);
});

test("a server that was restarted bakes and plays again", async () => {
  const client = makeClient();
  await playing(client);
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  const unknown = { type: "error", error: "UnknownSession", message: "there is no session" };
  FakeSocket.last.answer("resume", unknown);
  await settled();
  FakeSocket.last.answer("bake", { type: "baking", job: 7 });
  FakeSocket.last.say({ type: "baked", job: 7, objects: [] });
  await settled();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "resume", "bake", "play"],
  );
  const [, , bake, play] = FakeSocket.last.messages;
  assert.deepEqual(bake.scene, SCENE);
  assert.deepEqual([play.job, play.moving], [7, ["phone"]]);
  FakeSocket.last.answer("play", { ...PLAYING, session: "new", key: "ffeeddccbbaa9988" });
  assert.equal(heardOf("playing").at(-1).isResumed, false);
  assert.equal(client.sendFrame(1), 1);
  assert.equal(FakeSocket.last.frames[0].getUint8(8), 0xff);
  assert.deepEqual(heardOf("error"), []); // the game has nothing to do
});

test("a bake whose connection is lost is asked for again", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const baked = client.bake({ scene: SCENE });
  await settled();
  FakeSocket.last.answer("bake", { type: "baking", job: 1 });
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  FakeSocket.last.answer("bake", { type: "baking", job: 2 });
  FakeSocket.last.say({ type: "baked", job: 2, objects: [] });
  assert.equal((await baked).job, 2);
});

test("requests that wait when the connection is lost fail, and those without a connection too", async () => {
  const client = makeClient();
  await playing(client);
  const explained = client.explain("left");
  FakeSocket.last.fail();
  await assert.rejects(explained, { kind: "ConnectionLost" });
  await assert.rejects(client.pause(), { kind: "ConnectionLost" });
  assert.match(heardOf("error")[0].message, /pause was not sent/);
});

test("errors are text, and throw only where somebody awaits", async () => {
  const unhandled = [];
  const note = (reason) => unhandled.push(reason);
  process.on("unhandledRejection", note);
  const client = makeClient();
  await playing(client);
  client.setSource("fan", { on: true }); // nobody awaits
  FakeSocket.last.answer("set_source", { type: "error", error: "UnknownSource", message: "there is no source fan" });
  FakeSocket.last.say({ type: "error", error: "BridgeError", message: "a frame is too short" });
  FakeSocket.last.say("{ not JSON");
  FakeSocket.last.bytes(new ArrayBuffer(3));
  FakeSocket.last.bytes(gainsOf({ sequence: 1, layout: 77 }));
  FakeSocket.last.say({ type: "of a later server", with: [1] });
  const struck = client.strike("table", [0, 0, 0], { speed_m_s: 1 });
  FakeSocket.last.answer("strike", { type: "error", error: "SessionError", message: "no speed" });
  await assert.rejects(struck, { name: "Scene2HapError", kind: "SessionError", message: "no speed" });
  await settled();
  process.off("unhandledRejection", note);
  assert.deepEqual(unhandled, []);
  assert.deepEqual(
    heardOf("error").map(({ error }) => error),
    ["UnknownSource", "BridgeError", "WrongMessage", "WrongMessage", "FrameError", "SessionError"],
  );
});

test("a mistake that is in every frame is reported once", async () => {
  const client = makeClient();
  await playing(client, { objects: ["lamp", "table"] });
  client.touch("nose", "table", [0, 0, 0]);
  client.touch("left", "cup", [0, 0, 0]);
  for (let i = 0; i < 5; i += 1) client.sendFrame(i);
  const texts = heardOf("error").map(({ message }) => message);
  assert.equal(texts.length, 3);
  assert.match(texts[0], /No pose of "lamp"/);
  assert.match(texts[1], /No hand is called "nose"; hands are left, right/);
  assert.match(texts[2], /No object has the id "cup"/);
  assert.equal(FakeSocket.last.frames[4].byteLength, 40); // frames go on, without both
});

test("poses that are not sent are reported once", async () => {
  const client = makeClient();
  client.setPose("cup", [1, 0, 0, 0, 0, 0, 1]); // before the session: it may come
  await playing(client, { objects: ["phone", "table", "shelf"] });
  for (let i = 0; i < 3; i += 1) {
    client.setPose("phone", [i, 0, 0, 0, 0, 0, 1]);
    for (const id of ["table", "shelf", "phnoe"]) client.setPose(id, [i, 0, 0, 0, 0, 0, 1]);
    client.sendFrame(i);
  }
  const errors = heardOf("error").map(({ message }) => message);
  assert.equal(errors.length, 2);
  assert.match(errors[0], /"table" is not among the moving objects/);
  assert.match(errors[1], /No object has the id "phnoe"/);
});

test("a pose or point that is no number is reported once, and the rest of the frame goes on", async () => {
  const client = makeClient();
  await playing(client);
  const vector = { x: 0.5, y: 0.72, z: 0, *[Symbol.iterator]() { yield* [0.5, 0.72, 0]; } }; // as three.js has them
  client.touch("left", "table", vector);
  for (let i = 0; i < 2; i += 1) {
    client.setPose("phone", [0, NaN, 0, 0, 0, 0, 1]);
    client.setPose("phone", [0, 1]);
    client.setPose("phone", undefined);
    client.touch("right", "table", { x: 0, y: 0, z: 0 });
    client.touch("right", "table", undefined);
    client.touch("right", "table", [0, Infinity, 0]);
    client.sendFrame(i);
  }
  const frame = FakeSocket.last.frames[1];
  assert.equal(frame.getFloat32(40, true), 0.25); // the last pose that was one
  assert.equal(frame.getUint32(36, true), 1);
  assert.deepEqual([0, 4, 8].map((at) => frame.getFloat32(76 + at, true)), [0.5, Math.fround(0.72), 0]);
  const errors = heardOf("error").map(({ message }) => message);
  assert.equal(errors.length, 2);
  assert.match(errors[0], /"phone" needs 7 finite numbers/);
  assert.match(errors[1], /"right" needs 3 finite numbers/);
});

test("a position alone keeps the rotation", async () => {
  const client = makeClient();
  client.setPose("cup", [1, 2, 3]);
  await playing(client, { objects: ["phone", "cup", "table"], n_moving: 2 });
  client.setPose("phone", [0, 1, 0, 0, 1, 0, 0]);
  client.setPose("phone", [5, 6, 7]);
  client.sendFrame(1);
  const numbers = (at) => Array.from({ length: 7 }, (_, i) => FakeSocket.last.frames.at(-1).getFloat32(at + 4 * i, true));
  assert.deepEqual(numbers(40), [5, 6, 7, 0, 1, 0, 0]);
  assert.deepEqual(numbers(68), [1, 2, 3, 0, 0, 0, 1]);
  FakeSocket.last.bytes(gainsOf({ sequence: 1 }));
  client.setPose("phone", [5, 6, 7]); // is where it was
  client.sendFrame(2);
  assert.equal(FakeSocket.last.frames.at(-1).getUint32(32, true), 0);
  assert.deepEqual(heardOf("error"), []);
});

test("an object without a pose is left to the server to refuse", async () => {
  const client = makeClient();
  await playing(client);
  client.add({ id: "cup" });
  assert.deepEqual(FakeSocket.last.messages.at(-1).object, { id: "cup" });
});

test("objects that were just added or spawned may be posed and touched before the answer", async () => {
  const client = makeClient();
  await playing(client);
  client.add({ id: "cup", name: "Cup", pose: { position_m: [0, 1, 0] }, geometry: { kind: "box", size_m: [1, 1, 1] } });
  client.spawn({ prefab: "fan.bundle", object: "fan", position_m: [0, 2, 0] });
  for (const id of ["cup", "fan"]) client.setPose(id, [1, 0, 0, 0, 0, 0, 1]);
  client.touch("left", "fan", [1, 0, 0]);
  client.sendFrame(1);
  assert.deepEqual(heardOf("error"), []);
  for (const type of ["add", "spawn"]) FakeSocket.last.answer(type, { type: "error", error: "No", message: "no" });
  client.sendFrame(2);
  assert.match(heardOf("error").at(-1).message, /No object has the id "fan"/);
});

test("objects may be posed before the answer to setMoving", async () => {
  const client = makeClient();
  await playing(client);
  client.setMoving(["phone", "table"]);
  client.setPose("table", [1, 0, 0, 0, 0, 0, 1]);
  assert.deepEqual(heardOf("error"), []);
  FakeSocket.last.answer("moving", { type: "error", error: "No", message: "no" });
  client.setPose("table", [2, 0, 0, 0, 0, 0, 1]);
  assert.match(heardOf("error").at(-1).message, /"table" is not among the moving objects/);
});

test("a second play or watch is refused, and the session goes on", async () => {
  const client = makeClient();
  await playing(client);
  for (const again of [() => client.play({ bundle: "cellar" }), () => client.watch({ session: "c2f1a09b" })]) {
    await assert.rejects(again(), { kind: "BridgeError", message: /leave/ });
  }
  assert.equal(client.isPlaying, true);
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "bake", "play"],
  );
  FakeSocket.last.fail(); // what comes back is the session
  mock.timers.tick(250);
  await online();
  assert.equal(FakeSocket.last.messages[1].type, "resume");
});

test("an attempt that fails with an error event alone is made again", async () => {
  // Node.js 20 has no "close" event where there was no connection.
  const client = makeClient();
  client.connect();
  FakeSocket.last.onerror({});
  assert.match(heardOf("offline")[0].message, /running/);
  mock.timers.tick(250);
  assert.equal(FakeSocket.opened.length, 2);
});

test("codes that no other attempt would change end the attempts", async () => {
  for (const code of [4000, 4001, 4003]) {
    const client = makeClient();
    const welcome = client.connect();
    const n = FakeSocket.opened.length;
    FakeSocket.last.open();
    FakeSocket.last.fail(code, "wrong token");
    await assert.rejects(welcome, { kind: "Refused" });
    mock.timers.tick(60_000);
    assert.equal(FakeSocket.opened.length, n);
    assert.equal(heardOf("offline").at(-1).wait_s, null);
    assert.match(heardOf("error").at(-1).message, /wrong token/);
  }
});

test("a server that does not answer is left, without waiting for its socket", async () => {
  const client = makeClient();
  client.connect();
  FakeSocket.last.open();
  const mute = FakeSocket.last;
  mock.timers.tick(10_000); // no welcome
  assert.equal(mute.isClosed, true);
  mock.timers.tick(250);
  assert.equal(FakeSocket.opened.length, 2);

  FakeSocket.opened.length = 0;
  const other = makeClient();
  await playing(other);
  other.sendFrame(1);
  clock_s += 10.1; // more than five heartbeats
  assert.equal(other.sendFrame(2), 0);
  assert.equal(other.isPlaying, false);
  assert.equal(FakeSocket.last.isClosed, true);
});

test("a message that is too long is not sent", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const scene = { ...SCENE, name: "ü".repeat(40_000) }; // 80,000 bytes
  await assert.rejects(client.bake({ scene }), { kind: "MessageTooLarge" });
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello"],
  );
});

test("leave ends the session, and another is played over the same connection", async () => {
  const client = makeClient();
  await playing(client);
  const left = client.leave();
  assert.equal(client.sendFrame(1), 0);
  FakeSocket.last.bytes(gainsOf({ sequence: 1 })); // of a frame that was under way
  assert.equal(client.gain("left", "phone"), 0);
  FakeSocket.last.answer("leave", { type: "left" });
  await left;
  const again = client.play({ bundle: "cellar" });
  await settled();
  FakeSocket.last.answer("play", PLAYING);
  await again;
  assert.equal(client.sendFrame(1), 1);
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "bake", "play", "leave", "play"],
  );
  assert.equal(FakeSocket.opened.length, 1);
  assert.deepEqual(heardOf("error"), []);
});

test("a session that begins after leave was called ends", async () => {
  const client = makeClient();
  client.connect();
  await online();
  client.play({ bundle: "cellar" });
  await settled();
  const left = client.leave();
  FakeSocket.last.answer("play", PLAYING);
  FakeSocket.last.answer("leave", { type: "left" });
  await left;
  assert.deepEqual([client.isPlaying, client.sendFrame(1)], [false, 0]);
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello"],
  );
});

test("what was left before the server was asked does not begin", async () => {
  const client = makeClient();
  client.connect();
  const early = client.play({ bundle: "cellar" });
  await client.leave();
  await online();
  await assert.rejects(early, { kind: "Cancelled" });
  const late = client.watch({ session: "c2f1a09b" });
  const left = client.leave();
  const next = client.play({ bundle: "attic" });
  await settled();
  FakeSocket.last.answer("leave", { type: "left" });
  FakeSocket.last.answer("play", PLAYING);
  await Promise.all([assert.rejects(late, { kind: "Cancelled" }), left, next]);
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type, bundle }) => bundle ?? type),
    ["hello", "leave", "attic"],
  );
  assert.equal(client.sendFrame(1), 1);
});

test("an order of a session that was left is not taken", async () => {
  const client = makeClient();
  await playing(client);
  client.leave();
  FakeSocket.last.say({ ...PLAYING, type: "order" });
  FakeSocket.last.bytes(gainsOf({ sequence: 1 }));
  assert.deepEqual([client.order, client.gain("left", "phone")], [null, 0]);
});

test("who leaves while a restarted server bakes again does not play again", async () => {
  const client = makeClient();
  await playing(client);
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  FakeSocket.last.answer("resume", { type: "error", error: "UnknownSession", message: "it ended" });
  await settled();
  FakeSocket.last.answer("bake", { type: "baking", job: 7 });
  client.leave();
  FakeSocket.last.say({ type: "baked", job: 7, objects: [] });
  await settled();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "resume", "bake", "leave"],
  );
});

test("close ends the connection for good", async () => {
  const client = makeClient();
  await playing(client);
  client.close();
  assert.equal(FakeSocket.last.isClosed, true);
  mock.timers.tick(60_000);
  assert.equal(FakeSocket.opened.length, 1);
});

test("who watches gets gains, sends none, and watches again", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const watching = client.watch({ session: "c2f1a09b" });
  await settled();
  answerWatch();
  await watching;
  FakeSocket.last.bytes(gainsOf({ sequence: 5 }));
  assert.deepEqual([client.gain("left", "phone"), client.isPlaying, client.sendFrame(1)], [0.5, false, 0]);
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello", "watch"],
  );
  answerWatch();
  const other = client.watch({ session: "77e1a09b" });
  await settled();
  answerWatch("77e1a09b");
  assert.equal((await other).session, "77e1a09b");
});

test("a second play while the first is under way is refused, and the first comes back", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const first = client.play({ bundle: "attic" });
  await settled();
  await assert.rejects(client.play({ bundle: "cellar" }), { kind: "BridgeError", message: /leave/ });
  await assert.rejects(client.watch({ session: "77e1a09b" }), { kind: "BridgeError", message: /leave/ });
  FakeSocket.last.answer("play", PLAYING);
  await first;
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  FakeSocket.last.answer("resume", { type: "error", error: "UnknownSession", message: "gone" });
  await settled();
  const [, , again] = FakeSocket.last.messages;
  assert.deepEqual([again.type, again.bundle], ["play", "attic"]);
});

test("what is watched goes on if another session does not begin", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const watching = client.watch({ session: "c2f1a09b" });
  await settled();
  answerWatch();
  await watching;
  for (const [type, begin] of [
    ["watch", () => client.watch({ session: "77e1a09b" })],
    ["play", () => client.play({ bundle: "cellar" })],
  ]) {
    const other = begin();
    await settled();
    FakeSocket.last.answer(type, { type: "error", error: "UnknownSession", message: "gone" });
    await assert.rejects(other, { kind: "UnknownSession" });
    FakeSocket.last.bytes(gainsOf({ sequence: 5 })); // the server sends on
    assert.deepEqual([client.gain("left", "phone"), client.order?.session], [0.5, "c2f1a09b"]);
  }
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type, session }) => session ?? type),
    ["hello", "c2f1a09b"],
  );
});

test("of two sessions to watch the second is asked for when the first is answered", async () => {
  const client = makeClient();
  client.connect();
  await online();
  const first = client.watch({ session: "c2f1a09b" });
  await settled();
  const second = client.watch({ session: "77e1a09b" });
  await settled();
  answerWatch();
  await first;
  await settled();
  answerWatch("77e1a09b");
  await second;
  assert.equal(client.order?.session, "77e1a09b");
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type, session }) => session ?? type),
    ["hello", "c2f1a09b", "77e1a09b"],
  );
});

test("a session that was left before its answer is not resumed", async () => {
  const client = makeClient();
  client.connect();
  await online();
  client.play({ bundle: "attic" });
  await settled();
  client.leave();
  FakeSocket.last.answer("play", PLAYING); // and the connection is lost before "left" comes
  FakeSocket.last.fail();
  mock.timers.tick(250);
  await online();
  assert.deepEqual(
    FakeSocket.last.messages.map(({ type }) => type),
    ["hello"],
  );
});
