// The scene in 3D: camera, light, selection, picking. A frame is drawn only when something has changed.

import {
  AmbientLight,
  Box3,
  Color,
  DirectionalLight,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Sprite,
  SpriteMaterial,
  CanvasTexture,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { makeContactLines } from "./contact_lines.js";
import { tableTexture } from "./felt_material.js";
import { makeLabels } from "./labels.js";
import { makeMeshes } from "./meshes.js";
import { isCut } from "./shell_cut.js";
import { themeColour } from "./theme.js";

const CLICK_PX = 5;
const TURN_RAD = 0.12;

/** Make the view; null if the browser has no WebGL. */
export function makeSceneView({ canvas, layer, report, felt, store, onHover, onFirstFrame }) {
  const context = canvas.getContext("webgl2", { antialias: true, alpha: false });
  if (!context) return null;
  const renderer = new WebGLRenderer({ canvas, context, antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio || 1, 2));
  const scene = new Scene();
  const camera = new PerspectiveCamera(45, 1, 0.01, 1000);
  if (report.up_axis === "z") camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.zoomToCursor = true;

  const shellUniforms = { shellCentre: { value: new Vector3() }, shellCut: { value: 1 } };
  const table = { value: tableTexture(store.get("scale")) };
  const meshes = makeMeshes(report, felt, shellUniforms, table);
  const items = meshes.items;
  const bounds = boundsOf(items);
  bounds.getCenter(shellUniforms.shellCentre.value);
  const radius = Math.max(bounds.getSize(new Vector3()).length() / 2, 0.05);
  const lines = makeContactLines(report, items, radius);
  const halos = makeHalos(items);
  const labels = makeLabels(layer, report, (id) => store.set("selected", id));
  const light = new DirectionalLight(0xffffff, 1.6);
  scene.add(meshes.group, lines.group, halos.group, light, light.target, new AmbientLight(0xffffff, 1.2));

  const raycaster = new Raycaster();
  const targets = [...items.values()].map((item) => item.mesh);
  let outline = null;
  let isRequested = false;
  let isFirst = true;

  const requestDraw = () => {
    if (isRequested) return;
    isRequested = true;
    requestAnimationFrame(draw);
  };

  function draw() {
    isRequested = false;
    resize();
    light.position.copy(camera.position);
    light.target.position.copy(controls.target);
    meshes.cutWalls(isHiddenWall);
    renderer.render(scene, camera);
    placeLabels();
    if (isFirst) {
      isFirst = false;
      onFirstFrame();
    }
  }

  function resize() {
    const { clientWidth: width, clientHeight: height } = canvas.parentElement;
    const size = renderer.getSize(new Vector2());
    if (size.x === width && size.y === height) return;
    renderer.setSize(width, height, false);
    camera.aspect = width / Math.max(height, 1);
    camera.updateProjectionMatrix();
  }

  /** Pixels of a point in the canvas, and whether it is in front of the camera. */
  function onCanvas(point) {
    const place = point.clone().project(camera);
    const { clientWidth: width, clientHeight: height } = canvas;
    return { x: ((place.x + 1) / 2) * width, y: ((1 - place.y) / 2) * height, isSeen: Math.abs(place.z) <= 1 };
  }

  function placeLabels() {
    const selected = store.get("selected");
    const wanted = [];
    for (const item of items.values()) {
      const isSelected = item.object.id === selected;
      if (!isSelected && !(item.object.is_source && store.get("names"))) continue;
      const { x, y, isSeen } = onCanvas(item.centre);
      if (!isSeen || x < 0 || y < 0 || x > canvas.clientWidth || y > canvas.clientHeight) continue;
      const distance = item.centre.distanceTo(camera.position);
      wanted.push({ id: item.object.id, x, y, isSelected, isSource: item.object.is_source, distance });
    }
    wanted.sort((a, b) => b.isSelected - a.isSelected || a.distance - b.distance);
    labels.place(wanted, canvas.clientWidth);
  }

  /** Whether a wall that is a separate object lies between the camera and the room. */
  function isHiddenWall({ centre, outward }) {
    return store.get("walls") === "cut" && isCut(centre, outward, shellUniforms.shellCentre.value, camera.position);
  }

  /** The visible object at a place of the viewport [px]: {id, point}, or null. */
  function hit(x, y) {
    const box = canvas.getBoundingClientRect();
    if (x < box.left || x > box.right || y < box.top || y > box.bottom) return null;
    const place = new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2);
    camera.updateMatrixWorld();
    raycaster.setFromCamera(place, camera);
    for (const found of raycaster.intersectObjects(targets, false)) {
      const item = items.get(found.object.userData.id);
      const { object } = item;
      if (object.is_shell) {
        if (store.get("walls") === "none") continue;
        if (item.outward) {
          if (isHiddenWall(item)) continue;
          return { id: object.id, point: found.point };
        }
        const normal = found.face.normal.clone().applyQuaternion(found.object.quaternion);
        const isOpen = store.get("walls") === "cut";
        if (isOpen && isCut(found.point, normal, shellUniforms.shellCentre.value, camera.position)) continue;
      }
      return { id: object.id, point: found.point };
    }
    return null;
  }

  function lookAt(centre, distance, direction) {
    controls.target.copy(centre);
    camera.position.copy(centre).addScaledVector(direction.normalize(), distance);
    camera.near = Math.min(radius, distance) / 200;
    camera.far = distance + radius * 20;
    camera.updateProjectionMatrix();
    controls.update();
    camera.updateMatrixWorld();
    requestDraw();
  }

  /** Least distance [m] from which all corners of a box are in the picture, seen from a direction. */
  function distanceForBox(box, direction) {
    const centre = box.getCenter(new Vector3());
    camera.position.copy(centre).add(direction);
    camera.lookAt(centre);
    camera.updateMatrixWorld();
    const turn = camera.quaternion.clone().invert();
    const tall = Math.tan((camera.fov * Math.PI) / 360);
    let least = 0;
    for (let i = 0; i < 8; i += 1) {
      const corner = new Vector3(
        i & 1 ? box.max.x : box.min.x,
        i & 2 ? box.max.y : box.min.y,
        i & 4 ? box.max.z : box.min.z,
      );
      corner.sub(centre).applyQuaternion(turn);
      least = Math.max(
        least,
        corner.z + Math.abs(corner.y) / tall,
        corner.z + Math.abs(corner.x) / (tall * camera.aspect),
      );
    }
    return least;
  }

  const distanceFor = (size) => {
    const half = (camera.fov * Math.PI) / 360;
    return size / Math.sin(Math.min(half, Math.atan(Math.tan(half) * Math.min(camera.aspect, 1.3))));
  };

  function frameAll() {
    resize();
    const direction = report.up_axis === "z" ? new Vector3(0.75, -1, 0.75) : new Vector3(0.75, 0.75, 1);
    lookAt(bounds.getCenter(new Vector3()), distanceForBox(bounds, direction) * 1.04, direction);
  }

  function focus(id) {
    const item = items.get(id);
    if (!item) return frameAll();
    const away = camera.position.clone().sub(controls.target);
    return lookAt(item.centre, distanceFor(Math.max(item.radius, radius / 40)) * 1.7, away);
  }

  function showSelection(id) {
    if (outline) {
      scene.remove(outline);
      outline.geometry.dispose();
      outline.material.dispose();
      outline = null;
    }
    const item = items.get(id);
    if (item) {
      const material = new LineBasicMaterial({ color: themeColour("--select"), depthTest: false, transparent: true });
      outline = new LineSegments(new EdgesGeometry(item.mesh.geometry, 30), material);
      outline.position.copy(item.mesh.position);
      outline.quaternion.copy(item.mesh.quaternion);
      outline.renderOrder = 4;
      scene.add(outline);
    }
    requestDraw();
  }

  function showSurfaces() {
    const isFelt = store.get("show") === "felt";
    meshes.colour(isFelt ? felt.codes(store.get("choice")) : null);
    shellUniforms.shellCut.value = store.get("walls") === "cut" ? 1 : 0;
    meshes.showShells(store.get("walls") !== "none", isFelt);
    halos.material.opacity = isFelt ? 0.35 : 0.75;
    requestDraw();
  }

  function showTheme() {
    scene.background = new Color(themeColour("--scene"));
    lines.setColour(themeColour("--contact"));
    showSelection(store.get("selected"));
  }

  listen();
  showSurfaces();
  lines.group.visible = store.get("contacts");
  frameAll();

  function listen() {
    controls.addEventListener("change", requestDraw);
    new ResizeObserver(requestDraw).observe(canvas.parentElement);
    canvas.addEventListener("webglcontextrestored", requestDraw);
    store.on("selected", showSelection);
    store.on("choice", showSurfaces);
    store.on("show", showSurfaces);
    store.on("walls", showSurfaces);
    store.on("names", requestDraw);
    store.on("contacts", (isShown) => {
      lines.group.visible = isShown;
      requestDraw();
    });
    store.on("scale", (scale) => {
      table.value.dispose();
      table.value = tableTexture(scale);
      requestDraw();
    });
    let down = null;
    let last = null;
    canvas.addEventListener("pointerdown", (event) => {
      down = [event.clientX, event.clientY];
      if (event.pointerType === "touch") onHover(null, 0, 0);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) <= CLICK_PX) {
        const found = hit(event.clientX, event.clientY);
        store.set("selected", found?.id ?? null);
        if (event.pointerType !== "mouse") {
          last = null; // an earlier move would otherwise hide the tooltip
          onHover(found, event.clientX, event.clientY);
        }
      }
      down = null;
    });
    canvas.addEventListener("dblclick", () => focus(store.get("selected")));
    canvas.addEventListener("pointermove", (event) => {
      const isNew = last === null;
      last = event;
      if (isNew) {
        requestAnimationFrame(() => {
          if (last) onHover(last.buttons ? null : hit(last.clientX, last.clientY), last.clientX, last.clientY);
          last = null;
        });
      }
    });
    canvas.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "touch") return; // a lifted finger leaves too, and the tooltip is shown just then
      last = null;
      onHover(null, 0, 0);
    });
    canvas.addEventListener("keydown", (event) => {
      const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      const zoom = { "+": 0.85, "=": 0.85, "-": 1 / 0.85 }[event.key];
      if (!turns && !zoom) return;
      event.preventDefault();
      const away = camera.position.clone().sub(controls.target);
      if (zoom) away.multiplyScalar(zoom);
      if (turns) {
        away.applyAxisAngle(camera.up, turns[0] * TURN_RAD);
        const side = new Vector3().crossVectors(camera.up, away).normalize();
        const turned = away.clone().applyAxisAngle(side, turns[1] * TURN_RAD);
        // Not over the poles, where left and right would be exchanged.
        if (Math.abs(turned.clone().normalize().dot(camera.up)) < 0.995) away.copy(turned);
      }
      camera.position.copy(controls.target).add(away);
      controls.update();
      requestDraw();
    });
  }

  return {
    focus,
    frameAll,
    showTheme,
    draw,
    pick: (x, y) => hit(x, y)?.id ?? null,
    /** Middle of an object's box in pixels of the viewport; null for an unknown id. */
    project(id) {
      const item = items.get(id);
      if (!item) return null;
      camera.updateMatrixWorld();
      const { x, y } = onCanvas(item.centre);
      const box = canvas.getBoundingClientRect();
      return [box.left + x, box.top + y];
    },
  };
}

