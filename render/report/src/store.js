// The reader's choices on the page, with listeners for changes.

/** A store of named values. Listeners run once per frame of the screen, after one of their values changed. */
export function createStore(initial) {
  const values = { ...initial };
  const listeners = [];
  let changed = new Set();

  const notify = () => {
    const names = changed;
    changed = new Set();
    for (const listener of listeners) {
      if (listener.names.some(name => names.has(name))) listener.run(values);
    }
  };

  return {
    values,
    set(update) {
      const waiting = changed.size > 0;
      for (const [name, value] of Object.entries(update)) {
        if (Object.is(values[name], value)) continue;
        values[name] = value;
        changed.add(name);
      }
      if (!waiting && changed.size > 0) requestAnimationFrame(notify);
    },
    on(names, run) {
      listeners.push({ names, run });
    },
  };
}
