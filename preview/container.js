// Containers: a header in JSON, and typed arrays behind it.

const VIEWS = { f64: Float64Array, i32: Int32Array, u8: Uint8Array };

/**
 * Decodes a container. The arrays are views of its buffer, so that nothing is copied.
 * @param {ArrayBuffer} buffer the bytes of the answer
 * @returns {{header: object, arrays: Object<string, Float64Array|Int32Array|Uint8Array>}}
 */
export function decode(buffer) {
  if (buffer.byteLength < 8) throw new Error('The container is shorter than its first 8 bytes.');
  const size = new DataView(buffer).getUint32(0, true);
  const start = 8 + Math.ceil(size / 8) * 8;
  if (8 + size > buffer.byteLength) throw new Error('The header of the container is cut off.');
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, size)));
  const arrays = {};
  for (const [name, place] of Object.entries(header.arrays ?? {})) {
    const View = VIEWS[place.type];
    if (!View) throw new Error(`The array ${name} has the unknown type ${place.type}.`);
    const offset = start + place.offset;
    if (offset + place.length * View.BYTES_PER_ELEMENT > buffer.byteLength) {
      throw new Error(`The array ${name} of the container is cut off.`);
    }
    arrays[name] = new View(buffer, offset, place.length);
  }
  return { header, arrays };
}
