/** Unpacks and indexes a recording beside the page's main thread. */
import { Engine, type ToEngine } from './engine';

const engine = new Engine((message) => (self as unknown as Worker).postMessage(message));

self.onmessage = ({ data }: MessageEvent<ToEngine>) => engine.receive(data);
