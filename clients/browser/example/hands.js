// Hands: the pointer and the arrow keys move one of them, controllers both. A hand stays on an object that moves.

import * as THREE from "three";
import { poseOf } from "../scene2hap_client.js";

const REACH_M = 0.04; // of a controller
const STEP_M = 0.02; // of an arrow key
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const DOWN = new THREE.Vector3(0, -1, 0);

/**
 * Make both hands.
 *
 * @param {ReturnType<typeof import("./stage.js").makeStage>} stage
 * @param {Map<string, THREE.Object3D>} nodes by id
 * @param {{movable: string[], halfSize_m: number[], onDrag?: (id: string) => void}} table
 */
export function makeHands(stage, nodes, { movable, halfSize_m, onDrag = () => {} }) {
  const ray = new THREE.Raycaster();
  const targets = [...nodes.values()];
  const idOf = new Map([...nodes].map(([id, node]) => [node, id]));
  const hands = new Map(["left", "right"].map((name) => [name, makeHand(stage, name)]));
  let active = "right";
  let dragged = null; // {node, plane, offset}

  /** The object that a ray hits first. */
  function hit(origin, direction) {
    ray.set(origin, direction);
    const [found] = ray.intersectObjects(targets, true);
    if (!found) return null;
    let node = found.object;
    while (!idOf.has(node)) node = node.parent;
    return { id: idOf.get(node), node, point: found.point };
  }

  function rayOf(event) {
    const { left, top, width, height } = stage.canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    ray.setFromCamera(at, stage.camera);
    return [ray.ray.origin.clone(), ray.ray.direction.clone()];
  }

  /** Lay a hand on what is below a place of the desk. */
  function placeFromAbove(name, x, z) {
    hands.get(name).put(hit(new THREE.Vector3(x, 2, z), DOWN));
  }

  function moveTo(node, world) {
    const local = node.parent.worldToLocal(world);
    node.position.x = THREE.MathUtils.clamp(local.x, -halfSize_m[0], halfSize_m[0]);
    node.position.z = THREE.MathUtils.clamp(local.z, -halfSize_m[1], halfSize_m[1]);
  }

  // Captured before OrbitControls gets it: a drag that begins on an object is none of the camera.
  stage.canvas.addEventListener(
    "pointerdown",
    (event) => {
      const found = hit(...rayOf(event));
      if (!found) return;
      hands.get(active).put(found);
      stage.controls.enabled = !movable.includes(found.id);
      if (stage.controls.enabled) return;
      stage.canvas.setPointerCapture(event.pointerId);
      const plane = new THREE.Plane(new THREE.Vector3(0, 1, 0), -found.point.y);
      dragged = { node: found.node, plane, offset: found.node.getWorldPosition(new THREE.Vector3()).sub(found.point) };
      onDrag(found.id);
    },
    { capture: true },
  );
  stage.canvas.addEventListener("pointermove", (event) => {
    const [origin, direction] = rayOf(event);
    if (dragged) {
      const point = ray.ray.intersectPlane(dragged.plane, new THREE.Vector3());
      if (point) moveTo(dragged.node, point.add(dragged.offset));
    } else if (event.buttons === 0 || event.pointerType === "touch") {
      hands.get(active).put(hit(origin, direction));
    }
  });
  const release = () => {
    dragged = null;
    stage.controls.enabled = true;
  };
  stage.canvas.addEventListener("pointerup", release);
  stage.canvas.addEventListener("pointercancel", release);
  stage.canvas.addEventListener("keydown", (event) => {
    const step = ARROWS[event.key];
    if (!step) return;
    event.preventDefault();
    const { x, z } = hands.get(active).point ?? new THREE.Vector3(0, 0, -0.55);
    placeFromAbove(active, x + STEP_M * step[0], z + STEP_M * step[1]);
  });

  const controllers = [0, 1].map((i) => {
    const controller = stage.renderer.xr.getController(i);
    controller.addEventListener("connected", ({ data }) => (controller.userData.hand = data.handedness));
    controller.addEventListener("disconnected", () => (controller.userData.hand = null));
    controller.addEventListener("selectstart", () => {
      const touched = hands.get(controller.userData.hand);
      if (touched && movable.includes(touched.id)) controller.userData.held = nodes.get(touched.id);
    });
    controller.addEventListener("selectend", () => (controller.userData.held = null));
    stage.scene.add(controller);
    return controller;
  });

  /** Hands of controllers touch the nearest surface within reach. */
  function followControllers() {
    for (const controller of controllers) {
      const hand = hands.get(controller.userData.hand);
      if (!hand || !stage.renderer.xr.isPresenting) continue;
      const place = controller.getWorldPosition(new THREE.Vector3());
      if (controller.userData.held) moveTo(controller.userData.held, place.clone());
      hand.put(nearest(place, nodes), place);
    }
  }

  return {
    placeFromAbove,
    use: (name) => (active = name),
    touchedBy: (name) => hands.get(name)?.id ?? null,
    pointOf: (name) => hands.get(name)?.point ?? null,
    /** Tell a client what both hands touch now. */
    tell(client) {
      followControllers();
      for (const [name, hand] of hands) {
        const point = hand.follow();
        if (point) client.touch(name, hand.id, point.toArray());
        else client.lift(name);
      }
    },
  };
}

function makeHand(stage, name) {
  const look = new THREE.MeshStandardMaterial({ color: name === "left" ? 0x2f8fdd : 0xe07a1f, roughness: 0.4 });
  // A finger whose tip is at the marker's origin.
  const finger = new THREE.Mesh(new THREE.CapsuleGeometry(0.011, 0.07, 8, 24), look);
  finger.position.y = 0.046;
  finger.castShadow = true;
  const marker = new THREE.Group();
  marker.add(finger);
  marker.rotation.set(0.5, 0, name === "left" ? 0.2 : -0.2);
  marker.visible = false;
  stage.scene.add(marker);
  let node = null;
  const local = new THREE.Vector3();
  const hand = {
    id: null,
    point: null,
    /** Touch what was hit, null for nothing. `place` is where the hand is while it touches nothing. */
    put(found, place = null) {
      node = found?.node ?? null;
      hand.id = found?.id ?? null;
      hand.point = found?.point.clone() ?? null;
      if (found) node.worldToLocal(local.copy(found.point));
      const shown = found?.point ?? place;
      marker.visible = shown !== null;
      if (shown) marker.position.copy(shown);
    },
    /** The point of touch, which moves with its object; null if there is none. */
    follow() {
      if (!node) return null;
      hand.point = node.localToWorld(local.clone());
      marker.position.copy(hand.point);
      return hand.point;
    },
  };
  return hand;
}

/** The nearest point within reach on the boxes around the meshes of all objects. */
function nearest(place, nodes) {
  let found = null;
  let least_m = REACH_M;
  for (const [id, node] of nodes) {
    node.traverse((mesh) => {
      if (!mesh.isMesh) return;
      if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
      const local = mesh.worldToLocal(place.clone());
      const point = mesh.localToWorld(mesh.geometry.boundingBox.clampPoint(local, new THREE.Vector3()));
      const distance_m = point.distanceTo(place);
      if (distance_m < least_m) {
        least_m = distance_m;
        found = { id, node, point };
      }
    });
  }
  return found;
}

/** Tell a client where all that moves is. */
export function tellPoses(client, nodes) {
  const { objects, n_moving } = client.order ?? { objects: [], n_moving: 0 };
  for (const id of objects.slice(0, n_moving)) client.setPose(id, poseOf(nodes.get(id)));
}
