// The objects of the scene as meshes of three.js, in the colours of their materials or of the felt map.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  SRGBColorSpace,
  Vector3,
} from "three";
import { tablePlace } from "./felt_levels.js";
import { feltMaterial } from "./felt_material.js";
import { nearestPoints } from "./nearest_points.js";
import { float32Of, uint32Of } from "./report_document.js";
import { cutMaterial } from "./shell_cut.js";

/** Edges are drawn where faces meet at more than this angle [degrees], for meshes of at most so many faces. */
const EDGE_ANGLE = 30;
const MOST_EDGE_FACES = 30_000;
const SOURCE_GLOW = new Color(0xff7a1a);

/** A room in one piece is cut face by face; a wall that is a separate object is shown or hidden as a whole. */
const isCutByFace = (object) => object.is_shell && object.outward === null;

export function makeMeshes(report, felt, shellUniforms, table) {
  const group = new Group();
  const geometries = report.meshes.map((mesh) => {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(float32Of(mesh.vertices), 3));
    geometry.setIndex(new BufferAttribute(uint32Of(mesh.faces), 1));
    geometry.computeBoundingBox();
    geometry.computeBoundingSphere();
    return geometry;
  });
  const items = new Map();
  // Dark colours of a scale do not show shapes, so thin edges are drawn.
  const edges = new Map();
  const edgeMaterial = new LineBasicMaterial({ color: 0xffffff, transparent: true, opacity: 0.28 });
  const shellEdgeMaterial = new LineBasicMaterial({ color: 0xffffff, transparent: true, opacity: 0.12 });
  for (const object of report.objects) {
    const material = new MeshLambertMaterial({
      color: new Color().setRGB(...object.color, SRGBColorSpace),
      flatShading: true,
      // Meshes from files are often open, so that their back faces must be visible.
      side: DoubleSide,
    });
    if (object.is_source) material.emissive.copy(SOURCE_GLOW).multiplyScalar(0.25);
    if (isCutByFace(object)) cutMaterial(material, shellUniforms);
    const mesh = new Mesh(geometries[object.mesh], material);
    mesh.position.set(...object.position_m);
    mesh.quaternion.copy(new Quaternion(...object.rotation_xyzw));
    mesh.userData.id = object.id;
    mesh.updateMatrixWorld(true);
    const centre = mesh.geometry.boundingBox.getCenter(new Vector3()).applyMatrix4(mesh.matrixWorld);
    const surfaces = new Group();
    surfaces.add(mesh);
    group.add(surfaces);
    let outline = null;
    if (mesh.geometry.getIndex().count / 3 <= MOST_EDGE_FACES) {
      if (!edges.has(object.mesh)) edges.set(object.mesh, new EdgesGeometry(mesh.geometry, EDGE_ANGLE));
      outline = new LineSegments(edges.get(object.mesh), object.is_shell ? shellEdgeMaterial : edgeMaterial);
      outline.position.copy(mesh.position);
      outline.quaternion.copy(mesh.quaternion);
      group.add(outline);
    }
    const outward = object.outward && new Vector3(...object.outward);
    items.set(object.id, { object, mesh, surfaces, centre, outward, radius: mesh.geometry.boundingSphere.radius, felt: null, outline });
  }

  /** Meshes of the felt map of an object: its own mesh with a level at every vertex, and its patches in front of it. */
  function feltMeshes(item) {
    const { object, mesh, surfaces } = item;
    const patches = felt.byObject.get(object.id) ?? [];
    const points = patches.reduce((all, patch) => all + patch.count, 0);
    const made = { whole: null, nearest: null, patches: [] };
    const own = new BufferGeometry();
    const positions = mesh.geometry.getAttribute("position");
    own.setAttribute("position", positions);
    own.setIndex(mesh.geometry.getIndex());
    own.setAttribute("level", new BufferAttribute(new Float32Array(positions.count), 1));
    own.boundingSphere = mesh.geometry.boundingSphere;
    made.whole = new Mesh(own, feltMaterial(table, shellUniforms, { isShell: isCutByFace(object), isPatch: false }));
    made.whole.position.copy(mesh.position);
    made.whole.quaternion.copy(mesh.quaternion);
    surfaces.add(made.whole);
    if (points > 0) {
      const all = new Float32Array(points * 3);
      const places = new Uint32Array(points);
      let next = 0;
      for (const patch of patches) {
        all.set(patch.points, 3 * next);
        for (let i = 0; i < patch.count; i += 1) places[next + i] = patch.first + i;
        next += patch.count;
      }
      const world = new Float32Array(positions.count * 3);
      const vertex = new Vector3();
      for (let i = 0; i < positions.count; i += 1) {
        vertex.fromBufferAttribute(positions, i).applyMatrix4(mesh.matrixWorld).toArray(world, 3 * i);
      }
      made.nearest = nearestPoints(all, world).map((i) => places[i]);
    }
    for (const patch of patches) {
      if (patch.faces.length === 0) continue;
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(patch.points, 3));
      geometry.setIndex(new BufferAttribute(patch.faces, 1));
      geometry.setAttribute("level", new BufferAttribute(new Float32Array(patch.count), 1));
      const part = new Mesh(
        geometry,
        feltMaterial(table, shellUniforms, { isShell: isCutByFace(object), isPatch: true }),
      );
      made.patches.push({ patch, part });
      surfaces.add(part);
    }
    return made;
  }

  return {
    group,
    items,
    /** Show the felt map with codes (n_points,), or the objects' own colours if null. */
    colour(codes) {
      for (const material of [edgeMaterial, shellEdgeMaterial]) material.color.set(codes === null ? 0x000000 : 0xffffff);
      for (const item of items.values()) {
        if (codes !== null && item.felt === null) item.felt = feltMeshes(item);
        if (item.felt === null) continue;
        const { whole, nearest, patches } = item.felt;
        whole.visible = codes !== null;
        for (const { part } of patches) part.visible = codes !== null;
        if (codes === null) continue;
        const levels = whole.geometry.getAttribute("level");
        if (nearest !== null) for (let i = 0; i < levels.count; i += 1) levels.array[i] = tablePlace(codes[nearest[i]]);
        levels.needsUpdate = true;
        for (const { patch, part } of patches) {
          const attribute = part.geometry.getAttribute("level");
          for (let i = 0; i < patch.count; i += 1) attribute.array[i] = tablePlace(codes[patch.first + i]);
          attribute.needsUpdate = true;
        }
      }
      for (const { mesh } of items.values()) mesh.visible = codes === null;
    },
    /** Hide the walls for which a function of an item is true; their edges stay. */
    cutWalls(isHidden) {
      for (const item of items.values()) if (item.outward) item.surfaces.visible = !isHidden(item);
    },
    /** Show or hide all shells. */
    showShells(isShown, isFelt) {
      for (const item of items.values()) {
        if (!item.object.is_shell) continue;
        item.mesh.visible = isShown && !isFelt;
        if (item.outline) item.outline.visible = isShown;
        if (item.felt === null) continue;
        item.felt.whole.visible = isShown && isFelt;
        for (const { part } of item.felt.patches) part.visible = isShown && isFelt;
      }
    },
  };
}
