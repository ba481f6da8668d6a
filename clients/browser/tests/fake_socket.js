// A WebSocket whose other end is the test.

export class FakeSocket {
  /** @type {FakeSocket[]} */ static opened = [];
  bufferedAmount = 0;
  isClosed = false;
  sent = [];

  constructor(url) {
    this.url = url;
    FakeSocket.opened.push(this);
  }

  static get last() {
    return FakeSocket.opened.at(-1);
  }

  send(data) {
    this.sent.push(data);
  }

  close() {
    this.isClosed = true;
  }

  // What the test does.

  get messages() {
    return this.sent.filter((data) => typeof data === "string").map((data) => JSON.parse(data));
  }

  get frames() {
    return this.sent.filter((data) => typeof data !== "string").map((data) => new DataView(data));
  }

  open() {
    this.onopen();
  }

  say(message) {
    this.onmessage({ data: typeof message === "string" ? message : JSON.stringify(message) });
  }

  bytes(buffer) {
    this.onmessage({ data: buffer });
  }

  /** Answer the newest request of a type. */
  answer(type, fields) {
    const { id } = this.messages.findLast((message) => message.type === type);
    this.say({ re: id, ...fields });
  }

  fail(code = 1006, reason = "") {
    this.onclose({ code, reason });
  }
}

/** Let promises that are settled go on. */
export const settled = () => new Promise((resolve) => setImmediate(resolve));

export const WELCOME = { type: "welcome", version: 1, max_message_bytes: 65536, heartbeat_s: 2 };
export const PLAYING = {
  type: "playing",
  session: "c2f1a09b",
  key: "00112233445566ff",
  layout: 1,
  objects: ["phone", "table"],
  n_moving: 1,
  hands: ["left", "right"],
  sources: [{ id: "phone", state: "ringing", states: ["ringing"], is_on: true, frequency_hz: 175 }],
  n_bands: 1,
  sequence: 0,
  watchdog_s: 0.1,
};

/** A gains message of two hands and one source, written byte by byte. */
export function gainsOf({ layout = 1, sequence, intensities = [0.125, 0], gains = [0.5, 0], flags = 0, n_bands = 1 }) {
  const view = new DataView(new ArrayBuffer(40 + 4 * (intensities.length + gains.length)));
  [0x53, 0x32, 0x48, 0x42, 2, 1].forEach((byte, i) => view.setUint8(i, byte));
  view.setUint16(6, layout, true);
  view.setUint32(16, sequence, true);
  [intensities.length, gains.length / intensities.length / n_bands, n_bands, flags].forEach((value, i) =>
    view.setUint16(32 + 2 * i, value, true),
  );
  [...intensities, ...gains].forEach((value, i) => view.setFloat32(40 + 4 * i, value, true));
  return view.buffer;
}
