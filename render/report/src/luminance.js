// Luminance of pictures as a display shows them: nothing is brighter than its white.

/** Luminance weights of linear Rec. 709. */
const luminanceWeights = [0.2126, 0.7152, 0.0722];

/** The luminance of a three-channel layer as a display shows it, relative to white, one value a pixel. */
export function luminance(layer) {
  const count = layer.width * layer.height;
  const [r, g, b] = luminanceWeights;
  const shown = i => Math.min(1, layer.values[i]);
  return Float32Array.from({ length: count }, (_, i) => r * shown(i) + g * shown(count + i) + b * shown(2 * count + i));
}

/** The same of one linear colour. @param {number[]} color */
export const colorLuminance = color => luminance({ width: 1, height: 1, values: color })[0];
