// Decodes the pictures of the frame shown while the browser is idle, so that a brush finds them decoded.
import { hasRoom, isDecoded, readLayer } from './layers.js';
import { sharedFrame, variantFrame } from './study.js';

export function prefetchPictures(study, store) {
  const idle = window.requestIdleCallback ?? (run => setTimeout(run, 50));
  let turn = 0;
  const start = () => {
    const mine = ++turn;
    const { frame } = store.values;
    const layers = [sharedFrame(study, frame)?.reference, ...study.variants.map(variant => variantFrame(study, variant.id, frame)?.picture)]
      .filter(layer => layer && !isDecoded(layer));
    const next = () => {
      if (mine !== turn || layers.length === 0 || !hasRoom()) return;
      // A damaged layer is reported where it is shown.
      readLayer(layers.shift()).catch(() => {}).then(() => idle(next));
    };
    idle(next);
  };
  store.on(['frame'], start);
  start();
}
