// Scene JSON from nodes as three.js has them. Matrices are written by hand, by columns.

import assert from "node:assert/strict";
import { test } from "node:test";
import { poseOf, sceneFromThree } from "../scene2hap_client.js";

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const at = (x, y, z) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];
/** Turned by 90 degrees about y: x becomes -z, z becomes x. Scaled by (2, 3, 4), moved by (10, 20, 30). */
const TURNED = [0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 10, 20, 30, 1];
const HALF = Math.SQRT1_2;

const attribute = (rows) => ({
  count: rows.length,
  getX: (i) => rows[i][0],
  getY: (i) => rows[i][1],
  getZ: (i) => rows[i][2],
});

/** A tetrahedron whose faces turn counter-clockwise seen from outside; its volume is 1/6. */
const CORNERS = [
  [0, 0, 0],
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
const FACES = [
  [0, 2, 1],
  [0, 1, 3],
  [1, 2, 3],
  [0, 3, 2],
];

function geometry(corners = CORNERS, faces = FACES) {
  return {
    attributes: { position: attribute(corners) },
    index: { count: 3 * faces.length, getX: (i) => faces.flat()[i] },
    drawRange: { start: 0, count: Infinity },
  };
}

function node(name, elements, fields = {}, children = []) {
  return { name, visible: true, userData: {}, children, matrixWorld: { elements }, updateWorldMatrix() {}, ...fields };
}

const mesh = (name, elements, fields = {}) => node(name, elements, { isMesh: true, geometry: geometry(), ...fields });
const written = (...children) => sceneFromThree(node("room", IDENTITY, {}, children));

/** Sum of a . (b x c) / 6: positive where faces turn counter-clockwise seen from outside. */
function volume({ vertices_m, faces }) {
  const six = faces.map((face) => {
    const [a, b, c] = face.map((i) => vertices_m[i]);
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  });
  return six.reduce((sum, value) => sum + value, 0) / 6;
}

function close(found, expected) {
  assert.equal(found.length, expected.length);
  found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-9, `${found} is not ${expected}`));
}

test("world scale goes into the vertices, rotation and position into the pose", () => {
  const { scene, nodes } = written(mesh("cone", TURNED));
  assert.deepEqual([scene.format, scene.version, scene.name, scene.up_axis], ["scene2hap/scene", 1, "room", "y"]);
  const [cone] = scene.objects;
  assert.deepEqual([cone.id, cone.name], ["cone", "cone"]);
  close(cone.pose.position_m, [10, 20, 30]);
  close(cone.pose.rotation_xyzw, [0, HALF, 0, HALF]);
  assert.deepEqual(cone.geometry, {
    kind: "mesh",
    vertices_m: [
      [0, 0, 0],
      [0, 3, 0],
      [2, 0, 0],
      [0, 0, 4],
    ],
    faces: [
      [0, 1, 2],
      [0, 2, 3],
      [2, 1, 3],
      [0, 3, 1],
    ],
  });
  assert.equal(volume(cone.geometry), 4); // 2 * 3 * 4 / 6
  assert.equal(nodes.get("cone").name, "cone");
});

test("a mirrored mesh keeps its outside outside", () => {
  const { scene } = written(mesh("left shoe", [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]));
  const [shoe] = scene.objects;
  // As three.js decomposes it: the x axis is the one that is negated.
  close(shoe.pose.rotation_xyzw, [0, 0, 0, 1]);
  close([volume(shoe.geometry)], [1 / 6]);
  assert.deepEqual(
    shoe.geometry.vertices_m.flat().filter((value) => value < 0),
    [-1],
  );
});

