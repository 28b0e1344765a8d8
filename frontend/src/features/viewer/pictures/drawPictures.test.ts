import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Camera } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import { drawPictures, type Shown } from './drawPictures';

const frame = (t: number, width = 320, height = 240): Camera => ({
  type: 'camera',
  t,
  sensor: 'camera',
  width,
  height,
  jpeg: new Uint8Array([t]),
});

interface Decoding {
  readonly size: number;
  done(width?: number, height?: number): Promise<void>;
  fail(): Promise<void>;
}

/** Draws pictures that are decoded when the test says so. */
function begin() {
  const decoding: Decoding[] = [];
  const close = vi.fn();
  const settled = () => new Promise<void>((resolve) => setTimeout(resolve));
  vi.stubGlobal(
    'createImageBitmap',
    (blob: Blob) =>
      new Promise((resolve, reject) => {
        decoding.push({
          size: blob.size,
          done: (width = 320, height = 240) => {
            resolve({ width, height, close });
            return settled();
          },
          fail: () => {
            reject(new Error('damaged'));
            return settled();
          },
        });
      }),
  );
  const now = vi.spyOn(performance, 'now').mockReturnValue(0);
  const canvas = document.createElement('canvas');
  const drawImage = vi.fn();
  canvas.getContext = (() => ({ drawImage })) as unknown as typeof canvas.getContext;
  const shown: Shown[] = [];
  const stop = drawPictures('camera', canvas, (each) => shown.push(each));
  onTestFinished(() => {
    stop();
    vi.unstubAllGlobals();
  });
  return { decoding, close, canvas, drawImage, shown, stop, now };
}

beforeEach(() => {
  frames.clear();
  useSessionStore.setState({ simTime: 0 });
});

describe('drawPictures', () => {
  it('draws a picture in its own size, and reports that', async () => {
    const { decoding, canvas, drawImage, close, shown } = begin();
    frames.publish(frame(1));
    await decoding[0]!.done(640, 360);
    expect([canvas.width, canvas.height]).toEqual([640, 360]);
    expect(drawImage).toHaveBeenCalledExactlyOnceWith(expect.objectContaining({ width: 640 }), 0, 0);
    expect(close).toHaveBeenCalledOnce();
    expect(shown).toEqual([{ width: 640, height: 360, hz: 0, latencyMs: null }]);
    expect(canvas.dataset['frames']).toBe('1');
  });

  it('decodes one at a time, and of the waiting ones only the newest', async () => {
    const { decoding, drawImage } = begin();
    for (const t of [1, 2, 3]) frames.publish(frame(t));
    expect(decoding).toHaveLength(1);
    await decoding[0]!.done();
    expect(decoding).toHaveLength(2);
    await decoding[1]!.done();
    expect(decoding).toHaveLength(2);
    expect(drawImage).toHaveBeenCalledTimes(2);
    frames.publish(frame(4));
    expect(decoding).toHaveLength(3);
  });

  it('leaves a damaged picture out', async () => {
    const { decoding, drawImage, shown } = begin();
    frames.publish(frame(1));
    await decoding[0]!.fail();
    expect(shown).toEqual([]);
    frames.publish(frame(2));
    await decoding[1]!.done();
    expect(drawImage).toHaveBeenCalledOnce();
  });

  it('reports the rate and the age once a second', async () => {
    const { decoding, shown, now } = begin();
    const draw = async (t: number, at: number, world: number) => {
      frames.publish(frame(t));
      useSessionStore.setState({ simTime: world });
      now.mockReturnValue(at);
      await decoding.at(-1)!.done();
    };
    await draw(1, 100, 1);
    await draw(2, 600, 2.1);
    expect(shown).toHaveLength(1);
    await draw(3, 1100, 3.3);
    expect(shown[1]).toEqual({ width: 320, height: 240, hz: 2, latencyMs: expect.closeTo(200) as number });
    await draw(4, 1600, 3);
    await draw(5, 2600, 5);
    expect(shown[2]?.hz).toBeCloseTo(2 / 1.5);
    expect(shown[2]?.latencyMs).toBe(0);
  });

  it('draws nothing after its end', async () => {
    const { decoding, drawImage, stop } = begin();
    frames.publish(frame(1));
    frames.publish(frame(2));
    stop();
    frames.publish(frame(3));
    await decoding[0]!.done();
    expect(decoding).toHaveLength(1);
    expect(drawImage).toHaveBeenCalledOnce();
  });

  it('draws nothing if the browser has no canvas', () => {
    const { decoding } = begin();
    const canvas = document.createElement('canvas');
    onTestFinished(drawPictures('view', canvas, () => undefined));
    frames.publish({ type: 'view', t: 1, width: 1, height: 1, jpeg: new Uint8Array() });
    expect(decoding).toEqual([]);
  });
});
