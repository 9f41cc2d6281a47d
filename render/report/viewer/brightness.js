// Luminance of the screen: pictures of a display whose white is darker are shown darker.

function decode(value) {
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

function encode(light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055;
}

/** sRGB values of a share of the luminance of all 256 of them (IEC 61966-2-1). @param {number} share 0 to 1 */
export function dimmedValues(share) {
  return Uint8ClampedArray.from({ length: 256 }, (_, value) => Math.round(255 * encode(share * decode(value / 255))));
}

/**
 * The share of the screen's luminance at which a picture is as bright as it was made for.
 * @param {number} white cd/m2 of the picture's white @param {number} screen cd/m2 of the screen's
 */
export function shareOf(white, screen) {
  return Math.min(1, white / screen);
}

/** A picture at a share of its luminance. @param {HTMLImageElement} picture @param {number} share */
export function dim(picture, share) {
  if (share >= 1) return picture;
  const values = dimmedValues(share);
  const canvas = new OffscreenCanvas(picture.naturalWidth, picture.naturalHeight);
  const context = canvas.getContext('2d');
  context.drawImage(picture, 0, 0);
  const pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  for (let i = 0; i < pixels.data.length; ++i) if (i % 4 < 3) pixels.data[i] = values[pixels.data[i]];
  context.putImageData(pixels, 0, 0);
  return canvas;
}

/** Grey of half the luminance of the picture's white, as a colour of the screen. @param {number} share */
export function greyAround(share) {
  const value = dimmedValues(share / 2)[255];
  return `rgb(${value}, ${value}, ${value})`;
}
