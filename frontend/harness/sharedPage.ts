import { afterAll, vi } from 'vitest';

/*
 * Files of tests run one after the other in one process: loading React, Mantine and CodeMirror takes longer than
 * most tests. This removes what a file leaves behind. Modules of ours are evaluated again for each file, so
 * stores and caches in modules begin empty; the libraries and the window stay. It is set up after the libraries,
 * which add to the page once for all files.
 */

type Listening = [type: string, listener: EventListenerOrEventListenerObject, options?: boolean];
type Timer = ReturnType<typeof setTimeout>;

// React remembers in the document that it listens.
const KEPT_PROPERTY = /^_+react/;

const timers: Timer[] = [];
const frames: number[] = [];
const listeners: Listening[] = [];

const names = Object.getOwnPropertyNames(globalThis).filter((name) => !name.startsWith('__'));
const globals = names.map((name) => [name, Reflect.get(globalThis, name) as unknown] as const);
const objects = [
  document,
  navigator,
  Document.prototype,
  Element.prototype,
  HTMLElement.prototype,
  HTMLCanvasElement.prototype,
  Range.prototype,
].map((object) => [object, Object.getOwnPropertyDescriptors(object) as PropertyDescriptorMap] as const);
const elements = [document.documentElement, document.body].map(
  (element) => [element, [...element.attributes]] as const,
);
const styles = [...document.head.childNodes];
const address = window.location.href;

/** Records timers and listeners from now on. */
function watch(): void {
  const { setTimeout, setInterval, requestAnimationFrame } = globalThis;
  const recorded =
    <T extends unknown[], R>(call: (...args: T) => R, results: R[]) =>
    (...args: T): R => {
      const result = call(...args);
      results.push(result);
      return result;
    };
  Object.assign(globalThis, {
    setTimeout: Object.assign(recorded(setTimeout, timers), setTimeout),
    setInterval: Object.assign(recorded(setInterval, timers), setInterval),
    requestAnimationFrame: recorded(requestAnimationFrame, frames),
  });
  // Those of the document stay: React and user-event listen there once, for all files.
  const listen = window.addEventListener.bind(window);
  Object.assign(globalThis, {
    addEventListener: (...args: Listening) => {
      listeners.push(args);
      listen(...args);
    },
  });
}

/** Brings the properties of an object back to what they were. */
function restore(object: object, before: PropertyDescriptorMap): void {
  for (const key of Object.keys(Object.getOwnPropertyDescriptors(object)))
    if (!(key in before) && !KEPT_PROPERTY.test(key)) Reflect.deleteProperty(object, key);
  for (const [key, was] of Object.entries(before)) {
    const is = Object.getOwnPropertyDescriptor(object, key);
    if (is?.value !== was.value || is?.get !== was.get) Object.defineProperty(object, key, was);
  }
}

function cleanDocument(): void {
  window.history.replaceState(null, '', address);
  document.getSelection()?.removeAllRanges();
  document.body.replaceChildren();
  document.head.replaceChildren(...styles);
  for (const [element, attributes] of elements) {
    for (const { name } of [...element.attributes]) element.removeAttribute(name);
    for (const { name, value } of attributes) element.setAttribute(name, value);
  }
  localStorage.clear();
  sessionStorage.clear();
}

/** Makes the page as it was before this file of tests. */
function cleanPage(): void {
  vi.useRealTimers();
  vi.unstubAllGlobals();
  vi.unstubAllEnvs();
  for (const listening of listeners) window.removeEventListener(...listening);
  for (const timer of timers) clearTimeout(timer);
  for (const frame of frames) cancelAnimationFrame(frame);
  cleanDocument();
  for (const [name, value] of globals)
    if (!Object.is(Reflect.get(globalThis, name), value)) Reflect.set(globalThis, name, value);
  for (const [object, before] of objects) restore(object, before);
  vi.resetModules();
}

watch();
afterAll(cleanPage);
