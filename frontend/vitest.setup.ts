import './harness/computedStyle';
import './harness/editorTexts';
import './harness/sentBodies';
import '@testing-library/jest-dom/vitest';
import { cleanup, configure } from '@testing-library/react';
import React from 'react';
import { afterEach, vi } from 'vitest';

// jsdom has no layout: Mantine asks for these at start, and neither matters to a test.
window.matchMedia ??= (query: string) =>
  ({
    matches: false,
    media: query,
    onchange: null,
    addListener: () => undefined,
    removeListener: () => undefined,
    addEventListener: () => undefined,
    removeEventListener: () => undefined,
    dispatchEvent: () => false,
  }) satisfies MediaQueryList;

window.ResizeObserver ??= class {
  observe(): void {}
  unobserve(): void {}
  disconnect(): void {}
};

// Without a layout nothing is out of sight.
window.IntersectionObserver ??= class {
  readonly root = null;
  readonly rootMargin = '';
  readonly scrollMargin = '';
  readonly thresholds = [];
  constructor(private readonly callback: IntersectionObserverCallback) {}
  observe(): void {
    this.callback([{ isIntersecting: true } as IntersectionObserverEntry], this);
  }
  unobserve(): void {}
  disconnect(): void {}
  takeRecords(): IntersectionObserverEntry[] {
    return [];
  }
};

// A growing text field waits for fonts.
if (!('fonts' in document)) Object.assign(document, { fonts: new EventTarget() });

Element.prototype.scrollIntoView ??= () => undefined;

// An editor measures its text.
Range.prototype.getClientRects ??= () => [] as unknown as DOMRectList;
Range.prototype.getBoundingClientRect ??= () => new DOMRect();

const PATIENCE_MS = 20_000;

// Whether an element is hidden follows from all styles above it: jsdom takes half of a test's time for that.
configure({ defaultHidden: true, asyncUtilTimeout: PATIENCE_MS });

// Vitest's own waits end after a second, which a busy machine may need.
const { waitFor, waitUntil } = vi;
const patient = (given?: number | object) =>
  typeof given === 'number' ? given : { timeout: PATIENCE_MS, ...given };
vi.waitFor = (callback, given) => waitFor(callback, patient(given));
vi.waitUntil = (callback, given) => waitUntil(callback, patient(given));

// React records where each element was made, for its warnings: a tenth of what rendering takes. Beyond so many
// it stops by itself.
const internals = Reflect.get(
  React,
  '__CLIENT_INTERNALS_DO_NOT_USE_OR_WARN_USERS_THEY_CANNOT_UPGRADE',
) as object;
Object.defineProperty(internals, 'recentlyCreatedOwnerStacks', {
  configurable: true,
  get: () => 10_000,
  set: () => undefined,
});

afterEach(cleanup);

// jsdom draws no pictures, and would say so each time it is asked to.
HTMLCanvasElement.prototype.getContext = () => null;

// jsdom knows no pointers that could be captured.
Element.prototype.setPointerCapture ??= () => undefined;
Element.prototype.releasePointerCapture ??= () => undefined;
