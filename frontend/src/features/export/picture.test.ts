import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Diagram } from '@/model/diagram';
import { makeVocabulary } from '@/model/vocabulary';
import { paletteOf } from './palette';
import { pngOf, saveAs, svgOf } from './picture';

const diagram = {
  id: 'Patrol',
  root: 'a',
  nodes: { a: { type: 'Sequence', name: 'round <1>' } },
  drafts: [],
  layout: 'vertical',
} as unknown as Diagram;

describe('svgOf', () => {
  it.each(['light', 'dark'] as const)('is a self-contained document in the %s theme', (theme) => {
    const text = svgOf(diagram, makeVocabulary([]), theme);
    expect(
      text.startsWith('<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg"'),
    ).toBe(true);
    const read = new DOMParser().parseFromString(text.trim(), 'image/svg+xml');
    expect(read.querySelector('parsererror')).toBeNull();
    expect(read.querySelector('title')?.textContent).toBe('Patrol');
    expect([...read.querySelectorAll('text')].map(({ textContent }) => textContent)).toEqual([
      'round <1>',
      'Sequence',
    ]);
    expect(read.querySelector('rect')?.getAttribute('fill')).toBe(paletteOf(theme)('canvas'));
  });
});

describe('pngOf', () => {
  let size = { width: 100, height: 50 };
  let source = '';
  const drawn = vi.fn();

  beforeEach(() => {
    drawn.mockClear();
    vi.stubGlobal(
      'Image',
      class {
        get naturalWidth() {
          return size.width;
        }
        get naturalHeight() {
          return size.height;
        }
        set src(address: string) {
          source = address;
        }
        decode = () => Promise.resolve();
      },
    );
    const context = { drawImage: drawn } as unknown as CanvasRenderingContext2D;
    vi.spyOn(HTMLCanvasElement.prototype, 'getContext').mockReturnValue(context as never);
    onTestFinished(() => {
      vi.unstubAllGlobals();
    });
  });

  const canDraw = (blob: Blob | null) =>
    vi.spyOn(HTMLCanvasElement.prototype, 'toBlob').mockImplementation((done) => done(blob));

  it.each([
    [100, 50, 200, 100],
    [4096, 10, 8192, 20],
    [8192, 4096, 8192, 4096],
    [100, 16_384, 50, 8192],
  ])(
    'draws %s × %s px at double size, up to the limit of browsers: %s × %s',
    async (width, height, ...expected) => {
      size = { width, height };
      const png = new Blob(['png']);
      const toBlob = canDraw(png);
      expect(await pngOf('<svg>ä</svg>')).toBe(png);
      expect(source).toBe('data:image/svg+xml;charset=utf-8,%3Csvg%3E%C3%A4%3C%2Fsvg%3E');
      expect(drawn.mock.calls[0]?.slice(1)).toEqual([0, 0, ...expected]);
      const canvas = toBlob.mock.contexts[0] as HTMLCanvasElement;
      expect([canvas.width, canvas.height]).toEqual(expected);
      expect(toBlob.mock.calls[0]?.[1]).toBe('image/png');
    },
  );

  it('fails if the browser makes no picture', async () => {
    canDraw(null);
    await expect(pngOf('<svg/>')).rejects.toThrow('The picture is empty.');
  });
});

describe('saveAs', () => {
  it('offers a file for download, and revokes its URL later', () => {
    vi.useFakeTimers();
    onTestFinished(() => {
      vi.useRealTimers();
    });
    const made = vi.fn(() => 'blob:1');
    const revoked = vi.fn();
    Object.assign(URL, { createObjectURL: made, revokeObjectURL: revoked });
    let clicked: string[] = [];
    vi.spyOn(HTMLAnchorElement.prototype, 'click').mockImplementation(function (this: HTMLAnchorElement) {
      clicked = [this.href, this.download];
    });
    const blob = new Blob(['x']);
    saveAs(blob, 'Patrol.svg');
    expect(made).toHaveBeenCalledWith(blob);
    expect(clicked).toEqual(['blob:1', 'Patrol.svg']);
    vi.advanceTimersByTime(59_000);
    expect(revoked).not.toHaveBeenCalled();
    vi.advanceTimersByTime(1000);
    expect(revoked).toHaveBeenCalledWith('blob:1');
  });
});
