import type { Camera, View } from '@/generated/messages';
import { frames } from '@/store/session/frames';

interface Shown {
  width: number;
  height: number;
  hz: number;
}

/** Draws the pictures of a stream on a canvas. While one is decoded, only the newest waits. */
export function drawPictures(
  stream: 'camera' | 'view',
  canvas: HTMLCanvasElement,
  onShown: (shown: Shown) => void,
): () => void {
  const context = canvas.getContext('2d');
  let waiting: Camera | View | null = null;
  let isDecoding = false;
  let isStopped = false;
  let count = 0;
  let since = performance.now();
  let hz = 0;

  const drawNext = async () => {
    const frame = waiting;
    waiting = null;
    if (!frame || isStopped || !context) {
      isDecoding = false;
      return;
    }
    isDecoding = true;
    try {
      const jpeg = frame.jpeg as Uint8Array<ArrayBuffer>;
      const bitmap = await createImageBitmap(new Blob([jpeg], { type: 'image/jpeg' }));
      if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
      if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
      context.drawImage(bitmap, 0, 0);
      bitmap.close();
      measure(frame);
    } catch {
      // A damaged picture is left out; the next one comes soon.
    }
    void drawNext();
  };

  const measure = (frame: Camera | View) => {
    count += 1;
    canvas.dataset['frames'] = String(Number(canvas.dataset['frames'] ?? 0) + 1);
    const now = performance.now();
    if (now - since >= 1000 || canvas.dataset['frames'] === '1') {
      hz = (count * 1000) / Math.max(now - since, 1);
      onShown({ width: frame.width, height: frame.height, hz: canvas.dataset['frames'] === '1' ? 0 : hz });
      count = 0;
      since = now;
    }
  };

  const stop = frames.listen(stream, (frame) => {
    waiting = frame;
    if (!isDecoding) void drawNext();
  });
  return () => {
    isStopped = true;
    stop();
  };
}
