import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import { streams } from '@/store/session/streams';
import { show, user } from '../../../../harness/testing';
import { CameraPanel } from './CameraPanel';

const announced = vi.fn();

beforeEach(() => {
  streams.connect(announced);
  announced.mockClear();
  onTestFinished(() => {
    streams.disconnect();
    frames.clear();
    useSessionStore.setState({ executor: 'idle' });
  });
});

function worldWith(...cameras: string[]) {
  const sensors = cameras.map((name) => ({ name, kind: 'camera', object_id: 1 }));
  const scene = { type: 'scene', t: 0, objects: [{ id: 1, body: 'robot', kind: 'robot' }], sensors };
  act(() => {
    useSessionStore.setState({ executor: 'application_running' });
    frames.publish(scene as unknown as Scene);
  });
}

const isShown = () => screen.getByTestId('viewer-camera').dataset['camera'];

describe('CameraPanel', () => {
  it("subscribes to the camera's pictures while it is visible", () => {
    const { unmount } = show(<CameraPanel />);
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 15 });
    expect(screen.getByTestId('viewer-camera')).toHaveTextContent(
      "The robot's camera picture appears here when you run.",
    );
    unmount();
    expect(announced).toHaveBeenLastCalledWith('camera', null);
  });

  it('names its camera, without a choice for a single one', () => {
    show(<CameraPanel />);
    worldWith('front');
    expect(screen.getByText('front')).toBeInTheDocument();
    expect(screen.queryByRole('combobox')).toBeNull();
    expect(screen.getByText('What the camera front sees')).toBeInTheDocument();
  });

  it('shows another camera when it is chosen, and ends the previous stream', async () => {
    const onChoose = vi.fn();
    show(<CameraPanel onChoose={onChoose} />);
    worldWith('front', 'rear');
    await user.selectOptions(screen.getByRole('combobox', { name: 'Camera of this view' }), 'rear');
    expect(onChoose).toHaveBeenCalledWith('rear');
    expect(isShown()).toBe('rear');
    expect(announced.mock.calls.slice(-2)).toEqual([
      ['camera', null],
      ['camera', { max_hz: 15 }, 'rear'],
    ]);
  });

  it('shows the first camera if the world lacks the chosen one, and the chosen one in the next', () => {
    show(<CameraPanel chosen="rear" />);
    worldWith('front');
    expect(isShown()).toBe('front');
    worldWith('front', 'rear');
    expect(isShown()).toBe('rear');
  });

  it('opens another view, of the next camera', async () => {
    const onAnother = vi.fn();
    show(<CameraPanel chosen="front" onAnother={onAnother} />);
    worldWith('front', 'rear');
    await user.click(screen.getByRole('button', { name: 'Open one more camera view' }));
    expect(onAnother).toHaveBeenCalledWith('rear');
  });
});
