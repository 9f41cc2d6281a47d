// Two pictures in one place: a swipe with a handle, and blinking.
import { make } from './dom.js';

/**
 * Adds the handle of a swipe to a view with two canvases: the first is seen left of it, the second right of it.
 * @returns {HTMLElement}
 */
export function makeHandle(view, store) {
  const handle = make('div', {
    class: 'handle', tabindex: 0, role: 'slider', 'aria-label': 'Place of the swipe', 'aria-valuemin': 0, 'aria-valuemax': 100,
  });
  const place = share => {
    const kept = Math.min(1, Math.max(0, share));
    store.set({ swipe: kept });
    handle.style.left = `${100 * kept}%`;
    handle.setAttribute('aria-valuenow', Math.round(100 * kept));
    view.items[1].canvas.style.clipPath = `inset(0 0 0 ${100 * kept}%)`;
  };
  const follow = event => {
    const box = view.stage.getBoundingClientRect();
    place((event.clientX - box.left) / box.width);
  };
  handle.addEventListener('pointerdown', event => {
    handle.setPointerCapture(event.pointerId);
    event.stopPropagation();
  });
  handle.addEventListener('pointermove', event => {
    if (handle.hasPointerCapture(event.pointerId)) follow(event);
  });
  const steps = { ArrowLeft: -0.02, ArrowDown: -0.02, ArrowRight: 0.02, ArrowUp: 0.02, PageDown: -0.1, PageUp: 0.1, Home: -1, End: 1 };
  handle.addEventListener('keydown', event => {
    if (!(event.key in steps)) return;
    event.preventDefault();
    event.stopPropagation();
    place(store.values.swipe + steps[event.key]);
  });
  view.stage.append(handle);
  place(store.values.swipe);
  return handle;
}

/**
 * Shows the two canvases of a view in turn, `rate` times a second each pair; none by itself at rate 0.
 * A key B changes them by hand.
 * @returns {() => void} stops it
 */
export function startBlinking(view, store, titleOf) {
  let second = false;
  const tag = view.stage.querySelector('.tag') ?? make('span', { class: 'tag' });
  view.stage.append(tag);
  const show = () => {
    view.items[1].canvas.style.visibility = second ? 'visible' : 'hidden';
    view.stage.dataset.visible = view.items[second ? 1 : 0].id;
    tag.textContent = `${second ? 'B' : 'A'}: ${titleOf(view.items[second ? 1 : 0].id)}`;
  };
  const change = () => {
    second = !second;
    show();
  };
  const onKey = event => {
    if (event.key === 'b' || event.key === 'B') change();
  };
  view.stage.addEventListener('keydown', onKey);
  show();
  const timer = store.values.rate > 0 ? setInterval(change, 500 / store.values.rate) : 0;
  return () => {
    clearInterval(timer);
    view.stage.removeEventListener('keydown', onKey);
  };
}
