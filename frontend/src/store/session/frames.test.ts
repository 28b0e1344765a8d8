import { expect, it, onTestFinished } from 'vitest';
import { frames } from './frames';

it('keeps the last picture of each camera for views that open later', () => {
  onTestFinished(() => frames.clear());
  const picture = (sensor: string, t: number) =>
    frames.publish({ type: 'camera', t, sensor, width: 1, height: 1, jpeg: new Uint8Array() });
  picture('front', 1);
  picture('rear', 2);
  picture('front', 3);
  const heard: string[] = [];
  const stop = frames.listen('camera', ({ sensor, t }) => heard.push(`${sensor} ${t}`));
  expect(heard.sort()).toEqual(['front 3', 'rear 2']);
  stop();
  picture('rear', 4);
  expect(heard).toHaveLength(2);
  expect(frames.newest()).toBe(4);
});
