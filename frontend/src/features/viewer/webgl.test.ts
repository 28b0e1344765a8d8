import { afterEach, describe, expect, it, vi } from 'vitest';
import type * as WebGl from './webgl';

const none = HTMLCanvasElement.prototype.getContext;
const lose = vi.fn();

/** Loads the module again and asks for the kind of WebGL, since the module asks the browser only once. */
async function ask(renderer: string | null, isNamed = true) {
  vi.resetModules();
  const getContext = vi.fn((kind: string) =>
    renderer === null || kind !== 'webgl2'
      ? null
      : {
          RENDERER: 1,
          getExtension: (name: string) =>
            name === 'WEBGL_lose_context'
              ? { loseContext: lose }
              : isNamed
                ? { UNMASKED_RENDERER_WEBGL: 2 }
                : null,
          getParameter: (which: number) => (isNamed === (which === 2) ? renderer : 'hidden'),
        },
  );
  Object.assign(HTMLCanvasElement.prototype, { getContext });
  const asked: typeof WebGl = await import('./webgl');
  return { ...asked, getContext };
}

afterEach(() => {
  HTMLCanvasElement.prototype.getContext = none;
  lose.mockClear();
});

describe('WebGL', () => {
  it('is absent if the browser gives no context', async () => {
    const { hasWebGl, isSoftwareWebGl } = await ask(null);
    expect([hasWebGl(), isSoftwareWebGl()]).toEqual([false, false]);
  });

  it.each([
    ['NVIDIA GeForce', false],
    ['Google SwiftShader', true],
    ['llvmpipe (LLVM 19)', true],
    ['Software Rasterizer', true],
    ['Microsoft Basic Render Driver', true],
  ])('of %s is drawn by the processor: %s', async (renderer, isSoftware) => {
    const { hasWebGl, isSoftwareWebGl } = await ask(renderer);
    expect([isSoftwareWebGl(), hasWebGl()]).toEqual([isSoftware, true]);
  });

  it('is asked by its public name if the other one is hidden', async () => {
    const { isSoftwareWebGl } = await ask('SwiftShader', false);
    expect(isSoftwareWebGl()).toBe(true);
  });

  it('is asked once, and its context is released', async () => {
    const { hasWebGl, isSoftwareWebGl, getContext } = await ask('NVIDIA');
    hasWebGl();
    hasWebGl();
    isSoftwareWebGl();
    expect(getContext).toHaveBeenCalledOnce();
    expect(lose).toHaveBeenCalledOnce();
  });
});
