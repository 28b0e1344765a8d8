import { beforeEach, describe, expect, it, vi } from 'vitest';
import type * as support from './support';

/** A canvas outside the page that has WebGL, or has not. */
const canvasWith = (gl: object | null) =>
  class {
    getContext() {
      return gl;
    }
  };

async function canDraw(): Promise<boolean> {
  vi.resetModules();
  const fresh = (await import('./support')) as typeof support;
  return fresh.canDrawInWorker();
}

beforeEach(() => {
  vi.stubGlobal('Worker', vi.fn());
  HTMLCanvasElement.prototype.transferControlToOffscreen = vi.fn<() => OffscreenCanvas>();
  return () => {
    vi.unstubAllGlobals();
    Reflect.deleteProperty(HTMLCanvasElement.prototype, 'transferControlToOffscreen');
  };
});

describe('drawing in a worker', () => {
  it('works where such a canvas has WebGL, whose probe is given back', async () => {
    const loseContext = vi.fn();
    vi.stubGlobal('OffscreenCanvas', canvasWith({ getExtension: () => ({ loseContext }) }));
    expect(await canDraw()).toBe(true);
    expect(loseContext).toHaveBeenCalledOnce();
  });

  it('does not work without WebGL, without such canvases, and where a canvas cannot be handed over', async () => {
    vi.stubGlobal('OffscreenCanvas', canvasWith(null));
    expect(await canDraw()).toBe(false);
    vi.stubGlobal('OffscreenCanvas', undefined);
    expect(await canDraw()).toBe(false);
    vi.stubGlobal('OffscreenCanvas', canvasWith({ getExtension: () => null }));
    Reflect.deleteProperty(HTMLCanvasElement.prototype, 'transferControlToOffscreen');
    expect(await canDraw()).toBe(false);
  });
});
