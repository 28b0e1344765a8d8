import type { Frame, RecordingPart, Scene } from '@/generated/messages';

type FrameOf<K extends Frame['type']> = Extract<Frame, { type: K }>;
type Listener = (frame: Frame) => void;
/** A frame that shows the present; parts of a recording are answers, and are not stored. */
type StreamFrame = Exclude<Frame, RecordingPart>;

/** Returns the key of a frame; a newer frame of the same kind, and of the same camera, replaces it. */
const keyOf = (frame: StreamFrame): string =>
  frame.type === 'camera' ? `camera/${frame.sensor}` : frame.type;

/**
 * Distributes frames outside of React, so that each viewer draws at its own rate. The last frame of each kind
 * is stored for views that open later; a new scene drops older poses.
 */
class FrameBus {
  private readonly listeners = new Map<string, Set<Listener>>();
  private readonly latest = new Map<string, StreamFrame>();

  publish(frame: Frame): void {
    if (frame.type === 'scene') this.latest.clear();
    if (frame.type !== 'recording') this.latest.set(keyOf(frame), frame);
    this.listeners.get(frame.type)?.forEach((listener) => listener(frame));
  }

  /**
   * Calls the listener at once with the stored frame (of each camera, for camera frames), and then with each
   * new frame; returns a function that stops it.
   */
  listen<K extends Frame['type']>(kind: K, listener: (frame: FrameOf<K>) => void): () => void {
    const set = this.listeners.get(kind) ?? new Set();
    this.listeners.set(kind, set);
    set.add(listener as Listener);
    for (const last of this.latest.values()) if (last.type === kind) (listener as Listener)(last);
    return () => set.delete(listener as Listener);
  }

  /** Returns the last frame of each kind and camera. */
  last(): readonly StreamFrame[] {
    return [...this.latest.values()];
  }

  scene(): Scene | null {
    return (this.latest.get('scene') as Scene | undefined) ?? null;
  }

  /** Returns the latest simulated time of all streams, in s. */
  newest(): number {
    return Math.max(0, ...[...this.latest.values()].map(({ t }) => t));
  }

  clear(): void {
    this.latest.clear();
  }
}

export const frames = new FrameBus();

/** The kinds of frames that a moment of a recording replaces. */
const RECORDED: readonly Frame['type'][] = ['poses', 'scan', 'camera'];

/** Distributes the frames that the views show: those of the present, or of the moment that the user looks at. */
class ShownFrames {
  private past: readonly StreamFrame[] | null = null;
  /** The world of the past, if it is not the present one. */
  private recorded: Scene | null = null;
  private readonly listeners = new Set<{ kind: Frame['type']; listener: Listener }>();

  /** As `FrameBus.listen`. */
  listen<K extends Frame['type']>(kind: K, listener: (frame: FrameOf<K>) => void): () => void {
    const own = { kind, listener: listener as Listener };
    this.listeners.add(own);
    const stop = frames.listen(kind, (frame) => {
      if (!this.isHeld(kind)) listener(frame);
    });
    for (const frame of this.past ?? []) if (frame.type === kind) own.listener(frame);
    return () => {
      this.listeners.delete(own);
      stop();
    };
  }

  /** Shows recorded frames in place of those of the present; `recorded` is their world, if it is another one. */
  hold(past: readonly StreamFrame[], recorded: Scene | null = null): void {
    const isNew = recorded !== this.recorded;
    this.recorded = recorded;
    this.past = recorded ? [recorded, ...past] : past;
    const scene = isNew ? this.scene() : null;
    this.tell(scene ? [scene, ...past] : past);
  }

  /** Returns the world that the views show. */
  scene(): Scene | null {
    return this.recorded ?? frames.scene();
  }

  /** Shows the present again; it is given with all poses, since a frame has only those that changed. */
  letGo(poses: StreamFrame): void {
    if (this.past === null) return;
    const present = this.recorded ? frames.scene() : null;
    this.past = null;
    this.recorded = null;
    this.tell([
      ...(present ? [present] : []),
      poses,
      ...frames.last().filter(({ type }) => type === 'scan' || type === 'camera'),
    ]);
  }

  private isHeld(kind: Frame['type']): boolean {
    return this.past !== null && (RECORDED.includes(kind) || (kind === 'scene' && this.recorded !== null));
  }

  private tell(shown: readonly StreamFrame[]): void {
    for (const frame of shown)
      for (const { kind, listener } of this.listeners) if (kind === frame.type) listener(frame);
  }
}

export const shownFrames = new ShownFrames();

/** Returns a binary field as floats; copies the bytes only if they are not aligned to four. */
export function floatsOf(bytes: Uint8Array): Float32Array {
  const aligned = bytes.byteOffset % 4 === 0 ? bytes : bytes.slice();
  return new Float32Array(aligned.buffer, aligned.byteOffset, aligned.byteLength >> 2);
}

export function uint16Of(bytes: Uint8Array): Uint16Array {
  const aligned = bytes.byteOffset % 2 === 0 ? bytes : bytes.slice();
  return new Uint16Array(aligned.buffer, aligned.byteOffset, aligned.byteLength >> 1);
}

export function uint32Of(bytes: Uint8Array): Uint32Array {
  const aligned = bytes.byteOffset % 4 === 0 ? bytes : bytes.slice();
  return new Uint32Array(aligned.buffer, aligned.byteOffset, aligned.byteLength >> 2);
}
