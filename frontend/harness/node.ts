// What modules of the page look for when they are loaded, in Node: a window that nobody closes, and an empty
// store of settings.
const localStorage = { getItem: () => null, setItem: () => undefined, removeItem: () => undefined };
Object.assign(globalThis, { window: new EventTarget(), localStorage });

export {};
