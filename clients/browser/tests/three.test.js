// Scene JSON from real three.js objects: `npm install`, or its folder in SCENE2HAP_NODE_MODULES.

import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";
import { pathToFileURL } from "node:url";
import { poseOf, sceneFromThree } from "../scene2hap_client.js";

const folder = process.env.SCENE2HAP_NODE_MODULES;
const from = folder ? pathToFileURL(join(folder, "three", "build", "three.module.js")).href : "three";
const THREE = await import(from).catch(() => null);
const options = { skip: THREE === null && "needs three.js: npm install in clients/browser" };
const look = () => new THREE.MeshBasicMaterial();

const close = (found, expected, tolerance = 1e-6) =>
  found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < tolerance, `${found} is not ${expected}`));

test("a turned and scaled box in turned and scaled groups", options, () => {
  const room = new THREE.Scene();
  room.name = "room";
  const outer = new THREE.Group();
  outer.position.set(1, 0, 0);
  outer.rotation.y = Math.PI / 2; // x becomes -z
  outer.scale.setScalar(2);
  const crate = new THREE.Mesh(new THREE.BoxGeometry(1, 2, 3), look());
  crate.name = "crate";
  crate.position.set(0.5, 1, 0);
  crate.scale.set(1, 0.5, 0.1);
  room.add(outer);
  outer.add(crate);

  const { scene, nodes } = sceneFromThree(room);
  assert.deepEqual(
    scene.objects.map(({ id }) => id),
    ["crate"],
  );
  const [found] = scene.objects;
  close(found.pose.position_m, [1, 2, -1]); // 1 + 2 * (0, 1, -0.5)
  close(found.pose.rotation_xyzw, [0, Math.SQRT1_2, 0, Math.SQRT1_2]);
  assert.equal(found.geometry.kind, "box");
  close(found.geometry.size_m, [2, 2, 0.6]);

  crate.position.y = 2; // matrices are brought up to date by poseOf
  close(poseOf(nodes.get("crate")), [1, 4, -1, 0, Math.SQRT1_2, 0, Math.SQRT1_2]);
});

test("names of materials are written, that of the largest area first", options, () => {
  const named = (name) => Object.assign(look(), { name });
  const sides = ["Brass", "Brass", "Walnut", "Walnut", "", "Brass"].map(named); // +x, -x, +y, -y, +z, -z
  const table = new THREE.Mesh(new THREE.BoxGeometry(2, 0.1, 1), sides);
  table.name = "table";
  const plain = new THREE.Mesh(new THREE.BoxGeometry(1, 1, 1), look());
  plain.name = "plain";
  const room = new THREE.Scene().add(table, plain);
  const found = sceneFromThree(room).scene.objects.map((one) => one.material_names);
  assert.deepEqual(found, [["Walnut", "Brass"], undefined]);
});

test("poses are those of getWorldPosition and getWorldQuaternion", options, () => {
  const parent = new THREE.Group();
  const child = new THREE.Mesh(new THREE.SphereGeometry(1, 8, 6), look());
  parent.add(child);
  parent.rotation.set(0.3, -1.2, 2.5);
  parent.scale.setScalar(0.01);
  child.position.set(3, 4, 5);
  for (const scale of [
    [1, 1, 1],
    [1, 2, 3],
    [-1, 1, 1],
    [1, -2, 1],
    [1, 1, -1],
  ]) {
    child.rotation.set(-2, 0.4, 3);
    child.scale.set(...scale);
    const expected = child.getWorldPosition(new THREE.Vector3()).toArray();
    const turned = child.getWorldQuaternion(new THREE.Quaternion());
    const found = poseOf(child);
    close(found.slice(0, 3), expected);
    const likeness = Math.abs(turned.dot(new THREE.Quaternion(...found.slice(3))));
    assert.ok(likeness > 1 - 1e-9, `scale ${scale}`);
  }
});

