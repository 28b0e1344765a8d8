import { act, screen } from '@testing-library/react';
import { beforeEach, expect, it, vi } from 'vitest';
import { useLiveStore } from '@/store/project/live';
import { forgetEditor, showInFlow } from '../../../../harness/canvas';
import { TinyPicture } from './TinyPicture';
import { drawTiny } from './tinyTree';

vi.mock('./tinyTree', async (load) => ({ ...(await load<object>()), drawTiny: vi.fn() }));

const none = new Map();
let frames: FrameRequestCallback[] = [];
const nextFrame = () => act(() => frames.splice(0).forEach((draw) => draw(0)));

beforeEach(() => {
  forgetEditor();
  vi.mocked(drawTiny).mockClear();
  frames = [];
  vi.stubGlobal('requestAnimationFrame', (draw: FrameRequestCallback) => frames.push(draw));
  const context = { setTransform: vi.fn(), clearRect: vi.fn() };
  vi.spyOn(HTMLCanvasElement.prototype, 'getContext').mockReturnValue(context as never);
});

it('is drawn once a frame when statuses changed, and is hidden from screen readers', () => {
  showInFlow(<TinyPicture nodes={[]} edges={[]} marks={none} />);
  expect(screen.getByTestId('tiny-picture')).toHaveAttribute('aria-hidden', 'true');
  nextFrame();
  expect(drawTiny).toHaveBeenCalledTimes(1);
  for (const status of ['RUNNING', 'SUCCESS'] as const)
    act(() => useLiveStore.setState({ statuses: new Map([['Main/a', status]]) }));
  expect(drawTiny).toHaveBeenCalledTimes(1);
  nextFrame();
  expect(drawTiny).toHaveBeenCalledTimes(2);
  const [, { statusOf }] = vi.mocked(drawTiny).mock.lastCall!;
  expect(statusOf('Main/a').status).toBe('SUCCESS');
});
