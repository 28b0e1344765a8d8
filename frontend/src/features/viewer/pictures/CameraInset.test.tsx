import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { streams } from '@/store/session/streams';
import { show } from '../../../../harness/testing';
import { CameraInset } from './CameraInset';

const announced = vi.fn();

beforeEach(() => {
  streams.connect(announced);
  announced.mockClear();
  onTestFinished(() => streams.disconnect());
});

describe('CameraInset', () => {
  it('subscribes to small pictures while the view is visible', () => {
    const { rerender } = show(<CameraInset isVisible />);
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 10, width: 320 });
    expect(screen.getByTestId('camera-inset')).toHaveTextContent("The camera's picture…");
    rerender(<CameraInset isVisible={false} />);
    expect(announced).toHaveBeenLastCalledWith('camera', null);
  });
});
