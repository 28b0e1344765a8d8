/** Draws the world in a worker, so that the page stays responsive. */
import { Drawing } from './Drawing';
import type { ToWorker } from './messages';

const drawing = new Drawing((message) => (self as unknown as Worker).postMessage(message));

export const receive = ({ data }: Pick<MessageEvent<ToWorker>, 'data'>): void => drawing.receive(data);

self.onmessage = receive;
