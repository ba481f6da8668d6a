// Colour scales of even lightness steps, which are legible with any colour vision.

// Viridis: Smith and van der Walt, matplotlib 1.5, CC0. Cividis: Nunez, Anderton, Renslow, PLoS ONE 13(7), 2018.
const POINTS = {
  viridis: ["440154", "482878", "3e4a89", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"],
  cividis: ["00224e", "123570", "3b496c", "575d6d", "707173", "8a8678", "a59c74", "c3b369", "e1cc55", "fee838"],
};

/** Colour of points at which no vibration arrives: grey, not a colour of a scale. */
export const NOTHING = [138, 138, 146];
export const SCALES = Object.keys(POINTS);

/** Colour of a share 0..1 of a scale as three bytes. */
export function colourAt(scale, share) {
  const points = POINTS[scale];
  const place = Math.min(Math.max(share, 0), 1) * (points.length - 1);
  const first = Math.min(Math.floor(place), points.length - 2);
  const part = place - first;
  return [0, 2, 4].map((i) => {
    const low = parseInt(points[first].slice(i, i + 2), 16);
    const high = parseInt(points[first + 1].slice(i, i + 2), 16);
    return Math.round(low + part * (high - low));
  });
}

/** RGBA bytes for the 256 codes of a level: 0 for nothing, 1 to 255 along the scale. */
export function colourTable(scale) {
  const table = new Uint8Array(256 * 4);
  for (let code = 0; code < 256; code += 1) {
    const [red, green, blue] = code === 0 ? NOTHING : colourAt(scale, (code - 1) / 254);
    table.set([red, green, blue, 255], 4 * code);
  }
  return table;
}

export const cssColour = ([red, green, blue]) => `rgb(${red} ${green} ${blue})`;