test("a sheared mesh gets a proper rotation, and vertices that make up for it", () => {
  // x stays, y leans along x: a point (0, 1, 0) is at (1, 1, 0) in the world.
  const sheared = [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const { scene } = written(mesh("stack", sheared));
  close(scene.objects[0].pose.rotation_xyzw, [0, 0, 0, 1]);
  const written_m = scene.objects[0].geometry.vertices_m;
  assert.ok(written_m.some((v) => v[0] === 1 && v[1] === 1 && v[2] === 0));
});

test("a marked group is one object in its own frame", () => {
  const lamp = node("Lamp", at(1, 2, 3), { userData: { scene2hap: true } }, [
    mesh("foot", at(1, 2, 3)),
    node("arm", at(1, 3, 3), {}, [mesh("shade", at(1, 4, 3))]),
  ]);
  const { scene } = written(lamp, mesh("cup", at(0, 0, 0)));
  assert.deepEqual(
    scene.objects.map(({ id }) => id),
    ["Lamp", "cup"],
  );
  const [found] = scene.objects;
  close(found.pose.position_m, [1, 2, 3]);
  assert.equal(found.geometry.faces.length, 8);
  const own = JSON.stringify(found.geometry.vertices_m);
  assert.equal(own, "[[0,0,0],[0,1,0],[1,0,0],[0,0,1],[0,2,0],[0,3,0],[1,2,0],[0,2,1]]");
});

test("unmarked groups only hold objects; marks within marks are objects; false and hidden are left out", () => {
  const { scene, nodes } = written(
    node("kitchen", IDENTITY, {}, [
      node("stove", IDENTITY, { userData: { scene2hap: { id: "stove-1", name: "Gas stove", mass_kg: 40 } } }, [
        mesh("body", IDENTITY),
        mesh("knob", TURNED, { userData: { scene2hap: true } }),
        mesh("label", IDENTITY, { userData: { scene2hap: false } }),
      ]),
      mesh("helper", IDENTITY, { visible: false }),
    ]),
  );
  assert.deepEqual(
    scene.objects.map(({ id }) => id),
    ["stove-1", "knob"],
  );
  assert.deepEqual([scene.objects[0].name, scene.objects[0].mass_kg], ["Gas stove", 40]);
  assert.equal(scene.objects[0].geometry.faces.length, 4);
  assert.equal(nodes.get("stove-1").name, "stove");
});

test("a hinge is at the node's origin or its point, whichever object comes first", () => {
  const marked = (mark) => ({ userData: { scene2hap: mark } });
  const { scene } = written(
    mesh("door", TURNED, marked({ hinge: "cabinet" })),
    mesh("cabinet", at(10, 20, 0)),
    mesh("lid", TURNED, marked({ hinge: "cabinet", point: [1, 1, 1] })),
  );
  const [door, cabinet, lid] = scene.objects.map((one) => one.hinge);
  assert.deepEqual(door, { to: "cabinet", point_m: [0, 0, 0], other_point_m: [0, 0, 30] });
  assert.equal(cabinet, undefined);
  assert.deepEqual(lid, { to: "cabinet", point_m: [2, 3, 4], other_point_m: [4, 3, 28] });
  for (const to of ["cupboard", "door"]) {
    assert.throws(() => written(mesh("door", TURNED, marked({ hinge: to }))), {
      message: `The hinge of "door" is to "${to}", which is the id of no other object; give the id of one.`,
    });
  }
});

test("isObject marks in place of userData", () => {
  const fridge = node("fridge", IDENTITY, {}, [mesh("fridge_1", IDENTITY), mesh("fridge_2", IDENTITY)]);
  const root = node("", IDENTITY, {}, [fridge]);
  const { scene } = sceneFromThree(root, { name: "shop", isObject: (one) => one === fridge });
  assert.equal(scene.name, "shop");
  assert.deepEqual(
    scene.objects.map(({ id }) => id),
    ["fridge"],
  );
});

test("ids are unique, and names are the author's", () => {
  const gltf = { userData: { name: "Coffee mug" } }; // GLTFLoader writes Coffee_mug into node.name
  const { scene } = written(mesh("Coffee_mug", IDENTITY, gltf), mesh("Coffee_mug", IDENTITY, gltf), mesh("", IDENTITY));
  assert.deepEqual(
    scene.objects.map(({ id, name }) => [id, name]),
    [
      ["Coffee_mug", "Coffee mug"],
      ["Coffee_mug_2", "Coffee mug"],
      ["object", "object"],
    ],
  );
});

/** A cuboid as BoxGeometry has it: 24 vertices, those of a side for themselves. */
function cuboid(size, middle = [0, 0, 0]) {
  const corners = [];
  const faces = [];
  const sides = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ];
  for (const side of sides) {
    const n = corners.length;
    for (const k of side) corners.push([0, 1, 2].map((i) => middle[i] + size[i] * (((k >> i) & 1) - 0.5)));
    faces.push([n, n + 1, n + 2], [n, n + 2, n + 3]);
  }
  return geometry(corners, faces);
}

test("a cuboid that is centred on its node is written as a box", () => {
  const { scene } = written(mesh("crate", TURNED, { geometry: cuboid([0.5, 1, 0.25]) }));
  assert.deepEqual(scene.objects[0].geometry, { kind: "box", size_m: [1, 3, 1] });
});

