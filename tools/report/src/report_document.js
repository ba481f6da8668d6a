// The document of a report: it is compressed, base64 arrays are decoded when they are first needed, and objects are found by id.

export function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const IS_LITTLE_ENDIAN = new Uint8Array(new Uint32Array([1]).buffer)[0] === 1;

function wordsOf(base64, ArrayType, read) {
  const bytes = bytesOf(base64);
  if (IS_LITTLE_ENDIAN) return new ArrayType(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return ArrayType.from({ length: bytes.byteLength / 4 }, (_, i) => view[read](4 * i, true));
}

export const float32Of = (base64) => wordsOf(base64, Float32Array, "getFloat32");
/** Decode values of two bytes each, which are aligned, since decoded bytes start their own buffer. */
export function uint16Of(base64) {
  const bytes = bytesOf(base64);
  if (IS_LITTLE_ENDIAN) return new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 2);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return Uint16Array.from({ length: bytes.byteLength / 2 }, (_, i) => view.getUint16(2 * i, true));
}
export const uint32Of = (base64) => wordsOf(base64, Uint32Array, "getUint32");

/** The text of a page's data, which are gzip in base64. */
export function textOf(base64) {
  const stream = new Blob([bytesOf(base64.trim())]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}

/** Read the document of the page. Throws an Error with a message for the user if it is not a valid one. */
export function readDocument(text) {
  const data = JSON.parse(text);
  if (data.format !== "scene2hap/report") {
    throw new Error("The data of this page is not a scene2hap report. Write it again with `scene2hap report`.");
  }
  if (data.version !== 1) {
    throw new Error(`The data of this page has version ${data.version}; this page reads version 1.`);
  }
  for (const { states } of data.objects) for (const state of states) Object.assign(state, data.loops[state.loop]);
  const byId = new Map(data.objects.map((object) => [object.id, object]));
  const contactsOf = new Map(data.objects.map((object) => [object.id, []]));
  for (const contact of data.contacts) {
    contactsOf.get(contact.a)?.push({ other: contact.b, passes_db: contact.passes_db });
    contactsOf.get(contact.b)?.push({ other: contact.a, passes_db: contact.passes_db });
  }
  return {
    ...data,
    byId,
    contactsOf,
    /** The name that the author gave to an object. */
    name: (id) => byId.get(id)?.name || id,
  };
}
