// Levels of the felt map: two bytes for each point of all patches, by model, source and band.

import { float32Of, uint16Of, uint32Of } from "./report_document.js";

/** Code of levels at the lower end of the scale and below it. */
export const LOWEST_CODE = 1;
const LAST_CODE = 65535;
const own = (object, key) => (object && Object.hasOwn(object, key) ? object[key] : undefined);

/** The felt map of a document: its patches with their points, and levels by choice. */
export function feltLevels(felt) {
  const patches = [];
  let first = 0;
  for (const patch of felt.patches) {
    patches.push({
      object: patch.object,
      first,
      count: patch.n_points,
      points: float32Of(patch.points_m),
      faces: uint32Of(patch.faces),
    });
    first += patch.n_points;
  }
  const byObject = new Map();
  for (const patch of patches) byObject.set(patch.object, [...(byObject.get(patch.object) ?? []), patch]);
  const decoded = new Map();
  const decodedPaths = new Map();
  const silence = new Uint16Array(first);

  return {
    patches,
    byObject,
    /** Codes (n_points,) of a choice; zeros where the document has none. */
    codes({ model, source, band }) {
      const key = JSON.stringify([model, source, band]);
      if (!decoded.has(key)) {
        const text = own(own(own(felt.levels, model), source), band);
        decoded.set(key, text === undefined ? silence : uint16Of(text));
      }
      return decoded.get(key);
    },
    /** Level over the threshold of touch [dB] of a code; null if no vibration arrives. */
    level: (code) => (code === 0 ? null : ((code - 1) / (LAST_CODE - 1)) * (felt.high_db - felt.low_db) + felt.low_db),
    /** Index of an object's point that is nearest to a position [m] in the world; -1 if it has no points. */
    nearest(id, [x, y, z]) {
      let best = -1;
      let least = Infinity;
      for (const patch of byObject.get(id) ?? []) {
        for (let i = 0; i < patch.count; i += 1) {
          const dx = patch.points[3 * i] - x;
          const dy = patch.points[3 * i + 1] - y;
          const dz = patch.points[3 * i + 2] - z;
          const squared = dx * dx + dy * dy + dz * dz;
          if (squared < least) {
            least = squared;
            best = patch.first + i;
          }
        }
      }
      return best;
    },
    /** Highest level [dB] on an object; null if no vibration arrives. */
    highest(id, choice) {
      return this.level(this.codes(choice)[this.loudest(id, choice)] ?? 0);
    },
    /** Index of the point of an object with the highest level; -1 if it has no points. */
    loudest(id, choice) {
      const codes = this.codes(choice);
      let best = -1;
      for (const patch of byObject.get(id) ?? []) {
        for (let i = patch.first; i < patch.first + patch.count; i += 1) if (best < 0 || codes[i] > codes[best]) best = i;
      }
      return best;
    },
    /** Sources whose vibration arrives at a point, for a choice, the strongest first: [{source, code, path}]. */
    arriving(index, choice) {
      const [all, ...sources] = felt.sources;
      return (choice.source === all ? sources : [choice.source])
        .map((source) => ({ source, code: this.codes({ ...choice, source })[index] ?? 0 }))
        .filter(({ code }) => code > 0)
        .sort((a, b) => b.code - a.code)
        .map((one) => ({ ...one, path: this.path(choice.model, one.source, index) }));
    },
    /** Objects on the path from a source to a point; null if the model has no single path. */
    path(model, source, index) {
      const key = JSON.stringify([model, source]);
      if (!decodedPaths.has(key)) {
        const found = own(own(felt.paths, model), source);
        decodedPaths.set(key, found ? { objects: found.objects, ofPoints: uint16Of(found.of_points) } : null);
      }
      const paths = decodedPaths.get(key);
      return paths?.objects[paths.ofPoints[index] - 1] ?? null;
    },
  };
}

/** Place of a code in a table of 256 colours: 0 for nothing, 1 to 255 along the scale. */
export const tablePlace = (code) => (code === 0 ? 0 : 1 + ((code - 1) / (LAST_CODE - 1)) * 254);

/** A level as text. The ends of the scale stand for all levels beyond them. */
export function shownLevel(level, felt) {
  if (level === null) return "nothing arrives";
  if (level >= felt.high_db) return `${felt.high_db} dB or more`;
  if (level <= felt.low_db) return `${felt.low_db} dB or less`;
  return `${level.toFixed(1)} dB`;
}
