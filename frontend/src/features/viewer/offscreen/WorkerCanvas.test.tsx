import { screen } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import { pretendWebGl } from '../../../../harness/scene';
import { show } from '../../../../harness/testing';
import { loadViewOptions } from '../viewOptions';
import type { View } from './messages';
import { WorkerCanvas } from './WorkerCanvas';

pretendWebGl('NVIDIA');

const sent = vi.fn<(message: { kind: string }) => void>();
const ended = vi.fn();

beforeEach(() => {
  sent.mockClear();
  ended.mockClear();
  HTMLCanvasElement.prototype.transferControlToOffscreen = () => ({}) as OffscreenCanvas;
  vi.stubGlobal(
    'Worker',
    class {
      postMessage = sent;
      terminate = ended;
    },
  );
  onTestFinished(() => {
    vi.unstubAllGlobals();
    Reflect.deleteProperty(HTMLCanvasElement.prototype, 'transferControlToOffscreen');
  });
});

it('has a worker that draws what is shown, as long as it is there', () => {
  const view: View = {
    options: loadViewOptions(),
    ...{ isDark: false, isVisible: true, isJudged: true, canMove: false },
    measuring: { isOn: false, points: [] },
  };
  const element = (isDark: boolean) => (
    <WorkerCanvas
      view={{ ...view, isDark }}
      label="The world"
      onTurned={vi.fn()}
      onSlow={vi.fn()}
      onDrawn={vi.fn()}
      onFailed={vi.fn()}
    />
  );
  const { rerender, unmount } = show(element(false));
  expect(screen.getByRole('img', { name: 'The world' }).querySelector('canvas')).toBeInTheDocument();
  rerender(element(true));
  expect(sent).toHaveBeenLastCalledWith(
    expect.objectContaining({ kind: 'view', view: { ...view, isDark: true } }),
    [],
  );
  unmount();
  expect(ended).toHaveBeenCalledOnce();
});
