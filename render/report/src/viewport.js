// The part of the pictures that all views show: zoom 1 fits the picture; x and y are the centre, from 0 to 1.

/** @typedef {{zoom: number, x: number, y: number}} Viewport */

/** @type {Viewport} */
export const fitted = { zoom: 1, x: 0.5, y: 0.5 };
export const largestZoom = 64;

/** Keeps the picture over the whole view. @param {Viewport} view @returns {Viewport} */
export function clampViewport({ zoom, x, y }) {
  const kept = Math.min(largestZoom, Math.max(1, zoom));
  const half = 0.5 / kept;
  const clamp = place => Math.min(1 - half, Math.max(half, place));
  return { zoom: kept, x: clamp(x), y: clamp(y) };
}

/** Zooms about a point of the view (0 to 1), which stays in place. @param {Viewport} view */
export function zoomAbout(view, factor, u = 0.5, v = 0.5) {
  const zoom = Math.min(largestZoom, Math.max(1, view.zoom * factor));
  const shift = 1 / view.zoom - 1 / zoom;
  return clampViewport({ zoom, x: view.x + (u - 0.5) * shift, y: view.y + (v - 0.5) * shift });
}

/** Moves by a part of the view's size. @param {Viewport} view */
export function pan(view, right, down) {
  return clampViewport({ zoom: view.zoom, x: view.x + right / view.zoom, y: view.y + down / view.zoom });
}

/** The place in the picture (0 to 1) behind a point of the view (0 to 1). @param {Viewport} view */
export function placeAt(view, u, v) {
  return { x: view.x + (u - 0.5) / view.zoom, y: view.y + (v - 0.5) / view.zoom };
}