/** Bounds of the sources and of the objects inside the shells; of the shells if there are no other objects. */
function boundsOf(items) {
  const bounds = new Box3();
  const all = [...items.values()];
  const inside = all.filter(({ object }) => !object.is_shell || object.is_source);
  for (const item of inside.length > 0 ? inside : all) {
    bounds.union(item.mesh.geometry.boundingBox.clone().applyMatrix4(item.mesh.matrixWorld));
  }
  if (bounds.isEmpty()) bounds.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  return bounds;
}

/** A soft disc of light around each source, also visible through walls. */
function makeHalos(items) {
  const picture = document.createElement("canvas");
  picture.width = picture.height = 64;
  const pen = picture.getContext("2d");
  const gradient = pen.createRadialGradient(32, 32, 0, 32, 32, 32);
  gradient.addColorStop(0, "rgba(255, 150, 40, 0.9)");
  gradient.addColorStop(0.35, "rgba(255, 130, 20, 0.4)");
  gradient.addColorStop(1, "rgba(255, 120, 0, 0)");
  pen.fillStyle = gradient;
  pen.fillRect(0, 0, 64, 64);
  const texture = new CanvasTexture(picture);
  const material = new SpriteMaterial({ map: texture, depthTest: false, depthWrite: false, opacity: 0.7 });
  const group = new Group();
  for (const item of items.values()) {
    if (!item.object.is_source) continue;
    const halo = new Sprite(material);
    halo.position.copy(item.centre);
    halo.scale.setScalar(Math.max(item.radius * 1.4, 0.12));
    halo.renderOrder = 2;
    group.add(halo);
  }
  return { group, material };
}
