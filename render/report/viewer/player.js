// Shows sequences of pictures at a frame rate, on grey.
import { dim, greyAround } from './brightness.js';

const singleFrame = 1000;
const gap = 500;

/** Decoded pictures of data URIs. @param {string[]} frames @param {number} share of the screen's luminance */
export function decode(frames, share) {
  return Promise.all(frames.map(async source => {
    const picture = new Image();
    picture.src = source;
    await picture.decode();
    return dim(picture, share);
  }));
}

/** Waits some milliseconds. @param {number} time */
function pause(time) {
  return new Promise(resolve => setTimeout(resolve, time));
}

/**
 * Plays pictures once.
 * @param {HTMLCanvasElement} canvas @param {CanvasImageSource[]} pictures @param {{rate: number, share: number}} show frames per second; share of the screen's luminance
 * @returns {Promise<number>} frames that came too late to be shown
 */
export async function play(canvas, pictures, { rate, share }) {
  const context = canvas.getContext('2d');
  const show = picture => context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  let dropped = 0;
  if (pictures.length === 1) {
    show(pictures[0]);
    await pause(singleFrame);
  } else {
    dropped = await new Promise(resolve => {
      let start;
      let last = -1;
      let missed = 0;
      const step = now => {
        start ??= now;
        const at = Math.floor((now - start) * rate / 1000);
        if (at >= pictures.length) return resolve(missed + pictures.length - 1 - last);
        if (at !== last) {
          missed += at - last - 1;
          show(pictures[at]);
          last = at;
        }
        return requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    });
  }
  clear(canvas, share);
  return dropped;
}

/** Grey of half the luminance. @param {HTMLCanvasElement} canvas @param {number} share of the screen's luminance */
export function clear(canvas, share) {
  const context = canvas.getContext('2d');
  context.fillStyle = greyAround(share);
  context.fillRect(0, 0, canvas.width, canvas.height);
}

/** Plays two sequences with a pause between them. @returns {Promise<number>} frames dropped */
export async function playPair(canvas, first, second, show, onInterval) {
  clear(canvas, show.share);
  await pause(gap);
  onInterval(1);
  const before = await play(canvas, first, show);
  onInterval(0);
  await pause(gap);
  onInterval(2);
  const after = await play(canvas, second, show);
  onInterval(0);
  return before + after;
}
