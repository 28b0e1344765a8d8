import { screen } from '@testing-library/react';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { streams, type StreamOptions } from '@/store/session/streams';
import { show, user } from '../../../harness/testing';
import { useStream } from './useStream';

const announced = vi.fn();

function Wants({ isWanted, options }: { readonly isWanted: boolean; readonly options: StreamOptions }) {
  const handle = useStream('camera', isWanted, options);
  return <button onClick={() => handle.current?.update({ max_hz: 1 })}>slower</button>;
}

const POSE = { eye: [1, 0, 0], target: [0, 0, 0] } satisfies NonNullable<StreamOptions['camera_pose']>;
const last = () => announced.mock.lastCall;

beforeEach(() => {
  streams.connect(announced);
  announced.mockClear();
});
afterEach(() => streams.disconnect());

describe('useStream', () => {
  it('subscribes to the stream as long as it is wanted', () => {
    const { rerender, unmount } = show(<Wants isWanted={false} options={{ max_hz: 5 }} />);
    expect(announced).not.toHaveBeenCalled();
    rerender(<Wants isWanted options={{ max_hz: 5 }} />);
    expect(last()).toEqual(['camera', { max_hz: 5 }]);
    rerender(<Wants isWanted={false} options={{ max_hz: 5 }} />);
    expect(last()).toEqual(['camera', null]);
    rerender(<Wants isWanted options={{ max_hz: 5 }} />);
    unmount();
    expect(last()).toEqual(['camera', null]);
  });

  it('subscribes again for another rate or width, and keeps the direction of the camera', () => {
    const { rerender } = show(<Wants isWanted options={{ max_hz: 5, camera_pose: POSE }} />);
    rerender(<Wants isWanted options={{ max_hz: 5, camera_pose: { ...POSE } }} />);
    expect(announced).toHaveBeenCalledOnce();
    rerender(<Wants isWanted options={{ max_hz: 9, width: 320 }} />);
    expect(last()).toEqual(['camera', { max_hz: 9, width: 320, camera_pose: POSE }]);
  });

  it('lets its options be changed while it is subscribed', async () => {
    const { rerender } = show(<Wants isWanted options={{ max_hz: 5 }} />);
    await user.click(screen.getByRole('button'));
    expect(last()).toEqual(['camera', { max_hz: 1 }]);
    rerender(<Wants isWanted={false} options={{ max_hz: 5 }} />);
    await user.click(screen.getByRole('button'));
    expect(last()).toEqual(['camera', null]);
  });
});
