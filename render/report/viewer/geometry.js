// How large a picture is for the viewer's eye.

/** Width of a bank card, mm (ISO/IEC 7810 ID-1). */
export const cardWidth = 85.6;

/** Pixels of the screen in a degree of visual angle. @param {number} mmPerPixel @param {number} distance mm */
export function pixelsPerDegree(mmPerPixel, distance) {
  return 2 * distance * Math.tan(Math.PI / 360) / mmPerPixel;
}

/** Screen pixels per picture pixel, so that the picture has its own pixels per degree. @param {number} own */
export function scaleFor(own, mmPerPixel, distance) {
  return pixelsPerDegree(mmPerPixel, distance) / own;
}

/** The distance at which a picture pixel is one screen pixel, mm. */
export function distanceForOne(own, mmPerPixel) {
  return own * mmPerPixel / (2 * Math.tan(Math.PI / 360));
}
