/** Draws the world beside the page, so that the editor stays quick. */
import { Drawing } from './Drawing';
import type { ToWorker } from './messages';

const drawing = new Drawing((message) => (self as unknown as Worker).postMessage(message));

export const receive = ({ data }: Pick<MessageEvent<ToWorker>, 'data'>): void => drawing.receive(data);

self.onmessage = receive;
