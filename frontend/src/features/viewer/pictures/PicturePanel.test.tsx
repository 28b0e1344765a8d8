import { act, screen } from '@testing-library/react';
import { createRef } from 'react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import type { State } from '@/generated/messages';
import { show } from '../../../../harness/testing';
import { PicturePanel } from './PicturePanel';

const none = HTMLCanvasElement.prototype.getContext;

/** Pictures are decoded and drawn at once. */
beforeEach(() => {
  frames.clear();
  vi.stubGlobal('createImageBitmap', () =>
    Promise.resolve({ width: 320, height: 240, close: () => undefined }),
  );
  Object.assign(HTMLCanvasElement.prototype, { getContext: () => ({ drawImage: () => undefined }) });
  onTestFinished(() => {
    HTMLCanvasElement.prototype.getContext = none;
    vi.unstubAllGlobals();
    useSessionStore.setState({ executor: 'idle', simTime: 0 });
  });
});

function panel(executor: State = 'application_running') {
  useSessionStore.setState({ executor });
  const canvas = createRef<HTMLCanvasElement>();
  show(
    <PicturePanel stream="camera" canvas={canvas} label="The camera" emptyText="Nothing yet">
      <p>above</p>
    </PicturePanel>,
  );
  return canvas.current!;
}

const publish = (t: number) =>
  act(async () => {
    frames.publish({
      type: 'camera',
      t,
      sensor: 'camera',
      width: 320,
      height: 240,
      jpeg: new Uint8Array([1]),
    });
    await vi.waitFor(() => expect(document.querySelector('canvas')?.dataset['frames']).toBeDefined());
  });

describe('PicturePanel', () => {
  it('explains what it waits for until the first picture', async () => {
    const canvas = panel();
    expect(screen.getByText('Nothing yet')).toBeInTheDocument();
    expect(canvas.hidden).toBe(true);
    expect(canvas).toHaveTextContent('The camera');
    expect(screen.getByText('above')).toBeInTheDocument();
    await publish(1);
    expect(screen.queryByText('Nothing yet')).toBeNull();
    expect(canvas.hidden).toBe(false);
    expect(screen.getByTestId('camera-figures')).toHaveTextContent(/^320 × 240$/);
  });

  it('shows the rate and the age of pictures', async () => {
    const canvas = panel();
    const now = vi.spyOn(performance, 'now').mockReturnValue(0);
    await publish(1);
    now.mockReturnValue(1000);
    useSessionStore.setState({ simTime: 2.05 });
    await act(async () => {
      frames.publish({
        type: 'camera',
        t: 2,
        sensor: 'camera',
        width: 320,
        height: 240,
        jpeg: new Uint8Array([1]),
      });
      await vi.waitFor(() => expect(canvas.dataset['frames']).toBe('2'));
    });
    expect(screen.getByTestId('camera-figures')).toHaveTextContent('320 × 240 · 1.0 Hz · 50 ms late');
  });

  it.each(['idle', 'connected', 'universe_ready'] as const)(
    'shows no picture in the state %s',
    async (state) => {
      panel();
      await publish(1);
      act(() => useSessionStore.setState({ executor: state }));
      expect(screen.getByText('Nothing yet')).toBeInTheDocument();
      expect(screen.queryByTestId('camera-figures')).toBeNull();
    },
  );
});
