// Colours of pictures and of maps.
import { scheme } from 'vega';

const encodeSteps = 16384;
let encoded; // sRGB bytes of linear values 0 to 1

/** sRGB encoding (IEC 61966-2-1), as bytes of encodeSteps + 1 linear values from 0 to 1. */
function encodeTable() {
  encoded ??= Uint8Array.from({ length: encodeSteps + 1 }, (_, i) => {
    const linear = i / encodeSteps;
    return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
  });
  return encoded;
}

/** A linear three-channel layer as sRGB. @param {object} layer @param {number} stops  exposure @returns {ImageData} */
export function pictureImage(layer, stops) {
  const count = layer.width * layer.height;
  const image = new ImageData(layer.width, layer.height);
  const table = encodeTable();
  const gain = 2 ** stops * encodeSteps;
  for (let channel = 0; channel < 3; ++channel) {
    const start = channel * count;
    for (let i = 0; i < count; ++i) {
      const index = layer.values[start + i] * gain;
      image.data[4 * i + channel] = table[index >= encodeSteps ? encodeSteps : index > 0 ? Math.round(index) : 0];
    }
  }
  for (let i = 0; i < count; ++i) image.data[4 * i + 3] = 255;
  return image;
}

const palettes = {};

/** 256 colours of a scale, three bytes each. @param {"log"|"linear"|"diverging"} kind */
export function palette(kind) {
  const name = kind === 'diverging' ? 'blueorange' : 'viridis';
  if (!palettes[name]) {
    const color = scheme(name);
    palettes[name] = Uint8Array.from(Array.from({ length: 256 }, (_, i) => parseColor(color(i / 255))).flat());
  }
  return palettes[name];
}

function parseColor(text) {
  const digits = text.startsWith('#') ? text.slice(1).match(/../g).map(pair => parseInt(pair, 16)) : text.match(/\d+/g).map(Number);
  return digits.slice(0, 3);
}

/** Colours of categories, told apart with colour-deficient vision too (Okabe and Ito 2008). */
export const categoryColors = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#f0e442', '#8c8c8c'];
const categoryBytes = categoryColors.map(parseColor);
const missing = [255, 0, 255]; // not a number

/** Position of a value on a scale: 0 to 1, NaN if it is not a number. @param {{kind: string, low: number, high: number}} scale */
export function position(scale, value) {
  if (Number.isNaN(value)) return NaN;
  const { kind, low, high } = scale;
  const place = kind === 'log' ? Math.log(Math.max(value, 1e-30) / low) / Math.log(high / low)
    : kind === 'diverging' ? 0.5 + 0.5 * value / Math.max(Math.abs(low), Math.abs(high))
      : (value - low) / (high - low);
  return Math.min(1, Math.max(0, place));
}

/** A map as colours of its scale. @returns {ImageData} */
export function mapImage(map, scale) {
  const image = new ImageData(map.width, map.height);
  const colors = palette(scale.kind);
  for (let i = 0; i < map.width * map.height; ++i) {
    const value = map.values[i];
    if (scale.kind === 'category') {
      image.data.set(Number.isFinite(value) ? categoryColor(value) : missing, 4 * i);
    } else {
      const place = position(scale, value);
      if (Number.isNaN(place)) image.data.set(missing, 4 * i);
      else {
        const from = 3 * Math.round(255 * place);
        image.data[4 * i] = colors[from];
        image.data[4 * i + 1] = colors[from + 1];
        image.data[4 * i + 2] = colors[from + 2];
      }
    }
    image.data[4 * i + 3] = 255;
  }
  return image;
}

/** Three bytes. @param {number} value  an integer from 0 */
export function categoryColor(value) {
  const count = categoryBytes.length;
  return categoryBytes[(Math.round(value) % count + count) % count];
}
