import { PROTOCOL, type StreamName, type Subscribe } from '@/generated/messages';
import { frames } from './frames';
import type { FromWorker, ToWorker } from './stream.worker';

export type StreamOptions = Omit<Subscribe, 'stream'>;

interface Want {
  stream: StreamName;
  options: StreamOptions;
}

export interface StreamHandle {
  update: (options: StreamOptions) => void;
  release: () => void;
}

type SendSubscription = (stream: StreamName, options: StreamOptions | null) => void;

const REOPEN_AFTER_MS = 1000;

/**
 * The stream socket and the subscriptions of the page. Several views can want a stream; the last options
 * apply.
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

  /** Sends all present subscriptions, and from now on each change. */
  connect(send: SendSubscription): void {
    this.send = send;
    for (const stream of new Set(this.wants.map((want) => want.stream))) this.announce(stream);
  }

  disconnect(): void {
    this.send = null;
  }

  want(stream: StreamName, options: StreamOptions): StreamHandle {
    const want: Want = { stream, options };
    this.wants.push(want);
    this.announce(stream);
    return {
      update: (changed) => {
        want.options = changed;
        this.announce(stream);
      },
      release: () => {
        this.wants = this.wants.filter((other) => other !== want);
        this.announce(stream);
      },
    };
  }

  private announce(stream: StreamName): void {
    const last = this.wants.findLast((want) => want.stream === stream);
    this.send?.(stream, last?.options ?? null);
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

// The status bar shows the robot's measured speed whichever view is open.
streams.want('poses', { max_hz: 10 });
