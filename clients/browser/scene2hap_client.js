/**
 * Plays a scene2hap session from a browser, or from Node.js 22 and newer, over the WebSocket of `scene2hap bridge`.
 *
 * Copy this one file into your project; it needs nothing else. Coordinates are three.js's: right-handed, metres,
 * quaternions (x, y, z, w). The protocol is described in docs/bridge-protocol.md of scene2hap. Licence: MIT.
 *
 *   Scene2HapClient   connects, bakes a scene, sends frames, keeps gains and intensities
 *   sceneFromThree    writes a three.js scene as scene JSON; `poseOf` gives the pose of a node
 *   HapticOutput      drives the actuators of controllers by intensity
 *   encodeFrame, decodeGains, encodePicture   the binary messages
 *
 * @module
 */

/** @typedef {[number, number, number]} Point World coordinates [m]. */
/** @typedef {{kind: "box", size_m: Point} | {kind: "mesh", vertices_m: Point[], faces: Point[]}} Geometry */
/**
 * @typedef {object} SceneObject An entry of `objects` of scene JSON.
 * @property {string} id
 * @property {string} name
 * @property {{position_m: number[], rotation_xyzw?: number[]}} pose
 * @property {Geometry | string} geometry
 * @property {number} [mass_kg]
 * @property {string[]} [material_names] that of the largest area first
 * @property {{to: string, point_m: number[], other_point_m: number[]}} [hinge] id of the object that holds it, and the
 *   pivot in both frames
 */
/**
 * @typedef {object} SceneJson docs/scene-json.md of scene2hap
 * @property {"scene2hap/scene"} format
 * @property {1} version
 * @property {string} name
 * @property {"y" | "z"} up_axis
 * @property {SceneObject[]} objects
 * @property {Record<string, Geometry>} [geometries]
 */
/**
 * @typedef {object} Order The meaning of the numbers in frames: answer to `play`, `watch` and `order`.
 * @property {string} session
 * @property {number} layout
 * @property {string[]} objects
 * @property {number} n_moving
 * @property {string[]} hands
 * @property {{id: string, state: string | null, states: string[], is_on: boolean,
 *   frequency_hz: number}[]} sources
 * @property {number} n_bands
 * @property {number} watchdog_s
 * @property {string | null} [sink] kind of the server's sink; while it plays, intensities are 0
 * @property {string} [key]
 * @property {number} [sequence]
 */
/**
 * @typedef {object} Gains A gains message.
 * @property {number} layout
 * @property {number} sequence that of the frame which it answers
 * @property {number} n_skipped frames that the server has skipped
 * @property {number} time_s
 * @property {number} n_hands
 * @property {number} n_sources
 * @property {number} n_bands
 * @property {boolean} isPaused
 * @property {boolean} isPreparing a newer propagation field is being prepared
 * @property {Float32Array} intensities of each hand, 0 to 1
 * @property {Float32Array} gains [hand][source][band]
 */

// ---------------------------------------------------------------------------------------------- binary messages

const VERSION = 1;
const MAGIC = 0x42483253; // "S2HB" as a little-endian number
const FRAME = 1;
const GAINS = 2;
const PICTURE = 3;
const HEADER_BYTES = 40; // with the counts
const POSE_BYTES = 28;
const TOUCH_BYTES = 20;

/**
 * Encode a frame.
 *
 * @param {object} frame
 * @param {number} frame.layout
 * @param {string} frame.key 16 hexadecimal digits
 * @param {number} frame.sequence
 * @param {number} frame.time_s
 * @param {ArrayLike<number>[]} frame.poses each x, y, z [m] and quaternion x, y, z, w
 * @param {{hand: number, object: number, point_m: ArrayLike<number>}[]} frame.touches hands and objects by index
 * @returns {ArrayBuffer}
 */
export function encodeFrame({ layout, key, sequence, time_s, poses, touches }) {
  const view = new DataView(new ArrayBuffer(HEADER_BYTES + POSE_BYTES * poses.length + TOUCH_BYTES * touches.length));
  view.setUint32(0, MAGIC, true);
  view.setUint8(4, FRAME);
  view.setUint8(5, VERSION);
  view.setUint16(6, layout, true);
  for (let i = 0; i < 8; i += 1) view.setUint8(8 + i, parseInt(key.slice(2 * i, 2 * i + 2), 16));
  view.setUint32(16, sequence, true);
  view.setFloat64(24, time_s, true);
  view.setUint32(32, poses.length, true);
  view.setUint32(36, touches.length, true);
  let at = HEADER_BYTES;
  for (const pose of poses) {
    for (let i = 0; i < 7; i += 1) view.setFloat32(at + 4 * i, pose[i], true);
    at += POSE_BYTES;
  }
  for (const { hand, object, point_m } of touches) {
    view.setUint32(at, hand, true);
    view.setUint32(at + 4, object, true);
    for (let i = 0; i < 3; i += 1) view.setFloat32(at + 8 + 4 * i, point_m[i], true);
    at += TOUCH_BYTES;
  }
  return view.buffer;
}

/**
 * Decode a gains message. Raises Scene2HapError for any other message.
 *
 * @param {ArrayBuffer} buffer
 * @returns {Gains}
 */
export function decodeGains(buffer) {
  const view = new DataView(buffer);
  const isOurs = view.byteLength >= HEADER_BYTES && view.getUint32(0, true) === MAGIC;
  if (!isOurs || view.getUint8(4) !== GAINS || view.getUint8(5) !== VERSION) {
    throw new Scene2HapError("WrongMessage", `${view.byteLength} bytes are no gains message of version ${VERSION}.`);
  }
  const [n_hands, n_sources, n_bands, flags] = [0, 1, 2, 3].map((i) => view.getUint16(32 + 2 * i, true));
  const n_gains = n_hands * n_sources * n_bands;
  const n_bytes = HEADER_BYTES + 4 * (n_hands + n_gains);
  if (view.byteLength !== n_bytes) {
    throw new Scene2HapError("WrongMessage", `A gains message has ${view.byteLength} bytes; expected ${n_bytes}.`);
  }
  const floats = (at, n) => Float32Array.from({ length: n }, (_, i) => view.getFloat32(at + 4 * i, true));
  return {
    layout: view.getUint16(6, true),
    sequence: view.getUint32(16, true),
    n_skipped: view.getUint32(20, true),
    time_s: view.getFloat64(24, true),
    n_hands,
    n_sources,
    n_bands,
    isPaused: (flags & 1) !== 0,
    isPreparing: (flags & 2) !== 0,
    intensities: floats(HEADER_BYTES, n_hands),
    gains: floats(HEADER_BYTES + 4 * n_hands, n_gains),
  };
}

