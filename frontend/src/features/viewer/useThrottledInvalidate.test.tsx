import { useEffect } from 'react';
import { afterAll, beforeEach, describe, expect, it, vi } from 'vitest';
import { showScene } from '../../../harness/scene';
import { useThrottledInvalidate } from './useThrottledInvalidate';

const none = HTMLCanvasElement.prototype.getContext;
const SIGNALED = 4;
let isDone = true;
const deleted = vi.fn();

// The page asks for the kind of WebGL only once; in this file, WebGL is software.
Object.assign(HTMLCanvasElement.prototype, {
  getContext: (kind: string) =>
    kind === 'webgl2'
      ? {
          SIGNALED,
          getExtension: () => null,
          getParameter: () => 'SwiftShader',
          fenceSync: () => ({}),
          flush: () => undefined,
          isContextLost: () => false,
          getSyncParameter: () => (isDone ? SIGNALED : 0),
          deleteSync: deleted,
        }
      : null,
});
afterAll(() => {
  HTMLCanvasElement.prototype.getContext = none;
});

function Throttled({ onDraw }: { readonly onDraw: (draw: () => void) => void }) {
  const draw = useThrottledInvalidate();
  useEffect(() => onDraw(draw), [draw, onDraw]);
  return null;
}

function begin() {
  const given = vi.fn<(draw: () => void) => void>();
  const { frames } = showScene(<Throttled onDraw={given} />);
  return { frames, draw: () => given.mock.lastCall?.[0]() };
}

beforeEach(() => {
  isDone = true;
  deleted.mockClear();
});

describe('frames with software rendering', () => {
  it('come one by one: several requests meanwhile make one frame', async () => {
    const { frames, draw } = begin();
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(0));
    const before = frames();
    draw();
    draw();
    draw();
    await vi.waitFor(() => expect(deleted).toHaveBeenCalledOnce());
    expect(frames()).toBe(before + 1);
    await vi.waitFor(() => expect(frames()).toBe(before + 2));
    await vi.waitFor(() => expect(deleted).toHaveBeenCalledTimes(2));
  });

  it.each([
    [0, 80],
    [30, 80],
    [100, 200],
    [900, 1000],
  ])('that took %s ms are followed by a pause of %s ms', async (cost, pause) => {
    const { frames, draw } = begin();
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(0));
    isDone = false;
    const before = frames();
    const now = vi.spyOn(performance, 'now').mockReturnValue(5000);
    const timeouts = vi.spyOn(globalThis, 'setTimeout');
    draw();
    await vi.waitFor(() => expect(frames()).toBe(before + 1));
    expect(deleted).not.toHaveBeenCalled();
    now.mockReturnValue(5000 + cost);
    isDone = true;
    await vi.waitFor(() => expect(timeouts.mock.calls.map(([, delay]) => delay)).toContain(pause));
    expect(deleted).toHaveBeenCalledOnce();
  });
});
