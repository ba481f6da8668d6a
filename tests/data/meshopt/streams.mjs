// Writes streams.json: data of every kind, encoded and decoded again by the npm package meshoptimizer.
import fs from "fs";
import { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";

await MeshoptEncoder.ready;
await MeshoptDecoder.ready;

let state = 12345;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 4294967296;
}

const rows = [];
function add(name, mode, filter, count, stride, data) {
  const decoded = new Uint8Array(count * stride);
  MeshoptDecoder.decodeGltfBuffer(decoded, count, stride, data, mode, filter);
  const text = (bytes) => Buffer.from(bytes).toString("base64");
  rows.push({ name, mode, filter, count, stride, data: text(data), decoded: text(decoded) });
}

// Attributes: what is equal, smooth, random; single bytes and numbers of 2 and 4 bytes.
const fill = {
  noise: (bytes) => bytes.forEach((_, i) => (bytes[i] = random() * 256)),
  few: (bytes) => bytes.forEach((_, i) => (bytes[i] = random() < 0.1 ? random() * 256 : random() * 3)),
  zero: () => {},
  smooth8: (bytes, stride) => bytes.forEach((_, i) => (bytes[i] = 128 + 100 * Math.sin(i / stride / 9 + (i % stride)))),
  smooth16: (bytes, stride) => {
    const [values, n] = [new Uint16Array(bytes.buffer), stride / 2];
    values.forEach((_, i) => (values[i] = 30000 + 20000 * Math.sin(Math.floor(i / n) / 50 + (i % n))));
  },
  float: (bytes, stride) => {
    const [values, n] = [new Float32Array(bytes.buffer), stride / 4];
    values.forEach((_, i) => (values[i] = 3 * Math.sin(Math.floor(i / n) / 70 + (i % n))));
  },
  counter: (bytes, stride) => {
    const [values, n] = [new Uint32Array(bytes.buffer), stride / 4];
    values.forEach((_, i) => (values[i] = Math.floor(i / n) * 7));
  },
};
for (const [name, into] of Object.entries(fill)) {
  for (const stride of [4, 12]) {
    for (const [version, level] of [[0, 2], [1, 3]]) {
      const bytes = new Uint8Array(21 * stride);
      into(bytes, stride);
      const data = MeshoptEncoder.encodeVertexBufferLevel(bytes, 21, stride, level, version);
      add(`${name}, version ${version}`, "ATTRIBUTES", "NONE", 21, stride, data);
    }
  }
}

// Triangles and indices.
for (const stride of [2, 4]) {
  const table = (numbers) => new Uint8Array((stride === 2 ? Uint16Array : Uint32Array).from(numbers).buffer);
  const grid = [];
  for (const a of [0, 1, 3, 4]) grid.push(a, a + 1, a + 3, a + 3, a + 1, a + 4);
  const any = Array.from({ length: 24 }, () => Math.floor(random() * 24));
  const runs = Array.from({ length: 24 }, (_, i) => (i % 2 ? 23 - (i >> 2) : i >> 1));
  for (const [name, numbers] of [["grid", grid], ["random", any]]) {
    const data = MeshoptEncoder.encodeIndexBuffer(table(numbers), 24, stride);
    add(`${name} triangles`, "TRIANGLES", "NONE", 24, stride, data);
  }
  for (const [name, numbers] of [["random", any], ["two runs of", runs]]) {
    const data = MeshoptEncoder.encodeIndexSequence(table(numbers), 24, stride);
    add(`${name} indices`, "INDICES", "NONE", 24, stride, data);
  }
}

// Filters.
const n = 20;
function units(n_used) {
  const values = new Float32Array(4 * n);
  for (let i = 0; i < n; i++) {
    const vector = [0, 1, 2, 3].map((k) => (k < n_used ? random() * 2 - 1 : 0));
    const length = Math.hypot(...vector);
    values.set(vector.map((x) => x / length), 4 * i);
  }
  return values;
}
function filtered(name, filter, stride, data, version) {
  add(name, "ATTRIBUTES", filter, n, stride, MeshoptEncoder.encodeVertexBufferLevel(data, n, stride, 2, version));
}
for (const [stride, bits] of [[4, 8], [8, 16], [8, 12]])
  filtered("normals", "OCTAHEDRAL", stride, MeshoptEncoder.encodeFilterOct(units(3), n, stride, bits), 0);
filtered("rotations", "QUATERNION", 8, MeshoptEncoder.encodeFilterQuat(units(4), n, 8, 12), 0);
filtered("floats", "EXPONENTIAL", 16, MeshoptEncoder.encodeFilterExp(units(4), n, 16, 15), 0);
const colours = Float32Array.from({ length: 4 * n }, random);
for (const [stride, bits] of [[4, 8], [8, 16], [8, 10]])
  filtered("colours", "COLOR", stride, MeshoptEncoder.encodeFilterColor(colours, n, stride, bits), 1);

fs.writeFileSync(process.argv[2], JSON.stringify(rows, null, 0).replaceAll("},{", "},\n{") + "\n");