/**
 * Encode a picture for `bake`.
 *
 * @param {{object?: string, kind: "isolated" | "context" | "scene", view: string}} meta
 * @param {ArrayBuffer | Uint8Array} image the bytes of a PNG or JPEG file
 * @returns {ArrayBuffer}
 */
export function encodePicture(meta, image) {
  const text = new TextEncoder().encode(JSON.stringify(meta));
  const bytes = new Uint8Array(8 + text.length + image.byteLength);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, MAGIC, true);
  view.setUint8(4, PICTURE);
  view.setUint8(5, VERSION);
  view.setUint16(6, text.length, true);
  bytes.set(text, 8);
  bytes.set(image instanceof Uint8Array ? image : new Uint8Array(image), 8 + text.length);
  return bytes.buffer;
}

// ------------------------------------------------------------------------------------------------------- client

/** An error of the server, or of the connection. `kind` is the name that the server gives it. */
export class Scene2HapError extends Error {
  /** @param {string} kind @param {string} message */
  constructor(kind, message) {
    super(message);
    this.name = "Scene2HapError";
    this.kind = kind;
  }
}

const FIRST_WAIT_S = 0.25;
const LONGEST_WAIT_S = 5;
const WELCOME_WITHIN_S = 10;
/** Unanswered for so long, a connection counts as lost; a browser itself may take minutes to notice. */
const SILENT_HEARTBEATS = 5;
const CONNECTION_LOST = "ConnectionLost";
/** Codes after which another attempt would end in the same way. */
const FINAL_CODES = new Set([4000, 4001, 4003]);
/** Requests with which a session begins; one at a time is under way. */
const STARTS = new Set(["play", "watch", "resume"]);
/** Requests that change which objects there are, or which of them move. */
const CHANGES = new Set(["add", "spawn", "moving"]);

/** A promise with its functions. A rejection that nobody awaits is not reported: each is an event as well. */
function deferred() {
  const found = /** @type {any} */ ({});
  found.promise = new Promise((resolve, reject) => Object.assign(found, { resolve, reject }));
  found.promise.catch(() => {});
  return found;
}

/** Whether the first n numbers are there and finite: the server refuses a whole frame for one that is not. */
function areFinite(numbers, n) {
  for (let i = 0; i < n; i += 1) if (!Number.isFinite(numbers[i])) return false;
  return true;
}

/** Whether a request failed because the connection was lost. */
const isLoss = (error) => error instanceof Scene2HapError && error.kind === CONNECTION_LOST;

/** Mark rejections as handled; who awaits the promise still gets them. */
function handled(promise) {
  promise.catch(() => {});
  return promise;
}

/**
 * A session of `scene2hap bridge`. Nothing here waits for the network but what you await.
 *
 * Events (`client.on(type, (detail) => ...)`): each message of the server by its `type`, such as "playing", "order",
 * "progress", "impact", "warning", "error"; and
 * - "online" (the welcome) and "offline" (`{message, code, wait_s}`; `wait_s` is null when there will be no attempt),
 * - "gains" (a `Gains`).
 * Each error is an "error" event with `{error, message}`; requests that you await throw it as `Scene2HapError` as well.
 * "playing" has `isResumed`: false tells that objects, states and levels are those of the bake again.
 */
export class Scene2HapClient extends EventTarget {
  /** @type {any} */ welcome = null; // the server's last
  #token;
  #WebSocket;
  #now_s;
  #name;

  /** @type {any} */ #socket = null;
  #isOnline = false; // hello was answered
  #isWanted = false; // connect was called, and close was not
  #online = deferred(); // of the welcome of this connection or the next
  /** @type {any} */ #timer;
  #wait_s = FIRST_WAIT_S;
  #firstUnheard_s = Infinity; // when the first frame was sent since the server was last heard

  #nextId = 1;
  #requests = new Map(); // id -> {message, isQuiet, isLeft, answer}; isLeft: `leave` was sent after it
  #jobs = new Map(); // job -> answer
  /** @type {any} */ #baked = null; // the last bake request: a restarted server needs it again
  /** @type {any} */ #wanted = null; // the play or watch request that was not answered yet
  /** @type {any} */ #played = null; // that of the session that goes on

  /** @type {Order | null} */ #order = null;
  #isPlaying = false;
  #layouts = new Map(); // layout -> Order, for gains that were computed before the newest
  #objectIndex = new Map();
  #reported = new Set();

  #sequence = 0;
  #poses = new Map(); // id -> Float32Array(7)
  #touches = new Map(); // hand -> {object, point_m}
  #hasMoved = true; // since the last frame with poses
  #posesSequence = 0; // of the first frame that has the newest poses
  #heardSequence = 0; // of the last gains

  /** @type {Gains | null} */ #gains = null;
  /** @type {Order | null} */ #gainsOrder = null;
  #gainsAt_s = -Infinity;

  /**
   * @param {object} [options]
   * @param {string} [options.url]
   * @param {string} [options.token] sent in `hello` only
   * @param {string} [options.name] name and version of your program
   * @param {any} [options.WebSocket] a class like that of browsers, for old versions of Node.js
   * @param {() => number} [options.now_s] a clock that never goes back [s]
   */
  constructor({
    url = "ws://127.0.0.1:7862/",
    token,
    name = "scene2hap-browser 0.1.0",
    WebSocket = globalThis.WebSocket,
    now_s = () => performance.now() / 1000,
  } = {}) {
    super();
    this.url = url;
    this.#token = token;
    this.#name = name;
    this.#WebSocket = WebSocket;
    this.#now_s = now_s;
  }

  /**
   * Call back with the detail of each event of a type. Returns a function that ends this.
   *
   * @param {string} type
   * @param {(detail: any) => void} listener
   */
  on(type, listener) {
    const call = (event) => listener(event.detail);
    this.addEventListener(type, call);
    return () => this.removeEventListener(type, call);
  }

  // Connection

  /** Connect, and connect again whenever the connection is lost. Resolves with the server's `welcome`. */
  connect() {
    if (!this.#isWanted) {
      this.#isWanted = true;
      this.#wait_s = FIRST_WAIT_S;
      this.#open();
    }
    return this.#online.promise;
  }

