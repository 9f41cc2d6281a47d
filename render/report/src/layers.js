// Decodes picture layers on demand, and keeps the last ones used.
//
// A layer's element holds base64 of a zlib stream of its values: planar, little endian, first the low bytes of all
// values, then the next bytes.
import { byId } from './dom.js';

const cacheBytes = 256 * 1024 * 1024;
const cache = new Map(); // element id -> {bytes, promise of the decoded layer, done}, the last used at the end
let cachedBytes = 0;

let halves; // value of each half-precision number

function halfValues() {
  if (halves) return halves;
  halves = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const exponent = bits >> 10 & 31;
    const fraction = bits & 1023;
    const size = exponent === 31 ? (fraction ? NaN : Infinity)
      : exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
    halves[bits] = bits >> 15 ? -size : size;
  }
  return halves;
}

function decodeBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  return Uint8Array.from(atob(text), character => character.charCodeAt(0));
}

async function inflate(packed) {
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Values of shuffled bytes. @param {Uint8Array} shuffled @param {number} count @param {"f16"|"f32"} type */
function unshuffle(shuffled, count, type) {
  const values = new Float32Array(count);
  if (type === 'f16') {
    const table = halfValues();
    for (let i = 0; i < count; ++i) values[i] = table[shuffled[i] | shuffled[count + i] << 8];
    return values;
  }
  const plain = new Uint8Array(values.buffer); // typed arrays are little endian wherever browsers run today
  for (let byte = 0; byte < 4; ++byte) {
    for (let i = 0; i < count; ++i) plain[4 * i + byte] = shuffled[byte * count + i];
  }
  return values;
}

async function decode(layer) {
  const text = byId(layer.element)?.textContent;
  if (!text) throw new Error(`the layer ${layer.element} is missing`);
  const count = layer.width * layer.height * layer.channels;
  const size = layer.type === 'f16' ? 2 : 4;
  const shuffled = await inflate(decodeBase64(text.trim()));
  if (shuffled.length !== count * size) throw new Error(`the layer ${layer.element} is damaged`);
  return { width: layer.width, height: layer.height, channels: layer.channels, values: unshuffle(shuffled, count, layer.type) };
}

function dropOldest() {
  for (const [element, entry] of cache) {
    if (cachedBytes <= cacheBytes || !entry.done) return;
    cache.delete(element);
    cachedBytes -= entry.bytes;
  }
}

/**
 * The values of a layer: {width, height, channels, values}, planar, row 0 on top.
 * @param {{element: string, width: number, height: number, channels: number, type: "f16"|"f32"}} layer
 * @throws {Error} if its element is missing or damaged
 */
export function readLayer(layer) {
  const entry = cache.get(layer.element) ?? { bytes: layer.width * layer.height * layer.channels * 4 };
  entry.promise ??= decode(layer).then(decoded => {
    entry.done = true;
    cachedBytes += entry.bytes;
    dropOldest();
    return decoded;
  });
  cache.delete(layer.element);
  cache.set(layer.element, entry);
  return entry.promise;
}

/** Whether a layer is decoded already. @param {{element: string}|undefined} layer */
export function isDecoded(layer) {
  return cache.get(layer?.element)?.done === true;
}

/** Whether another layer fits into the half of the cache that is for layers that are not asked for yet. */
export function hasRoom() {
  return cachedBytes < cacheBytes / 2;
}

/** A layer's value at a pixel of a picture of another or the same size. */
export function valueAt(decoded, x, y, width, height, channel = 0) {
  const column = Math.min(decoded.width - 1, Math.floor((x + 0.5) * decoded.width / width));
  const row = Math.min(decoded.height - 1, Math.floor((y + 0.5) * decoded.height / height));
  return decoded.values[(channel * decoded.height + row) * decoded.width + column];
}
