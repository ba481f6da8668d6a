// Nearest point of a patch for many vertices, by a grid of cells, so that the time grows linearly with the mesh.

/** Index of the nearest of `points` (n*3) for each of `queries` (m*3), by a grid of about two points to a cell. */
export function nearestPoints(points, queries) {
  const n = points.length / 3;
  const found = new Uint32Array(queries.length / 3);
  if (n < 2) return found;
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 1) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  const span = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2], 1e-9);
  // Points lie on a surface: their number grows with the square of the number of cells along a side.
  const size = span / Math.max(1, Math.sqrt(n / 2));
  const sides = [0, 1, 2].map((axis) => Math.floor((high[axis] - low[axis]) / size) + 1);
  const cells = new Map();
  const cellOf = (array, i, axis) =>
    Math.min(Math.max(Math.floor((array[3 * i + axis] - low[axis]) / size), 0), sides[axis] - 1);
  for (let i = 0; i < n; i += 1) {
    const key = (cellOf(points, i, 0) * sides[1] + cellOf(points, i, 1)) * sides[2] + cellOf(points, i, 2);
    if (cells.has(key)) cells.get(key).push(i);
    else cells.set(key, [i]);
  }
  const reach = Math.max(...sides);
  for (let q = 0; q < found.length; q += 1) {
    const at = [0, 1, 2].map((axis) => cellOf(queries, q, axis));
    let least = Infinity;
    for (let ring = 0; ring <= reach; ring += 1) {
      if (least < Infinity && Math.sqrt(least) <= (ring - 1) * size) break;
      for (let x = Math.max(at[0] - ring, 0); x <= Math.min(at[0] + ring, sides[0] - 1); x += 1) {
        for (let y = Math.max(at[1] - ring, 0); y <= Math.min(at[1] + ring, sides[1] - 1); y += 1) {
          const isEdge = Math.abs(x - at[0]) === ring || Math.abs(y - at[1]) === ring;
          const step = isEdge || ring === 0 ? 1 : 2 * ring;
          for (let z = at[2] - ring; z <= at[2] + ring; z += step) {
            if (z < 0 || z >= sides[2]) continue;
            for (const i of cells.get((x * sides[1] + y) * sides[2] + z) ?? []) {
              const dx = points[3 * i] - queries[3 * q];
              const dy = points[3 * i + 1] - queries[3 * q + 1];
              const dz = points[3 * i + 2] - queries[3 * q + 2];
              const squared = dx * dx + dy * dy + dz * dz;
              if (squared < least) {
                least = squared;
                found[q] = i;
              }
            }
          }
        }
      }
    }
  }
  return found;
}
