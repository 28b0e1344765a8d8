import { PROTOCOL, type StreamName, type Subscribe } from '@/generated/messages';
import { frames } from './frames';
import type { FromWorker, ToWorker } from './stream.worker';

export type StreamOptions = Omit<Subscribe, 'stream' | 'sensor'>;

interface Want {
  stream: StreamName;
  /** The camera; undefined for the first one. */
  sensor: string | undefined;
  options: StreamOptions;
}

export interface StreamHandle {
  update: (options: StreamOptions) => void;
  release: () => void;
}

type SendSubscription = (stream: StreamName, options: StreamOptions | null, sensor?: string) => void;

/** Returns one subscription for all views of a stream: the highest rate and width that any view wants. */
function together(wants: readonly Want[]): StreamOptions | null {
  const last = wants.at(-1)?.options;
  if (!last) return null;
  const all = wants.map(({ options }) => options);
  const made: StreamOptions = { ...last };
  const rates = all.flatMap(({ max_hz }) => max_hz ?? []);
  if (rates.length > 0) made.max_hz = Math.max(...rates);
  const widths = all.flatMap(({ width }) => width ?? []);
  if (widths.length < all.length) delete made.width;
  else made.width = Math.max(...widths);
  return made;
}

const REOPEN_AFTER_MS = 1000;

/**
 * The stream socket, and the page's subscriptions. Several views can share a stream; each camera is a
 * separate stream.
 */
class Streams {
  private worker: Worker | null = null;
  private wants: Want[] = [];
  private send: SendSubscription | null = null;
  private url: string | null = null;

  open(url: string): void {
    this.url = url;
    this.worker ??= this.startWorker();
    this.post({ open: this.url, protocol: PROTOCOL });
  }

  close(): void {
    this.url = null;
    this.send = null;
    this.post({ close: true });
    frames.clear();
  }

  /** Sends all current subscriptions, and later each change. */
  connect(send: SendSubscription): void {
    this.send = send;
    const first = this.wants.filter((want) => this.wantsOf(want)[0] === want);
    for (const want of first) this.announce(want);
  }

  disconnect(): void {
    this.send = null;
  }

  want(stream: StreamName, options: StreamOptions, sensor?: string): StreamHandle {
    const want: Want = { stream, options, sensor };
    this.wants.push(want);
    this.announce(want);
    return {
      update: (changed) => {
        want.options = changed;
        this.announce(want);
      },
      release: () => {
        this.wants = this.wants.filter((other) => other !== want);
        this.announce(want);
      },
    };
  }

  private wantsOf({ stream, sensor }: Want): Want[] {
    return this.wants.filter((want) => want.stream === stream && want.sensor === sensor);
  }

  private announce(want: Want): void {
    const sensor = want.sensor === undefined ? [] : ([want.sensor] as const);
    this.send?.(want.stream, together(this.wantsOf(want)), ...sensor);
  }

  private post(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private startWorker(): Worker {
    const worker = new Worker(new URL('./stream.worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if ('frame' in data) frames.publish(data.frame);
      else if ('closed' in data) setTimeout(() => this.reopen(), REOPEN_AFTER_MS);
    };
    return worker;
  }

  private reopen(): void {
    if (this.url) this.post({ open: this.url, protocol: PROTOCOL });
  }
}

export const streams = new Streams();

// The status bar needs the robot's measured speed, whichever view is open.
streams.want('poses', { max_hz: 10 });
