// State that several parts of the page share, with listeners that are called when it changes.

export function makeStore(state) {
  const listeners = new Map();
  return {
    get: (key) => state[key],
    /** Change a value. Listeners of that key are called if it is another value. */
    set(key, value) {
      if (Object.is(state[key], value)) return;
      state[key] = value;
      for (const listener of listeners.get(key) ?? []) listener(value);
    },
    on(key, listener) {
      if (!listeners.has(key)) listeners.set(key, []);
      listeners.get(key).push(listener);
    },
  };
}
