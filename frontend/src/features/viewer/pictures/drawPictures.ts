import type { Camera, View } from '@/generated/messages';
import { frames, shownFrames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';

export interface Shown {
  width: number;
  height: number;
  hz: number;
  /** The age of pictures when they are drawn, in simulated ms; null during the first second of measuring. */
  latencyMs: number | null;
}

/** Returns the age in s of a picture of simulated time `t`, according to the newest message. */
const ageOf = (t: number): number =>
  Math.max(0, Math.max(frames.newest(), useSessionStore.getState().simTime) - t);

/**
 * Draws the pictures of a stream, or of one camera, on a canvas. While one picture is decoded, only the
 * newest of the next ones waits. Returns a function that stops it.
 */
export function drawPictures(
  stream: 'camera' | 'view',
  canvas: HTMLCanvasElement,
  onShown: (shown: Shown) => void,
  sensor: string | null = null,
): () => void {
  const context = canvas.getContext('2d');
  let waiting: Camera | View | null = null;
  let isDecoding = false;
  let isStopped = false;
  let count = 0;
  let since = performance.now();
  let age = 0;
  delete canvas.dataset['frames'];

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
      // Recorded pictures know their size only from the JPEG.
      measure(frame, { width: canvas.width, height: canvas.height });
    } catch {
      // A damaged picture is skipped, since the next one comes soon.
    }
    void drawNext();
  };

  const measure = (frame: Camera | View, size: Pick<Shown, 'width' | 'height'>) => {
    const isFirst = canvas.dataset['frames'] === undefined;
    canvas.dataset['frames'] = String(Number(canvas.dataset['frames'] ?? 0) + 1);
    count += 1;
    age += ageOf(frame.t);
    const now = performance.now();
    if (!isFirst && now - since < 1000) return;
    const hz = (count * 1000) / Math.max(now - since, 1);
    onShown(isFirst ? { ...size, hz: 0, latencyMs: null } : { ...size, hz, latencyMs: (age / count) * 1000 });
    count = 0;
    age = 0;
    since = now;
  };

  const stop = shownFrames.listen(stream, (frame) => {
    if (sensor !== null && frame.type === 'camera' && frame.sensor !== sensor) return;
    waiting = frame;
    if (!isDecoding) void drawNext();
  });
  return () => {
    isStopped = true;
    stop();
  };
}
