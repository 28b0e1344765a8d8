import { expect, it, onTestFinished } from 'vitest';
import type * as worker from './drawingWorker';
import { pretendWebGl } from '../../../../harness/scene';
import { currentPoses } from '@/store/session/poses';

pretendWebGl('NVIDIA');

it('passes what the page sends to the drawing', async () => {
  const { receive } = (await import('./drawingWorker')) as typeof worker;
  onTestFinished(() => {
    self.onmessage = null;
    currentPoses.clear();
  });
  expect(self.onmessage).toBe(receive);
  receive({ data: { kind: 'past', poses: [[7, [1, 2, 3, 0, 0, 0, 1]]], trail: '' } });
  expect(currentPoses.get(7)).toEqual([1, 2, 3, 0, 0, 0, 1]);
});
