/** Owns the stream socket. MessagePack is decoded in this worker, not on the page's main thread. */
import { decode } from '@msgpack/msgpack';
import type { Frame } from '@/generated/messages';

export type ToWorker = { open: string; protocol: string } | { close: true };
export type FromWorker = { frame: Frame } | { closed: number } | { opened: true };

let socket: WebSocket | null = null;

const post = (message: FromWorker, transfer: Transferable[] = []) =>
  (self as unknown as Worker).postMessage(message, transfer);

/** Gives each byte field a buffer of its own, so that the buffer is moved to the page and not copied. */
function ownBuffers(frame: Frame): Transferable[] {
  const buffers: Transferable[] = [];
  const fields = frame as unknown as Record<string, unknown>;
  for (const [key, value] of Object.entries(fields)) {
    if (!(value instanceof Uint8Array)) continue;
    const own = value.slice();
    fields[key] = own;
    buffers.push(own.buffer);
  }
  return buffers;
}

function open(url: string, protocol: string): void {
  socket?.close(1000);
  const opened = new WebSocket(url, protocol);
  socket = opened;
  opened.binaryType = 'arraybuffer';
  opened.onopen = () => post({ opened: true });
  opened.onmessage = ({ data }) => {
    const frame = decode(new Uint8Array(data as ArrayBuffer)) as Frame;
    post({ frame }, ownBuffers(frame));
  };
  opened.onclose = ({ code }) => {
    if (socket === opened) post({ closed: code });
  };
}

self.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ('open' in data) return open(data.open, data.protocol);
  const closing = socket;
  socket = null;
  closing?.close(1000);
};