  /** End the session, or stop watching. The connection stays, for another `play`; `close` ends it. */
  leave() {
    for (const request of this.#starts()) request.isLeft = true;
    const left = this.#isOnline && (this.#played || this.#wanted) ? this.request({ type: "leave" }) : Promise.resolve();
    this.#forget();
    return left.then(
      () => {},
      () => {}, // the connection was lost, which is an event as well
    );
  }

  /** Close the connection. The server keeps a session for `keep_s` unless you `leave` it before. */
  close() {
    this.#isWanted = false;
    this.#forget();
    this.#baked = null;
    this.#drop("The connection was closed.");
    this.#online.reject(new Scene2HapError(CONNECTION_LOST, "The connection was closed."));
    this.#online = deferred();
  }

  #open() {
    let socket;
    try {
      socket = new this.#WebSocket(this.url);
    } catch (cause) {
      // A URL that is none, or ws: in a page of https:. No attempt would succeed.
      this.#end(`No connection to ${this.url}: ${/** @type {Error} */ (cause).message}`, null);
      return;
    }
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      const hello = { type: "hello", version: VERSION, client: this.#name };
      const told = this.#token === undefined ? hello : { ...hello, token: this.#token };
      this.#ask(told).then(
        (welcome) => this.#welcomed(welcome),
        () => {},
      );
    };
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = (event) => this.#lost(event.code, event.reason);
    socket.onerror = () => {
      // "close" follows and says as much, but not in Node.js 20 where there was no connection.
      if (!this.#isOnline) this.#lost(1006, "");
    };
    this.#timer = setTimeout(() => this.#lost(1006, "no welcome came"), WELCOME_WITHIN_S * 1000);
  }

