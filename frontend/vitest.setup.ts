import './harness/sentBodies';
import './src/i18n/editorTexts';
import '@testing-library/jest-dom/vitest';
import { cleanup, configure } from '@testing-library/react';
import { afterEach } from 'vitest';

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

// Whether an element is hidden follows from all styles above it: jsdom takes half of a test's time for that.
configure({ defaultHidden: true, asyncUtilTimeout: 20_000 });

afterEach(cleanup);

// jsdom draws no pictures, and would say so each time it is asked to.
HTMLCanvasElement.prototype.getContext = () => null;

// jsdom knows no pointers that could be captured.
Element.prototype.setPointerCapture ??= () => undefined;
Element.prototype.releasePointerCapture ??= () => undefined;
