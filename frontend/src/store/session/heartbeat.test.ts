import { describe, expect, it } from 'vitest';
import { Heartbeat } from './heartbeat';

/** Returns the displayed silence at each of these times, in s, while no answer comes. */
const silence = (heartbeat: Heartbeat, ...times: number[]) =>
  times.map((time) => heartbeat.beat(time * 1000));

describe('the heartbeat of a session', () => {
  it('shows nothing for a short silence, then its length', () => {
    expect(silence(new Heartbeat(0), 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, 5)).toEqual([
      0, 0, 0, 0, 0, 3, 4, 4, 5, 5,
    ]);
  });

  it('starts again with each message', () => {
    const heartbeat = new Heartbeat(0);
    expect(silence(heartbeat, 0.5, 1, 1.5, 2, 2.5, 3).at(-1)).toBe(3);
    heartbeat.heard(3100);
    expect(silence(heartbeat, 3.5, 4, 4.5, 5, 5.5, 6)).toEqual([0, 0, 0, 0, 0, 0]);
  });

  it('counts the whole time in a slow page, one beat later', () => {
    expect(silence(new Heartbeat(0), 2, 4, 6)).toEqual([0, 0, 5]);
  });

  it('gives messages that came while the page was busy one beat to be read', () => {
    const heartbeat = new Heartbeat(0);
    expect(silence(heartbeat, 8)).toEqual([0]);
    heartbeat.heard(8010);
    expect(silence(heartbeat, 8.5, 9)).toEqual([0, 0]);
  });

  it('does not count the time in which the page was suspended', () => {
    expect(silence(new Heartbeat(0), 3600, 3600.5, 3601, 3601.5, 3602)).toEqual([0, 0, 0, 0, 0]);
  });
});
