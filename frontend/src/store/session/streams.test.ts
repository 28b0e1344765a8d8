import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { streams } from './streams';

const announced = vi.fn();

beforeEach(() => {
  streams.connect(announced);
  announced.mockClear();
  onTestFinished(() => streams.disconnect());
});

describe('the subscriptions of the page', () => {
  it('are one for all views of a camera, with the highest rate and width', () => {
    const inset = streams.want('camera', { max_hz: 10, width: 320 });
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 10, width: 320 });
    const panel = streams.want('camera', { max_hz: 15 });
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 15 });
    const small = streams.want('camera', { max_hz: 5, width: 160 });
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 15 });
    panel.release();
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 10, width: 320 });
    inset.release();
    small.release();
    expect(announced).toHaveBeenLastCalledWith('camera', null);
  });

  it('are one for each camera, and end with its last view', () => {
    const first = streams.want('camera', { max_hz: 15 });
    const rear = streams.want('camera', { max_hz: 15 }, 'rear');
    const again = streams.want('camera', { max_hz: 20 }, 'rear');
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 20 }, 'rear');
    again.release();
    expect(announced).toHaveBeenLastCalledWith('camera', { max_hz: 15 }, 'rear');
    rear.release();
    expect(announced).toHaveBeenLastCalledWith('camera', null, 'rear');
    first.release();
    expect(announced).toHaveBeenLastCalledWith('camera', null);
  });

  it('are all sent to a new session', () => {
    const wants = [streams.want('camera', { max_hz: 15 }), streams.want('camera', { max_hz: 5 }, 'rear')];
    announced.mockClear();
    streams.connect(announced);
    const cameras = announced.mock.calls.filter(([stream]) => stream === 'camera');
    expect(cameras).toEqual([
      ['camera', { max_hz: 15 }],
      ['camera', { max_hz: 5 }, 'rear'],
    ]);
    wants.forEach((want) => want.release());
  });
});
