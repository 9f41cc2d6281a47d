// One view of the pictures: canvases in the same place, and the mouse, touch and keys that move all views.
import { announce, make } from './dom.js';
import { clampViewport, fitted, pan, placeAt, zoomAbout } from './viewport.js';

const dragStart = 4; // pixels of movement that make a click a drag

/**
 * @param {object} store  with view, and cursor: a pixel, or null before there is one
 * @param {{width: number, height: number}} size  of the pictures, in pixels
 * @param {string} label  for screen readers
 * @param {(x: number, y: number) => void} onPixel  when a pixel is chosen
 */
export function makeStage(store, size, label, onPixel) {
  const node = make('div', {
    class: 'stage', tabindex: 0, role: 'application', 'aria-roledescription': 'picture view',
    'aria-label': `${label}. Keys: plus, minus and 0 zoom; arrows pan; Shift and arrows move the cursor; Enter reads the pixel.`,
    style: `--aspect: ${size.width} / ${size.height}`,
  });
  const zoom = (factor, u, v) => store.set({ view: zoomAbout(store.values.view, factor, u, v) });
  listenToPointers(node, store, size, onPixel);
  node.addEventListener('wheel', event => {
    if (!event.ctrlKey && document.activeElement !== node) return;
    event.preventDefault();
    const box = node.getBoundingClientRect();
    zoom(2 ** (-event.deltaY / 240), (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  }, { passive: false });
  node.addEventListener('keydown', event => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target !== node) return;
    if (handleKey(event, store, size, zoom, onPixel)) event.preventDefault();
  });
  return node;
}

const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

function handleKey(event, store, size, zoom, onPixel) {
  const { view } = store.values;
  const cursor = store.values.cursor ?? { x: size.width >> 1, y: size.height >> 1 };
  if (event.key in arrows) {
    const [right, down] = arrows[event.key];
    if (event.shiftKey) moveCursor(store, size, cursor.x + right, cursor.y + down);
    else store.set({ view: pan(view, 0.15 * right, 0.15 * down) });
  } else if (event.key === '+' || event.key === '=') zoom(1.5);
  else if (event.key === '-' || event.key === '_') zoom(1 / 1.5);
  else if (event.key === '0') store.set({ view: fitted });
  else if (event.key === 'Enter') onPixel(cursor.x, cursor.y);
  else return false;
  return true;
}

/** Moves the cursor to a pixel, and the views so far that they show it. */
function moveCursor(store, size, column, row) {
  const x = Math.min(size.width - 1, Math.max(0, column));
  const y = Math.min(size.height - 1, Math.max(0, row));
  const view = { ...store.values.view };
  const half = 0.5 / view.zoom;
  for (const [axis, place] of [['x', (x + 0.5) / size.width], ['y', (y + 0.5) / size.height]]) {
    if (Math.abs(place - view[axis]) > half) view[axis] = place;
  }
  store.set({ cursor: { x, y }, view: clampViewport(view) });
  announce(`Cursor at column ${x}, row ${y}`);
}

function listenToPointers(node, store, size, onPixel) {
  const pointers = new Map(); // pointer id -> last place in the view, 0 to 1
  let moved = 0;
  let several = false;
  const locate = event => {
    const box = node.getBoundingClientRect();
    return { u: (event.clientX - box.left) / box.width, v: (event.clientY - box.top) / box.height, width: box.width };
  };
  node.addEventListener('pointerdown', event => {
    if (event.button !== 0 || event.target.closest('.handle')) return;
    node.setPointerCapture(event.pointerId);
    if (pointers.size === 0) [moved, several] = [0, false];
    pointers.set(event.pointerId, locate(event));
    several ||= pointers.size > 1;
  });
  node.addEventListener('pointermove', event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const now = locate(event);
    moved += Math.hypot(now.u - last.u, now.v - last.v) * now.width;
    pointers.set(event.pointerId, now);
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const span = point => Math.max(0.01, Math.hypot(point.u - other.u, point.v - other.v));
      store.set({ view: zoomAbout(store.values.view, span(now) / span(last), other.u, other.v) });
    } else if (moved > dragStart) store.set({ view: pan(store.values.view, last.u - now.u, last.v - now.v) });
  });
  node.addEventListener('pointerup', event => {
    const place = pointers.get(event.pointerId);
    pointers.delete(event.pointerId);
    if (!place || moved > dragStart || several) return;
    const { x, y } = placeAt(store.values.view, place.u, place.v);
    const clamp = (value, count) => Math.min(count - 1, Math.max(0, Math.floor(value * count)));
    onPixel(clamp(x, size.width), clamp(y, size.height));
  });
  node.addEventListener('pointercancel', event => pointers.delete(event.pointerId));
}

/**
 * Draws images of one place over each other, and the cursor.
 * @param {Array<{image: HTMLCanvasElement, alpha: number}>} layers
 * @param {{x: number, y: number}|null} cursor  a pixel of `size`
 */
export function drawView(canvas, layers, view, cursor, size) {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio);
  const height = Math.round(canvas.clientHeight * ratio);
  if (width === 0 || height === 0) return;
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, width, height);
  const wide = width * view.zoom;
  const high = height * view.zoom;
  const left = width / 2 - view.x * wide;
  const top = height / 2 - view.y * high;
  for (const { image, alpha } of layers) {
    context.imageSmoothingEnabled = wide < image.width;
    context.imageSmoothingQuality = 'high';
    context.globalAlpha = alpha;
    context.drawImage(image, left, top, wide, high);
  }
  context.globalAlpha = 1;
  if (cursor) drawCursor(context, left + (cursor.x + 0.5) * wide / size.width, top + (cursor.y + 0.5) * high / size.height,
    Math.max(4 * ratio, wide / size.width / 2), ratio);
}

function drawCursor(context, x, y, half, ratio) {
  for (const [color, line] of [['#000', 3], ['#fff', 1.2]]) {
    context.strokeStyle = color;
    context.lineWidth = line * ratio;
    context.strokeRect(x - half, y - half, 2 * half, 2 * half);
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + dx * half, y + dy * half);
      context.lineTo(x + dx * (half + 6 * ratio), y + dy * (half + 6 * ratio));
    }
    context.stroke();
  }
}
