// Renderer, camera, lights and theme: nothing of it is about haptics.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const FIELD_DEGREES = 42;
const WIDTH_DEGREES = 54;
const { RAD2DEG } = THREE.MathUtils;

/** Make a stage in a canvas. `run(onFrame)` calls back for each frame, in VR too. */
export function makeStage(canvas, { hasShadows = true } = {}) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.shadowMap.enabled = hasShadows;
  renderer.xr.enabled = true;

  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(FIELD_DEGREES, 1, 0.02, 20);
  const controls = new OrbitControls(camera, canvas);
  controls.enableDamping = false;
  controls.maxPolarAngle = 1.5;

  scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 2));
  const sun = new THREE.DirectionalLight(0xffffff, 2.2);
  sun.position.set(0.8, 2.6, 0.9);
  sun.castShadow = hasShadows;
  sun.shadow.mapSize.set(2048, 2048);
  Object.assign(sun.shadow.camera, { left: -1.5, right: 1.5, top: 1.5, bottom: -1.5, near: 0.5, far: 5 });
  sun.shadow.bias = -0.0005;
  scene.add(sun);

  const floor = new THREE.Mesh(new THREE.CircleGeometry(3, 64), new THREE.MeshStandardMaterial({ roughness: 1 }));
  floor.rotation.x = -Math.PI / 2;
  floor.receiveShadow = hasShadows;
  scene.add(floor);

  const dark = matchMedia("(prefers-color-scheme: dark)");
  const applyTheme = () => {
    const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    scene.background = new THREE.Color(colour("--scene"));
    floor.material.color.set(colour("--floor"));
  };
  dark.addEventListener("change", applyTheme);
  applyTheme();

  function fit() {
    const { clientWidth, clientHeight } = canvas.parentElement;
    renderer.setSize(clientWidth, clientHeight, false);
    camera.aspect = clientWidth / Math.max(clientHeight, 1);
    // At least so wide that the whole desk is in the picture of a phone.
    camera.fov = Math.max(
      FIELD_DEGREES,
      2 * RAD2DEG * Math.atan(Math.tan(WIDTH_DEGREES / 2 / RAD2DEG) / camera.aspect),
    );
    camera.updateProjectionMatrix();
  }
  new ResizeObserver(fit).observe(canvas.parentElement);
  fit();

  return {
    THREE,
    canvas,
    renderer,
    scene,
    camera,
    controls,
    lookAt(from, to) {
      camera.position.set(...from);
      controls.target.set(...to);
      controls.update();
    },
    run(onFrame, { drawEvery_ms = 0 } = {}) {
      let drawn_ms = -Infinity;
      renderer.setAnimationLoop((now_ms) => {
        onFrame();
        if (now_ms - drawn_ms < drawEvery_ms) return;
        drawn_ms = now_ms;
        renderer.render(scene, camera);
      });
    },
  };
}

/** Show a button that enters VR, where the browser has it. Calls `onSession` with the session, or null at its end. */
export async function offerVr(button, renderer, onSession) {
  const isSupported = await navigator.xr?.isSessionSupported("immersive-vr").catch(() => false);
  if (!isSupported) return;
  button.hidden = false;
  button.addEventListener("click", async () => {
    const session = await navigator.xr.requestSession("immersive-vr", { optionalFeatures: ["local-floor"] });
    session.addEventListener("end", () => onSession(null));
    await renderer.xr.setSession(session);
    onSession(session);
  });
}