test("a cuboid beside its node is a mesh of eight vertices", () => {
  const { scene } = written(mesh("crate", IDENTITY, { geometry: cuboid([1, 2, 3], [0, 1, 0]) }));
  const found = scene.objects[0].geometry;
  assert.deepEqual([found.kind, found.vertices_m.length, found.faces.length], ["mesh", 8, 12]);
  assert.deepEqual(found.vertices_m.map((v) => v[1]).sort(), [0, 0, 0, 0, 2, 2, 2, 2]);
  close([volume(found)], [6]);
});

test("a cuboid with a cut corner is no box", () => {
  const cut = cuboid([1, 1, 1]);
  cut.index.count -= 3;
  const { scene } = written(mesh("crate", IDENTITY, { geometry: cut }));
  assert.equal(scene.objects[0].geometry.kind, "mesh");
});

test("box: true writes the bounding box", () => {
  const marked = { userData: { scene2hap: { box: true } } };
  const { scene } = written(
    mesh("cone", IDENTITY, marked),
    mesh("crate", IDENTITY, { ...marked, geometry: cuboid([1, 1, 1]) }),
  );
  const [cone, crate] = scene.objects;
  assert.deepEqual([cone.geometry.kind, cone.geometry.vertices_m.length], ["mesh", 8]); // beside the node
  close([volume(cone.geometry)], [1]);
  assert.deepEqual(crate.geometry, { kind: "box", size_m: [1, 1, 1] });
});

test("meshes without an index, drawn parts, and faces without an area", () => {
  const corners = [...[0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2].map((i) => CORNERS[i]), [0, 0, 0], [0, 0, 0], [1, 0, 0]];
  const soup = { attributes: { position: attribute(corners) }, index: null, drawRange: { start: 0, count: Infinity } };
  const { scene } = written(
    mesh("soup", IDENTITY, { geometry: soup }),
    mesh("part", IDENTITY, { geometry: { ...soup, drawRange: { start: 3, count: 6 } } }),
    mesh("nothing", IDENTITY, { geometry: { ...soup, drawRange: { start: 12, count: 3 } } }),
  );
  const [whole, part, nothing] = scene.objects;
  assert.deepEqual([whole.geometry.vertices_m.length, whole.geometry.faces.length], [4, 4]);
  assert.equal(part.geometry.faces.length, 2);
  assert.equal(nothing, undefined);
});

test("instances are parts of one object, each with its own mirroring", () => {
  const matrices = Float32Array.of(...at(0, 0, 0), ...[-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]);
  const chairs = { isInstancedMesh: true, count: 2, instanceMatrix: { array: matrices } };
  const { scene } = written(mesh("chairs", IDENTITY, chairs));
  const found = scene.objects[0].geometry;
  assert.equal(found.faces.length, 8);
  close([volume(found)], [2 / 6]);
});

test("copies share a row of the table", () => {
  const { scene } = written(mesh("a", at(1, 0, 0)), mesh("b", at(2, 0, 0)), mesh("c", TURNED));
  assert.deepEqual(
    scene.objects.map((one) => one.geometry.kind ?? one.geometry),
    ["mesh-0", "mesh-0", "mesh"],
  );
  assert.equal(scene.geometries["mesh-0"].faces.length, 4);
});

test("every rotation comes back as its quaternion", () => {
  // Quaternions whose largest part is x, y, z and w, and their matrices by the textbook formula.
  for (const q of [
    [0.8, 0.36, 0.48, 0],
    [0.1, 0.9, -0.3, 0.3],
    [-0.1, 0.2, 0.95, 0.2],
    [0.2, -0.3, 0.1, 0.92],
  ]) {
    const n = Math.hypot(...q);
    const [x, y, z, w] = q.map((value) => value / n);
    const elements = [
      1 - 2 * (y * y + z * z),
      2 * (x * y + z * w),
      2 * (x * z - y * w),
      0,
      2 * (x * y - z * w),
      1 - 2 * (x * x + z * z),
      2 * (y * z + x * w),
      0,
      2 * (x * z + y * w),
      2 * (y * z - x * w),
      1 - 2 * (x * x + y * y),
      0,
      7,
      8,
      9,
      1,
    ];
    const found = poseOf(node("turned", elements));
    close(found, [7, 8, 9, x, y, z, w]);
  }
});

test("a scale of 0 gives a rotation all the same", () => {
  for (const elements of [
    [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 1],
    [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1],
    [0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 1],
  ]) {
    const found = poseOf(node("hidden", elements));
    assert.deepEqual(found.slice(0, 3), [1, 2, 3]);
    assert.ok(Math.abs(Math.hypot(...found.slice(3)) - 1) < 1e-9);
  }
  assert.deepEqual(written(mesh("hidden", [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 1])).scene.objects, []);
});
