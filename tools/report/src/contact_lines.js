// Contacts as lines from the middle of an object over the contact point to the other object; wider if more passes.

import { Color, Group } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

/** Classes of contacts: least transmission [dB], and width [px] and opacity of their lines. */
export const CLASSES = [
  { least_db: -6, width: 4, opacity: 0.9, label: "-6 dB or more" },
  { least_db: -20, width: 2.5, opacity: 0.75, label: "-20 to -6 dB" },
  { least_db: -Infinity, width: 1.5, opacity: 0.6, label: "less than -20 dB" },
  { least_db: null, width: 1, opacity: 0.35, label: "nothing passes" },
];

export function classOf(passes_db) {
  if (passes_db === null || passes_db === undefined) return CLASSES[3];
  return CLASSES.find(({ least_db }) => passes_db >= least_db);
}

/** Objects larger than this fraction of the scene's radius get no line to their middle, where all lines would meet. */
const LARGE_SHARE = 0.3;

/** Of each pair of objects, the contact that passes most. */
function strongestOfPairs(contacts) {
  const found = new Map();
  for (const contact of contacts) {
    const key = JSON.stringify([contact.a, contact.b].sort());
    const earlier = found.get(key);
    if (!earlier || (contact.passes_db ?? -Infinity) > (earlier.passes_db ?? -Infinity)) found.set(key, contact);
  }
  return [...found.values()];
}

export function makeContactLines(report, items, sceneRadius) {
  const contacts = strongestOfPairs(report.contacts);
  const isLarge = (item) => item.object.is_shell || item.radius > LARGE_SHARE * sceneRadius;
  const group = new Group();
  const materials = [];
  for (const kind of CLASSES) {
    const positions = [];
    for (const contact of contacts) {
      const [a, b] = [items.get(contact.a), items.get(contact.b)];
      if (classOf(contact.passes_db) !== kind || !a || !b) continue;
      const areBoth = isLarge(a) && isLarge(b);
      const isFromA = areBoth ? a.radius <= b.radius : !isLarge(a);
      const isToB = areBoth ? !isFromA : !isLarge(b);
      if (isFromA) positions.push(...a.centre.toArray(), ...contact.point_m);
      if (isToB) positions.push(...contact.point_m, ...b.centre.toArray());
    }
    if (positions.length === 0) continue;
    const geometry = new LineSegmentsGeometry().setPositions(positions);
    const material = new LineMaterial({
      linewidth: kind.width,
      opacity: kind.opacity,
      transparent: true,
      depthTest: false,
    });
    materials.push(material);
    const lines = new LineSegments2(geometry, material);
    lines.renderOrder = 3;
    group.add(lines);
  }
  return {
    group,
    setColour(text) {
      for (const material of materials) material.color = new Color(text);
    },
  };
}
