// A desk as a three.js scene, one metre high and half a metre in front of who stands at the origin.

import * as THREE from "three";

const TOP_M = 0.75; // of the table

const material = (color, roughness = 0.7, metalness = 0) =>
  new THREE.MeshStandardMaterial({ color, roughness, metalness });

function mesh(geometry, look, [x, y, z]) {
  const made = new THREE.Mesh(geometry, look);
  made.position.set(x, y, z);
  made.castShadow = made.receiveShadow = true;
  return made;
}

const box = (x, y, z) => new THREE.BoxGeometry(x, y, z);
const cylinder = (top, bottom, height) => new THREE.CylinderGeometry(top, bottom, height, 32);

/** Several meshes as one object: `userData.scene2hap` tells `sceneFromThree` so. */
function thing(id, name, [x, y, z], ...parts) {
  const group = new THREE.Group();
  group.name = id;
  group.userData.scene2hap = { id, name };
  group.position.set(x, y, z);
  group.add(...parts);
  return group;
}

export function makeDesk() {
  const wood = material(0xb98b5a);
  const black = material(0x23262b, 0.35);
  const steel = material(0xb4bac2, 0.45, 0.2);
  const legs = [
    [-0.6, -0.25],
    [0.6, -0.25],
    [-0.6, 0.25],
    [0.6, 0.25],
  ].map(([x, z]) => mesh(box(0.06, TOP_M - 0.04, 0.06), wood, [x, (TOP_M - 0.04) / 2 - (TOP_M - 0.02), z]));
  const table = thing(
    "table",
    "Wooden table",
    [0, TOP_M - 0.02, 0],
    mesh(box(1.4, 0.04, 0.7), wood, [0, 0, 0]),
    ...legs,
  );

  const phone = thing(
    "phone",
    "Smartphone",
    [-0.32, TOP_M + 0.0045, 0.12],
    mesh(box(0.075, 0.009, 0.155), black, [0, 0, 0]),
    mesh(box(0.069, 0.001, 0.145), material(0x3c6ea8, 0.2), [0, 0.0045, 0]),
  );

  const grip = mesh(box(0.05, 0.04, 0.13), material(0x2f4f6f, 0.5), [0, 0, 0]);
  const head = mesh(cylinder(0.02, 0.02, 0.04), steel, [0, 0, -0.085]);
  head.rotation.x = Math.PI / 2;
  const shaver = thing("shaver", "Electric shaver", [0.42, TOP_M + 0.02, 0.1], grip, head);

  const clay = material(0xd8e0e6, 0.4);
  const handle = mesh(new THREE.TorusGeometry(0.026, 0.006, 12, 32), clay, [0.044, 0, 0]);
  const cup = mesh(cylinder(0.04, 0.036, 0.09), clay, [0, 0, 0]);
  const coffee = mesh(cylinder(0.036, 0.036, 0.001), material(0x4a2f1d, 0.3), [0, 0.045, 0]);
  const mug = thing("mug", "Coffee mug", [0.1, TOP_M + 0.025 + 0.045, -0.05], cup, coffee, handle);

  const book = thing(
    "book",
    "Book",
    [0.1, TOP_M + 0.0125, -0.02],
    mesh(box(0.16, 0.019, 0.22), material(0xf1ecdf), [0.002, 0, 0]),
    mesh(box(0.166, 0.003, 0.226), material(0x8c2f39), [0, 0.011, 0]),
    mesh(box(0.166, 0.003, 0.226), material(0x8c2f39), [0, -0.011, 0]),
  );

  const arm = mesh(cylinder(0.008, 0.008, 0.36), steel, [0, 0.19, 0]);
  const shade = mesh(new THREE.ConeGeometry(0.09, 0.11, 32, 1, true), material(0x2f7d6b), [0, 0.39, 0]);
  shade.material.side = THREE.DoubleSide;
  const foot = mesh(cylinder(0.07, 0.075, 0.02), steel, [0, 0, 0]);
  const lamp = thing("lamp", "Desk lamp", [-0.56, TOP_M + 0.01, -0.2], foot, arm, shade);

  const lid = mesh(box(0.32, 0.21, 0.008), steel, [0, 0.105, -0.135]);
  lid.rotation.x = -0.28;
  lid.add(mesh(box(0.3, 0.19, 0.001), material(0x31506e, 0.3), [0, 0, 0.0045]));
  const keys = mesh(box(0.28, 0.002, 0.11), black, [0, 0.009, -0.035]);
  const base = mesh(box(0.32, 0.018, 0.22), steel, [0, 0, 0]);
  const laptop = thing("laptop", "Laptop", [-0.22, TOP_M + 0.009, -0.17], base, keys, lid);

  const desk = new THREE.Group();
  desk.name = "desk";
  desk.position.z = -0.55;
  desk.add(table, phone, shaver, mug, book, lamp, laptop);
  return { desk, movable: ["phone", "shaver", "mug", "book"], halfSize_m: [0.66, 0.31] };
}