test("a marked group is one object; its vertices come back to where three.js has them", options, () => {
  const lamp = new THREE.Group();
  lamp.name = "lamp";
  lamp.userData.scene2hap = { name: "Desk lamp" };
  lamp.position.set(0, 0.75, 0);
  lamp.rotation.z = 0.5;
  lamp.scale.set(-1, 1.5, 1);
  const shade = new THREE.Mesh(new THREE.ConeGeometry(0.1, 0.2, 6), look());
  shade.position.y = 0.4;
  shade.rotation.x = 0.3; // sheared, since the group is scaled unevenly
  lamp.add(new THREE.Mesh(new THREE.CylinderGeometry(0.07, 0.08, 0.02, 6), look()), shade);
  const root = new THREE.Scene();
  root.add(lamp);

  const { scene } = sceneFromThree(root);
  assert.deepEqual(
    scene.objects.map(({ id, name }) => [id, name]),
    [["lamp", "Desk lamp"]],
  );
  const [{ pose, geometry }] = scene.objects;
  const back = new THREE.Matrix4().compose(
    new THREE.Vector3(...pose.position_m),
    new THREE.Quaternion(...pose.rotation_xyzw),
    new THREE.Vector3(1, 1, 1),
  );
  const box = new THREE.Box3().setFromPoints(
    geometry.vertices_m.map((v) => new THREE.Vector3(...v).applyMatrix4(back)),
  );
  const expected = new THREE.Box3().setFromObject(lamp, true);
  close(box.min.toArray(), expected.min.toArray(), 2e-6);
  close(box.max.toArray(), expected.max.toArray(), 2e-6);
  // The tip and the ring of the cone, both rings of the cylinder and the middles of its ends and of the cone's base.
  assert.equal(geometry.vertices_m.length, 1 + 6 + 1 + 2 * 6 + 2);
  // Mirrored, and its outside outside.
  const volume = geometry.faces.reduce((sum, face) => {
    const [a, b, c] = face.map((i) => new THREE.Vector3(...geometry.vertices_m[i]));
    return sum + a.dot(b.cross(c)) / 6;
  }, 0);
  const hexagon = (r) => ((3 * Math.sqrt(3)) / 2) * r * r;
  const frustum = (0.02 / 3) * (hexagon(0.07) + hexagon(0.08) + Math.sqrt(hexagon(0.07) * hexagon(0.08)));
  close([volume], [1.5 * (frustum + (0.2 / 3) * hexagon(0.1))]);
});

test("deformed meshes are written as they are now", options, () => {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  const raised = geometry.attributes.position.clone();
  for (let i = 0; i < raised.count; i += 1) raised.setY(i, raised.getY(i) * 3);
  geometry.morphAttributes.position = [raised];
  const door = new THREE.Mesh(geometry, look());
  door.morphTargetInfluences = [1];
  const { scene } = sceneFromThree(door);
  assert.deepEqual(scene.objects[0].geometry, { kind: "box", size_m: [1, 3, 1] });
});

test("skinned meshes are written where their bones have them", options, () => {
  const geometry = new THREE.BoxGeometry(1, 1, 1);
  const n = geometry.attributes.position.count;
  geometry.setAttribute("skinIndex", new THREE.Uint16BufferAttribute(new Array(4 * n).fill(0), 4));
  geometry.setAttribute(
    "skinWeight",
    new THREE.Float32BufferAttribute(Array.from({ length: n }, () => [1, 0, 0, 0]).flat(), 4),
  );
  const arm = new THREE.SkinnedMesh(geometry, look());
  const bone = new THREE.Bone();
  arm.add(bone);
  arm.bind(new THREE.Skeleton([bone]));
  bone.position.y = 1;
  const [{ pose, geometry: found }] = sceneFromThree(arm).scene.objects;
  assert.deepEqual(pose.position_m, [0, 0, 0]);
  assert.deepEqual(found.vertices_m.map((v) => v[1]).sort(), [0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5]);
});

test("lines, sprites and lights are no objects", options, () => {
  const root = new THREE.Scene();
  root.add(new THREE.Line(new THREE.BufferGeometry()), new THREE.Sprite(), new THREE.PointLight(), new THREE.Camera());
  assert.deepEqual(sceneFromThree(root).scene.objects, []);
});
