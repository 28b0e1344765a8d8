import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { streams } from '@/store/session/streams';
import { show } from '../../../harness/testing';
import { CameraPanel } from './CameraPanel';

const announced = vi.fn();

beforeEach(() => {
  streams.connect(announced);
  announced.mockClear();
  onTestFinished(() => streams.disconnect());
});

describe('CameraPanel', () => {
  it("wants the camera's picture while it can be seen", () => {
    const { unmount } = show(<CameraPanel />);
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 15 });
    expect(screen.getByTestId('viewer-camera')).toHaveTextContent(
      "The robot's camera picture appears here when you run.",
    );
    unmount();
    expect(announced).toHaveBeenLastCalledWith('camera', null);
  });
});