  #welcomed(welcome) {
    clearTimeout(this.#timer);
    this.#isOnline = true;
    this.#wait_s = FIRST_WAIT_S;
    this.welcome = welcome;
    this.#emit("online", welcome);
    if (this.#order) this.#comeBack();
    this.#online.resolve(welcome);
  }

  /** Forget the socket without waiting for its end: that of a dead network takes minutes. */
  #drop(message) {
    clearTimeout(this.#timer);
    const socket = this.#socket;
    this.#socket = null;
    this.#isOnline = this.#isPlaying = false;
    this.#firstUnheard_s = Infinity;
    this.#gainsAt_s = -Infinity;
    if (socket) {
      socket.onopen = socket.onmessage = socket.onclose = socket.onerror = null;
      socket.close();
    }
    const error = new Scene2HapError(CONNECTION_LOST, message);
    const open = [...[...this.#requests.values()].map(({ answer }) => answer), ...this.#jobs.values()];
    this.#requests.clear();
    this.#jobs.clear();
    for (const answer of open) answer.reject(error);
  }

  #lost(code, reason) {
    const wasOnline = this.#isOnline;
    let message = `The connection to ${this.url} was lost (${code}${reason ? `: ${reason}` : ""}).`;
    if (!wasOnline && code === 1006) {
      // A browser does not say why; a refused origin looks like a server that does not run.
      const origin = globalThis.location?.origin;
      const hint = origin ? `, does it admit pages of ${origin} (--origin ${origin}), and does the browser` : "";
      message = `No connection to ${this.url}. Is "scene2hap bridge" running there${hint}?`;
    }
    if (FINAL_CODES.has(code)) {
      this.#end(`${this.url} ended the connection (${code}: ${reason}).`, code);
      return;
    }
    this.#drop(message);
    if (wasOnline) this.#online = deferred();
    const wait_s = this.#wait_s;
    this.#wait_s = Math.min(2 * wait_s, LONGEST_WAIT_S);
    this.#timer = setTimeout(() => this.#open(), wait_s * 1000);
    this.#emit("offline", { message, code, wait_s });
  }

  #end(message, code) {
    this.#isWanted = false;
    this.#drop(message);
    this.#emit("offline", { message, code, wait_s: null });
    this.#online.reject(this.#fail("Refused", message));
    this.#online = deferred();
  }

  /** Take up the session after a lost connection; one that the server has forgotten is played anew. */
  async #comeBack() {
    const { session, key } = /** @type {Order} */ (this.#order);
    const played = this.#played;
    const isWatching = played.type === "watch";
    try {
      await this.#ask(isWatching ? played : { type: "resume", session, key }, !isWatching);
    } catch (cause) {
      const { kind, message } = /** @type {Scene2HapError} */ (cause);
      if (isWatching || isLoss(cause) || this.#played !== played) return; // the last: it was left meanwhile
      if (kind === "UnknownSession") this.#playAgain(played).catch(() => {});
      else this.#fail(kind, message);
    }
  }

  async #playAgain(played) {
    let again = played;
    if (played.job !== undefined && this.#baked) {
      // A restarted server counts jobs anew: the old number may be another client's job.
      const { job } = await this.#ask({ ...this.#baked, type: "bake" });
      if (this.#played !== played) return;
      again = { ...played, job };
    }
    await this.#ask(again);
  }

  // Requests

  /**
   * Send any request of the protocol. Resolves with the answer.
   *
   * @param {{type: string, [field: string]: any}} message
   * @returns {Promise<any>}
   */
  request(message) {
    if (this.#isOnline) return this.#ask(message);
    const problem = `${message.type} was not sent: there is no connection now.`;
    return handled(Promise.reject(this.#fail(CONNECTION_LOST, problem)));
  }

  #ask(message, isQuiet = false) {
    const answer = deferred();
    const id = this.#nextId;
    this.#nextId += 1;
    const text = JSON.stringify({ ...message, id });
    const most = this.#isOnline ? this.welcome.max_message_bytes : Infinity;
    if (text.length > most || new TextEncoder().encode(text).length > most) {
      // The server would close the connection.
      const problem = `${message.type} is longer than the server's ${most} bytes. Use boxes or coarser meshes.`;
      answer.reject(this.#fail("MessageTooLarge", problem));
      return answer.promise;
    }
    this.#requests.set(id, { message, isQuiet, isLeft: false, answer });
    this.#socket.send(text);
    return answer.promise;
  }

  /**
   * Bake a scene; "progress" events tell how far it is. Asks again if the connection is lost meanwhile.
   *
   * @param {{scene?: SceneJson, path?: string, config?: object, user_prompt?: string, pictures?: boolean,
   *   save?: string}} request
   * @returns {Promise<{job: number, objects: any}>}
   */
  bake(request) {
    this.#baked = request;
    this.#learnPoses(request.scene);
    return handled(this.#askUntilHeard({ ...request, type: "bake" }));
  }

  /**
   * Play a job or a bundle; from then on `sendFrame`. For another level call `leave` before.
   *
   * @param {{job?: number, bundle?: string, scene?: SceneJson, session?: object, user?: any, hands?: string[],
   *   moving?: string[], frames?: "newest" | "every", keep_s?: number, use_sink?: boolean}} request
   * @returns {Promise<Order>}
   */
  play(request) {
    if (this.#isUnderWay) return this.#refuse("play");
    this.#learnPoses(request.scene);
    return handled(this.#begin({ ...request, type: "play" }));
  }

  /**
   * Get the gains of a session that another client plays. They take the place of those of one that was watched before
   * when the server answers.
   *
   * @param {{session: string}} request
   * @returns {Promise<Order>}
   */
  watch({ session }) {
    if (this.#isUnderWay) return this.#refuse("watch");
    return handled(this.#begin({ type: "watch", session }));
  }

  /** Ask for a session, unless `leave` or another one comes before the server can be asked. */
  async #begin(message) {
    if (this.#played?.type === "play") this.#forget(); // one that waits for its connection
    this.#wanted = message;
    try {
      return await this.#askUntilHeard(message, () => this.#wanted === message);
    } finally {
      if (this.#wanted === message) this.#wanted = null;
    }
  }

  /** Requests under way with which a session begins. */
  #starts() {
    return [...this.#requests.values()].filter(({ message }) => STARTS.has(message.type));
  }

  /** Whether a session is played, or will be unless the server refuses it. */
  get #isUnderWay() {
    return this.#isPlaying || this.#starts().some(({ message, isLeft }) => message.type !== "watch" && !isLeft);
  }

  /** The server would refuse it too, but this side would have forgotten its session by then. */
  #refuse(type) {
    const problem = `${type} was not sent: a session is under way on this connection. Call leave first.`;
    return handled(Promise.reject(this.#fail("BridgeError", problem)));
  }

  /** Forget the last session, so that a new connection does not resume it; gains that still come are not felt. */
  #forget() {
    this.#order = this.#played = this.#wanted = null;
    this.#isPlaying = false;
    this.#gainsAt_s = -Infinity;
  }

  async #askUntilHeard(message, isStillWanted = () => true) {
    for (;;) {
      await this.#online.promise;
      const [before] = STARTS.has(message.type) ? this.#starts() : [];
      if (before) {
        await before.answer.promise.catch(() => {});
        continue;
      }
      if (!isStillWanted()) {
        throw new Scene2HapError("Cancelled", `${message.type} was not sent: leave or another request came first.`);
      }
      try {
        return await this.#ask(message);
      } catch (error) {
        if (!isLoss(error) || !this.#isWanted) throw error;
      }
    }
  }

  /** Send a picture for the next `bake` that has `pictures: true`. See `encodePicture`. */
  sendPicture(meta, image) {
    if (this.#isOnline) this.#socket.send(encodePicture(meta, image));
    else this.#fail(CONNECTION_LOST, "A picture was not sent: there is no connection now.");
  }

  /** @param {number} job as in the "baking" event */
  cancel(job) {
    return this.request({ type: "cancel", job });
  }

  /** Choose the objects whose poses are sent. @param {string[]} moving */
  setMoving(moving) {
    return this.request({ type: "moving", moving });
  }

  /** @param {string} source @param {{on?: boolean, state?: string, gain_db?: number, mute?: boolean}} change */
  setSource(source, change) {
    return this.request({ ...change, type: "set_source", source });
  }

  /** @param {{gain_db?: number, mute?: boolean, profile?: any}} change */
  setUser(change) {
    return this.request({ ...change, type: "set_user" });
  }

  /**
   * @param {string} object
   * @param {ArrayLike<number>} point_m
   * @param {{speed_m_s?: number, impulse_n_s?: number, with_object?: string}} how one of speed and impulse
   */
  strike(object, point_m, how) {
    return this.request({ ...how, type: "strike", object, point_m: Array.from(point_m).slice(0, 3) });
  }

  /** @param {SceneObject} object with its own geometry, as `sceneFromThree` writes them */
  add(object) {
    this.#learnPoses({ objects: [object] });
    return this.request({ type: "add", object });
  }

  /** @param {{prefab?: string, job?: number, object: string, position_m: number[], rotation_xyzw?: number[]}} what */
  spawn(what) {
    this.#learnPoses({ objects: [{ id: what.object, pose: what }] });
    return this.request({ ...what, type: "spawn" });
  }

  /** @param {string} object */
  remove(object) {
    return this.request({ type: "remove", object });
  }

  pause() {
    return this.request({ type: "pause" });
  }

  unpause() {
    return this.request({ type: "unpause" });
  }

  /** @param {string} hand @returns {Promise<{text: string}>} */
  explain(hand) {
    return this.request({ type: "explain", hand });
  }

  stats() {
    return this.request({ type: "stats" });
  }

  // Frames

  /** Whether frames are taken now. */
  get isPlaying() {
    return this.#isPlaying;
  }

  /** The order of objects, hands and sources, once a session was played. */
  get order() {
    return this.#order;
  }

  /** Sequence of the last frame. */
  get sequence() {
    return this.#sequence;
  }

  /**
   * Set where an object is, from the next frame on. A position alone (x, y, z) keeps the rotation.
   *
   * @param {string} id
   * @param {ArrayLike<number>} pose x, y, z [m], quaternion x, y, z, w; see `poseOf`
   */
  setPose(id, pose) {
    const n = pose?.length === 3 ? 3 : 7;
    if (!pose || !areFinite(pose, n)) {
      this.#report(`The pose of ${JSON.stringify(id)} needs 7 finite numbers: x, y, z [m], quaternion x, y, z, w.`);
      return;
    }
    const known = this.#poses.get(id);
    if (this.#isPlaying) {
      const index = this.#objectIndex.get(id);
      if (index !== undefined && index >= /** @type {Order} */ (this.#order).n_moving) {
        const problem = `${JSON.stringify(id)} is not among the moving objects, so its pose is not sent.`;
        this.#reportWrong(`${problem} Name all that moves in play or setMoving.`, "not moving");
      } else if (index === undefined && !known) {
        this.#reportWrong(`No object has the id ${JSON.stringify(id)}; its pose is not sent.`);
      }
    }
    const kept = known ?? Float32Array.of(0, 0, 0, 0, 0, 0, 1);
    if (!known) this.#poses.set(id, kept);
    // Compared as the server gets them, in single precision.
    else if (known.every((value, i) => i >= n || value === Math.fround(pose[i]))) return;
    for (let i = 0; i < n; i += 1) kept[i] = pose[i];
    this.#hasMoved = true;
  }

  /**
   * Lay a hand on an object, from the next frame on.
   *
   * @param {string} hand
   * @param {string} object
   * @param {ArrayLike<number> | Iterable<number>} point_m in the world; a Vector3 of three.js is one
   */
  touch(hand, object, point_m) {
    const point = Array.from(point_m ?? []);
    if (areFinite(point, 3)) this.#touches.set(hand, { object, point_m: point });
    else this.#report(`The touch of ${JSON.stringify(hand)} needs 3 finite numbers: x, y, z [m].`);
  }

  /** Lift a hand. @param {string} hand */
  lift(hand) {
    this.#touches.delete(hand);
  }

  /**
   * Send poses and touches as they are now. Call it once per frame of the game.
   *
   * Returns the frame's sequence, or 0 if it was not sent: there is no session at the moment, or the network is slower
   * than the game. Nothing is lost then, since the next frame has the newest of everything.
   */
  sendFrame(time_s = this.#now_s()) {
    const order = this.#order;
    if (!this.#isPlaying || !order) return 0;
    const now_s = this.#now_s();
    if (now_s - this.#firstUnheard_s > SILENT_HEARTBEATS * this.welcome.heartbeat_s) {
      this.#lost(1006, "the server has not answered for long");
      return 0;
    }
    const poses = this.#posesToSend(order);
    const touches = [];
    for (const [name, { object, point_m }] of this.#touches) {
      const [hand, index] = [order.hands.indexOf(name), this.#objectIndex.get(object) ?? -1];
      if (hand < 0) this.#report(`No hand is called ${JSON.stringify(name)}; hands are ${order.hands.join(", ")}.`);
      else if (index < 0) this.#reportWrong(`No object has the id ${JSON.stringify(object)}; ${name} touches nothing.`);
      else touches.push({ hand, object: index, point_m });
    }
    const key = /** @type {string} */ (order.key);
    const frame = encodeFrame({ layout: order.layout, key, sequence: this.#sequence + 1, time_s, poses, touches });
    // A queue would make everything late: the newest frame waits here instead, in #poses and #touches.
    if (this.#socket.bufferedAmount > 4 * frame.byteLength) return 0;
    this.#sequence += 1;
    if (this.#hasMoved) this.#posesSequence = this.#sequence;
    this.#hasMoved = false;
    this.#firstUnheard_s = Math.min(this.#firstUnheard_s, now_s);
    this.#socket.send(frame);
    return this.#sequence;
  }

  /** Poses of all that moves; none if the server has answered a frame that had the same. */
  #posesToSend(order) {
    // The server may replace a waiting frame by a newer one, so the newer one must repeat its poses.
    if (!this.#hasMoved && this.#heardSequence >= this.#posesSequence) return [];
    const poses = [];
    for (const id of order.objects.slice(0, order.n_moving)) {
      const pose = this.#poses.get(id);
      if (!pose) {
        this.#report(`No pose of ${JSON.stringify(id)} is known, so none is sent. Call setPose for all that moves.`);
        return [];
      }
      poses.push(pose);
    }
    return poses;
  }

  #learnPoses(scene) {
    for (const { id, pose } of scene?.objects ?? []) {
      const { position_m = [0, 0, 0], rotation_xyzw = [0, 0, 0, 1] } = pose ?? {};
      const numbers = [...position_m, ...rotation_xyzw];
      if (areFinite(numbers, 7)) this.#poses.set(id, Float32Array.from(numbers)); // the server refuses others
    }
  }

  // Gains

  /** Whether gains came within the session's `watchdog_s`. Otherwise all gains and intensities are 0. */
  get isFelt() {
    const order = this.#gainsOrder;
    return this.#isOnline && order !== null && this.#now_s() - this.#gainsAt_s <= order.watchdog_s;
  }

  /** Amplitude for an actuator that knows no more than an amplitude, 0 to 1. @param {string} hand */
  intensity(hand) {
    if (!this.isFelt) return 0;
    const index = /** @type {Order} */ (this.#gainsOrder).hands.indexOf(hand);
    return index < 0 ? 0 : /** @type {Gains} */ (this.#gains).intensities[index];
  }

  /**
   * Gain of a source at a hand.
   *
   * @param {string} hand
   * @param {string} source
   * @param {number} [band] the loudest if missing
   */
  gain(hand, source, band) {
    if (!this.isFelt) return 0;
    const [order, gains] = [/** @type {Order} */ (this.#gainsOrder), /** @type {Gains} */ (this.#gains)];
    const [row, column] = [order.hands.indexOf(hand), order.sources.findIndex(({ id }) => id === source)];
    if (row < 0 || column < 0) return 0;
    const at = (row * gains.n_sources + column) * gains.n_bands;
    if (band !== undefined) return gains.gains[at + band] ?? 0;
    return gains.gains.subarray(at, at + gains.n_bands).reduce((loudest, value) => Math.max(loudest, value), 0);
  }

  // What the server sends

  #receive(data) {
    this.#firstUnheard_s = Infinity;
    try {
      if (typeof data === "string") this.#takeMessage(JSON.parse(data));
      else this.#takeGains(decodeGains(data));
    } catch (cause) {
      this.#fail("WrongMessage", `A message of the server cannot be read: ${/** @type {Error} */ (cause).message}`);
    }
  }

  #takeMessage(message) {
    const { type, re, job } = message;
    const request = this.#requests.get(re);
    this.#requests.delete(re);
    const isOfSession = type === "order" && this.#order !== null; // of one that was left it is of no use
    const hasBegun = (type === "playing" || type === "watching") && !request?.isLeft;
    if (hasBegun && request && request.message.type !== "resume") this.#played = request.message;
    if (hasBegun || isOfSession) this.#takeOrder(message);
    if (type === "left") [this.#order, this.#played, this.#isPlaying] = [null, null, false];
    if (type === "baking" && request) {
      this.#jobs.set(job, request.answer); // `bake` resolves with `baked`
    } else if (type === "error") {
      (request?.answer ?? this.#jobs.get(job))?.reject(new Scene2HapError(message.error, message.message));
      this.#jobs.delete(job);
      if (request?.isQuiet) return;
    } else {
      request?.answer.resolve(message);
      if (type === "baked") this.#jobs.get(job)?.resolve(message);
      if (type === "cancelled") this.#jobs.get(job)?.reject(new Scene2HapError("Cancelled", `${job} was cancelled.`));
      if (type === "baked" || type === "cancelled") this.#jobs.delete(job);
    }
    const detail = type === "playing" ? { ...message, isResumed: request?.message.type === "resume" } : message;
    if (typeof type === "string") this.#emit(type, detail);
  }

  #takeOrder(message) {
    if (message.type === "order") {
      this.#order = { ...this.#order, ...message };
    } else {
      this.#order = message;
      this.#layouts.clear();
      this.#sequence = this.#heardSequence = message.sequence ?? 0;
      this.#isPlaying = message.type === "playing";
    }
    const order = /** @type {Order} */ (this.#order);
    this.#layouts.set(order.layout & 0xffff, order);
    if (this.#layouts.size > 8) this.#layouts.delete(this.#layouts.keys().next().value);
    this.#objectIndex = new Map(order.objects.map((id, i) => [id, i]));
    this.#reported.clear();
    this.#hasMoved = true;
  }

  #takeGains(gains) {
    if (this.#order === null) return; // of a session that was left
    const order = this.#layouts.get(gains.layout);
    const isKnown = order && order.hands.length === gains.n_hands && order.sources.length === gains.n_sources;
    if (!isKnown) {
      this.#report(`Gains of layout ${gains.layout} do not fit the order of objects, hands and sources.`);
      return;
    }
    this.#gains = gains;
    this.#gainsOrder = order;
    this.#gainsAt_s = this.#now_s();
    this.#heardSequence = gains.sequence;
    this.#emit("gains", gains);
  }

  /** Report what is wrong in many frames once, or once for all that has the same key. */
  #report(message, key = message) {
    if (this.#reported.has(key)) return;
    this.#reported.add(key);
    this.#fail("FrameError", message);
  }

  /** Report a wrong id, unless a request waits whose answer may make it right. */
  #reportWrong(problem, key = problem) {
    const isChanging = [...this.#requests.values()].some(({ message }) => CHANGES.has(message.type));
    if (!isChanging) this.#report(problem, key);
  }

  /** Report an error of this side in the form of the server's, and return it. */
  #fail(kind, message) {
    this.#emit("error", { type: "error", error: kind, message });
    return new Scene2HapError(kind, message);
  }

  #emit(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

// ---------------------------------------------------------------------------------------------- three.js scenes

/**
 * Write a three.js scene as scene JSON. Works by the shape of the objects, without importing three.js.
 *
 * Each visible Mesh becomes an object, unless `userData.scene2hap` of it or of what it is in says otherwise:
 * - `true`, or an object with `id`, `name`, `mass_kg`, `box` or `hinge`: this node and all below it is one object;
 * - `false`: this node and all below it is left out.
 * A marked node below a marked node is an object of its own. `box: true` writes the bounding box instead of the mesh.
 * `hinge: "cabinet"` holds the object on the one of this id, at the node's origin or at `point: [x, y, z]` in the
 * node's frame.
 * World scale and mirroring go into the vertices. Poses and vertices are metres, as in WebXR.
 *
 * @param {any} root a Scene, Group or Mesh
 * @param {{name?: string, isObject?: (node: any) => boolean}} [options] `isObject` marks nodes, in place of userData
 * @returns {{scene: SceneJson, nodes: Map<string, any>}} `nodes` has the node of each id, for `poseOf`
 * @throws {Scene2HapError} a hinge is to an id that no other object has
 */
export function sceneFromThree(root, { name = root.name || "scene", isObject = () => false } = {}) {
  root.updateWorldMatrix(true, true);
  const found = [];
  collect(root, null, isObject, found);
  const nodes = new Map();
  const objects = [];
  const hinged = [];
  for (const { node, mark, meshes } of found) {
    const pose = poseOf(node);
    const areas = new Map();
    const geometry = geometryOf(meshes, pose, mark.box === true, areas);
    if (!geometry) continue;
    // GLTFLoader keeps the author's name in userData, and changes node.name.
    const authored = mark.name ?? (node.userData?.name || node.name || node.geometry?.name || "object");
    const id = unused(mark.id ?? (node.name || authored), nodes);
    nodes.set(id, node);
    const row = { id, name: authored, pose: { position_m: pose.slice(0, 3), rotation_xyzw: pose.slice(3) }, geometry };
    if (mark.mass_kg !== undefined) row.mass_kg = mark.mass_kg;
    if (areas.size > 0) row.material_names = [...areas.keys()].sort((a, b) => areas.get(b) - areas.get(a));
    if (mark.hinge !== undefined) hinged.push({ row, mark });
    objects.push(row);
  }
  for (const { row, mark } of hinged) row.hinge = hingeOf(row.id, mark, nodes);
  return {
    scene: { format: "scene2hap/scene", version: 1, name, up_axis: "y", objects, geometries: shareCopies(objects) },
    nodes,
  };
}

/**
 * Pose of a node in the world without scale: x, y, z [m], quaternion x, y, z, w.
 *
 * The same rotation as `getWorldQuaternion` where that exists, and a proper one where parents shear the node. Use it
 * for `setPose` of nodes whose meshes `sceneFromThree` wrote: the vertices are in this frame.
 *
 * @param {any} node an Object3D
 * @returns {number[]}
 */
export function poseOf(node) {
  node.updateWorldMatrix?.(true, false);
  const m = node.matrixWorld.elements; // by columns
  const side = determinant(m) < 0 ? -1 : 1;
  const x = unit([side * m[0], side * m[1], side * m[2]]) ?? [1, 0, 0];
  const along = x[0] * m[4] + x[1] * m[5] + x[2] * m[6];
  const leaning = [0, 1, 2].map((i) => m[4 + i] - along * x[i]);
  const y = unit(leaning) ?? unit(cross([m[8], m[9], m[10]], x)) ?? perpendicular(x);
  return [m[12], m[13], m[14], ...quaternion(x, y, cross(x, y))];
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const determinant = (m) => {
  const [x, y, z] = [0, 4, 8].map((at) => [m[at], m[at + 1], m[at + 2]]);
  return cross(x, y).reduce((sum, value, i) => sum + value * z[i], 0);
};

function unit(v) {
  const length = Math.hypot(...v);
  return length > 1e-12 ? v.map((value) => value / length) : null; // a scale of 0 hides things
}

function perpendicular(x) {
  return /** @type {number[]} */ (unit(cross(Math.abs(x[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0], x)));
}

/**
 * Quaternion (x, y, z, w) of the rotation with these columns; divides by its largest part.
 *
 * @param {number[]} x
 * @param {number[]} y
 * @param {number[]} z
 */
function quaternion([xx, xy, xz], [yx, yy, yz], [zx, zy, zz]) {
  const squares = [1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz]; // 4 x², 4 y², 4 z², 4 w²
  const largest = squares.indexOf(Math.max(...squares));
  const s = 2 * Math.sqrt(squares[largest]);
  return [
    [s / 4, (yx + xy) / s, (zx + xz) / s, (yz - zy) / s],
    [(yx + xy) / s, s / 4, (zy + yz) / s, (zx - xz) / s],
    [(zx + xz) / s, (zy + yz) / s, s / 4, (xy - yx) / s],
    [(yz - zy) / s, (zx - xz) / s, (xy - yx) / s, s / 4],
  ][largest];
}

function collect(node, group, isObject, found) {
  const said = node.userData?.scene2hap;
  if (said === false) return;
  const mark = said ?? (isObject(node) ? true : null);
  if (node.visible === false && !mark) return;
  let owner = group;
  if (mark || (!group && node.isMesh)) {
    owner = { node, mark: mark === true ? {} : (mark ?? {}), meshes: [] };
    found.push(owner);
  }
  if (node.isMesh) owner.meshes.push(node);
  for (const child of node.children) collect(child, mark ? owner : group, isObject, found);
}

/** The hinge of an object whose mark names another one. */
function hingeOf(id, { hinge: to, point = [0, 0, 0] }, nodes) {
  if (to === id || !nodes.has(to)) {
    const message = `The hinge of "${id}" is to "${to}", which is the id of no other object; give the id of one.`;
    throw new Scene2HapError("SceneError", message);
  }
  const pivot = transform(nodes.get(id).matrixWorld.elements, point);
  const [point_m, other_point_m] = [id, to].map((one) => intoFrame(poseOf(nodes.get(one)), pivot).map(micrometres));
  return { to, point_m, other_point_m };
}

function unused(wanted, taken) {
  let id = wanted;
  for (let n = 2; taken.has(id); n += 1) id = `${wanted}_${n}`;
  return id;
}

/** Micrometres: finer digits would only make the JSON longer. The sum makes 0 of -0. */
const micrometres = (value) => Math.round(value * 1e6) / 1e6 + 0;

/**
 * All meshes in the frame of a pose, as one mesh or, where it is one, a box. Null if nothing is left. `areas` gets the
 * area of each named material.
 */
function geometryOf(meshes, pose, isBoxWanted, areas) {
  const vertices_m = [];
  const faces = [];
  for (const mesh of meshes) {
    const matrices = mesh.isInstancedMesh ? mesh.instanceMatrix.array : null;
    if (!matrices) addPiece(mesh, null, pose, vertices_m, faces, areas);
    for (let k = 0; matrices && k < mesh.count; k += 1) {
      addPiece(mesh, matrices.subarray(16 * k), pose, vertices_m, faces, areas);
    }
  }
  if (faces.length === 0) return null;
  return boxOf(vertices_m, faces.length, isBoxWanted) ?? { kind: "mesh", vertices_m, faces };
}

function addPiece(mesh, copy, pose, vertices_m, faces, areas) {
  const world = mesh.matrixWorld.elements;
  const isMirrored = determinant(world) * (copy ? determinant(copy) : 1) < 0;
  const { geometry } = mesh;
  const { position } = geometry.attributes;
  const isDeformed = mesh.isSkinnedMesh || (mesh.morphTargetInfluences?.length ?? 0) > 0;
  const scratch = isDeformed ? mesh.position.clone() : null;
  const vertex = (i) => {
    // An attribute may be interleaved or of integers; its getters give numbers.
    let v = [position.getX(i), position.getY(i), position.getZ(i)];
    if (scratch) v = mesh.getVertexPosition(i, scratch).toArray();
    return intoFrame(pose, transform(world, copy ? transform(copy, v) : v)).map(micrometres);
  };
  // Equal vertices become one: three.js repeats those whose normals or texture coordinates differ.
  const indexOfPlace = new Map();
  const indexOf = new Map();
  const welded = (i) => {
    if (!indexOf.has(i)) {
      const v = vertex(i);
      const place = v.join();
      if (!indexOfPlace.has(place)) indexOfPlace.set(place, vertices_m.push(v) - 1);
      indexOf.set(i, indexOfPlace.get(place));
    }
    return indexOf.get(i);
  };
  const { index, drawRange } = geometry;
  const n = index ? index.count : position.count;
  const end = Math.min(n, drawRange.start + drawRange.count);
  for (let i = drawRange.start; i + 2 < end; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => welded(index ? index.getX(i + k) : i + k));
    if (a === b || b === c || c === a) continue;
    faces.push(isMirrored ? [a, c, b] : [a, b, c]);
    const name = materialOf(mesh, i)?.name;
    if (name) areas.set(name, (areas.get(name) ?? 0) + areaOf(vertices_m[a], vertices_m[b], vertices_m[c]));
  }
}

/** The material of the triangle whose first corner is number i of the index. */
function materialOf({ material, geometry }, i) {
  if (!Array.isArray(material)) return material;
  return material[geometry.groups.find(({ start, count }) => i >= start && i < start + count)?.materialIndex];
}

function areaOf(a, b, c) {
  const [u, v] = [b, c].map((corner) => corner.map((value, i) => value - a[i]));
  return Math.hypot(...cross(u, v)) / 2;
}

/** @param {ArrayLike<number>} m by columns @param {number[]} point */
function transform(m, [x, y, z]) {
  return [0, 1, 2].map((i) => m[i] * x + m[4 + i] * y + m[8 + i] * z + m[12 + i]);
}

/**
 * A world point in the frame of a pose: the inverse rotation of what remains without the position.
 *
 * @param {number[]} pose
 * @param {number[]} point
 */
function intoFrame([px, py, pz, qx, qy, qz, qw], [x, y, z]) {
  const v = [x - px, y - py, z - pz];
  const q = [-qx, -qy, -qz];
  const t = cross(q, v).map((value) => 2 * value);
  const u = cross(q, t);
  return v.map((value, i) => value + qw * t[i] + u[i]);
}

/** The box that these vertices are, or their bounding box if it is wanted. Boxes are centred on their pose. */
function boxOf(vertices_m, n_faces, isWanted) {
  const [low, high] = [Infinity, -Infinity].map((from) => [from, from, from]);
  for (const v of vertices_m) {
    for (let i = 0; i < 3; i += 1) {
      low[i] = Math.min(low[i], v[i]);
      high[i] = Math.max(high[i], v[i]);
    }
  }
  const isSolid = high.every((value, i) => value > low[i]);
  const isCentred = high.every((value, i) => Math.abs(value + low[i]) < 2e-6);
  const isCorner = (v) => v.every((value, i) => value === low[i] || value === high[i]);
  const isBox = n_faces === 12 && vertices_m.length === 8 && vertices_m.every(isCorner);
  if (!isSolid || !(isWanted || isBox)) return null;
  if (isCentred) return { kind: "box", size_m: high.map((value, i) => micrometres(value - low[i])) };
  const corners = Array.from({ length: 8 }, (_, k) => [0, 1, 2].map((i) => ((k >> i) & 1 ? high[i] : low[i])));
  // Corner k has x, y, z high by its bits 0, 1, 2; faces turn counter-clockwise seen from outside.
  const sides = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ];
  return {
    kind: "mesh",
    vertices_m: corners,
    faces: sides.flatMap(([a, b, c, d]) => [
      [a, b, c],
      [a, c, d],
    ]),
  };
}

/** Put meshes that several objects have into a table, which is returned. */
function shareCopies(objects) {
  const byText = new Map();
  for (const object of objects) {
    if (object.geometry.kind !== "mesh") continue;
    const text = JSON.stringify(object.geometry);
    byText.set(text, [...(byText.get(text) ?? []), object]);
  }
  const table = {};
  for (const copies of byText.values()) {
    if (copies.length < 2) continue;
    const key = `mesh-${Object.keys(table).length}`;
    table[key] = copies[0].geometry;
    for (const object of copies) object.geometry = key;
  }
  return table;
}

// ---------------------------------------------------------------------------------------------------- actuators

/**
 * Drives actuators of controllers by intensity, with few calls a second.
 *
 * An actuator gets a pulse every `interval_s`, of the intensity now, or of the largest since the last pulse if that was
 * weaker, so that short impacts are felt. A pulse lasts two intervals: it bridges to the next, and ends by itself when
 * the page hangs. Below `least` an actuator gets one pulse of 0 and then none.
 *
 * WebXR controllers vibrate always. Two fall-backs are off until the user switches them on: `isRumbleOn` (gamepads) and
 * `isVibrateOn` (phones, by `navigator.vibrate`, which needs a click before).
 */
export class HapticOutput {
  #now_s;
  #channels = new Map(); // key -> {peaks since the last pulse, last pulse, at_s, pulse}
  isRumbleOn = false;
  isVibrateOn = false;

  /**
   * @param {object} [options]
   * @param {number} [options.interval_s]
   * @param {number} [options.least] intensity that is not felt [-]
   * @param {number} [options.strength] what intensities are multiplied with, as the user likes it
   * @param {() => number} [options.now_s]
   */
  constructor({ interval_s = 0.05, least = 0.01, strength = 1, now_s = () => performance.now() / 1000 } = {}) {
    this.interval_s = interval_s;
    this.least = least;
    this.strength = strength;
    this.#now_s = now_s;
  }

  /**
   * Call once per frame.
   *
   * @param {(hand: string) => number} intensityOf such as `(hand) => client.intensity(hand)`
   * @param {object} [devices]
   * @param {Iterable<any>} [devices.inputSources] of the XRSession; "left" and "right" are the hands
   * @param {Iterable<any>} [devices.gamepads] in place of `navigator.getGamepads()`
   */
  update(intensityOf, { inputSources = [], gamepads } = {}) {
    const [left, right] = ["left", "right"].map((hand) => this.#level(intensityOf(hand)));
    for (const { handedness, gamepad } of inputSources) {
      const actuator = actuatorOf(gamepad);
      if (!actuator) continue;
      const level = { left, right }[handedness] ?? Math.max(left, right);
      this.#drive(`xr ${handedness}`, this.interval_s, [level], ([value], ms) => pulse(actuator, value, ms));
    }
    if (this.isRumbleOn) {
      for (const gamepad of gamepads ?? globalThis.navigator?.getGamepads?.() ?? []) {
        if (gamepad?.connected === false || !gamepad) continue;
        const actuator = gamepad.vibrationActuator;
        const key = `pad ${gamepad.index ?? 0}`;
        if (actuator?.playEffect) {
          // The strong motor is in the left grip, the weak one in the right.
          this.#drive(key, this.interval_s, [left, right], ([strongMagnitude, weakMagnitude], duration) =>
            actuator.playEffect("dual-rumble", { duration, strongMagnitude, weakMagnitude }),
          );
        } else if (actuatorOf(gamepad)) {
          const other = actuatorOf(gamepad);
          this.#drive(key, this.interval_s, [Math.max(left, right)], ([value], ms) => pulse(other, value, ms));
        }
      }
    }
    if (this.isVibrateOn && typeof globalThis.navigator?.vibrate === "function") {
      // Phones have no amplitude: the motor runs for a part of each interval.
      const interval_s = 2 * this.interval_s;
      this.#drive("phone", interval_s, [Math.max(left, right)], ([value], ms) =>
        navigator.vibrate(value >= 0.95 ? ms : Math.round((value * ms) / 2)),
      );
    }
  }

  /** Silence everything at once: the game is paused or the session ends. */
  stop() {
    for (const channel of this.#channels.values()) {
      const { last, pulse: pulseFor } = channel;
      if (last.some((value) => value > 0))
        run(() =>
          pulseFor(
            last.map(() => 0),
            0,
          ),
        );
    }
    this.#channels.clear();
  }

  #level(intensity) {
    const level = Math.min(Math.max(intensity * this.strength, 0), 1);
    return level >= this.least ? level : 0;
  }

  #drive(key, interval_s, levels, pulseFor) {
    const now_s = this.#now_s();
    const none = levels.map(() => 0);
    const channel = this.#channels.get(key) ?? { peaks: none, last: none, at_s: -Infinity };
    this.#channels.set(key, channel);
    channel.pulse = pulseFor;
    channel.peaks = channel.peaks.map((peak, i) => Math.max(peak, levels[i]));
    // A millisecond less: frames of 1/60 s do not add up to intervals exactly.
    if (now_s - channel.at_s < interval_s - 0.001) return;
    const { last } = channel;
    const values = channel.peaks.map((peak, i) => (peak > last[i] ? peak : levels[i]));
    channel.peaks = none;
    channel.last = values;
    const isFelt = values.some((value) => value > 0);
    if (!isFelt && last.every((value) => value === 0)) return;
    channel.at_s = now_s;
    run(() => pulseFor(values, isFelt ? Math.round(2000 * interval_s) : 0));
  }
}

/** The actuator of a controller that takes pulses: `hapticActuators`, or what some browsers have instead. */
function actuatorOf(gamepad) {
  const found = [...(gamepad?.hapticActuators ?? []), gamepad?.vibrationActuator];
  return found.find((one) => one?.pulse || one?.playEffect);
}

function pulse(actuator, value, ms) {
  if (actuator.pulse) return actuator.pulse(value, ms);
  return actuator.playEffect("dual-rumble", { duration: ms, strongMagnitude: value, weakMagnitude: value });
}

/** Actuators refuse for many reasons, such as a controller that sleeps; a game goes on without. */
function run(call) {
  try {
    Promise.resolve(call()).catch(() => {});
  } catch {
    // The same, by an exception.
  }
}
