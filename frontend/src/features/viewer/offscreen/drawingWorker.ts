/** Draws the world beside the page, so that the editor stays quick. */
import { Drawing } from './Drawing';
import type { ToWorker } from './messages';

const page = self as unknown as Worker;
const drawing = new Drawing((message) => page.postMessage(message));

self.onmessage = ({ data }: MessageEvent<ToWorker>) => drawing.receive(data);
