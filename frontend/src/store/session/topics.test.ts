import { beforeEach, describe, expect, it } from 'vitest';
import type { ServerMessage } from '@/generated/messages';
import { fieldsOf, numberAt } from './fields';
import { addEcho, dropEcho, feedTopics, MAX_SAMPLES, seriesOf, togglePlot, useTopicsStore } from './topics';

const said = (x: number | null, t: number): ServerMessage => ({
  id: 's1',
  command: 'topic_message',
  data: {
    topic: '/odom',
    type: 'nav_msgs/msg/Odometry',
    message: { pose: { x }, ranges: [1, 2] },
    bytes: 10,
    cut: {},
  },
  seq: 1,
  t,
});

beforeEach(() => {
  dropEcho('/odom');
  useTopicsStore.setState({ echoes: {}, plotted: [] });
});

describe('fields', () => {
  it('finds numbers by path, booleans as 0 and 1, and nothing else', () => {
    const message = { a: { b: [{ c: 2.5 }] }, on: true, name: 'x', none: null };
    expect(numberAt(message, 'a.b[0].c')).toBe(2.5);
    expect(numberAt(message, 'on')).toBe(1);
    for (const path of ['name', 'none', 'a.b[7].c', 'missing.x']) expect(numberAt(message, path)).toBeNull();
  });

  it('lists rows in order and leaves out what is folded', () => {
    const rows = fieldsOf({ header: { stamp: 1 }, x: [3, 4] }, (path) => path === 'header');
    expect(rows.map(({ path, depth }) => [path, depth])).toEqual([
      ['header', 0],
      ['x', 0],
      ['x[0]', 1],
      ['x[1]', 1],
    ]);
  });
});

describe('topics', () => {
  it('stores the echoed topics, and samples the plotted fields', () => {
    feedTopics(said(1, 1));
    expect(useTopicsStore.getState().echoes).toEqual({});
    addEcho('/odom');
    feedTopics(said(1, 1));
    togglePlot('/odom', 'pose.x');
    feedTopics(said(2, 1.1));
    feedTopics(said(null, 1.2));
    expect(seriesOf('/odom', 'pose.x')).toMatchObject({ times: [1, 1.1, 1.2], values: [1, 2, null] });
    expect(useTopicsStore.getState().echoes['/odom']).toMatchObject({ count: 3, last: { t: 1.2 } });
  });

  it('bounds the samples, and restarts when time goes back', () => {
    addEcho('/odom');
    feedTopics(said(0, 0));
    togglePlot('/odom', 'pose.x');
    for (let i = 1; i <= MAX_SAMPLES * 2; i++) feedTopics(said(i, i));
    expect(seriesOf('/odom', 'pose.x').times.length).toBeLessThanOrEqual(MAX_SAMPLES);
    feedTopics(said(5, 0.5));
    expect(seriesOf('/odom', 'pose.x').times).toEqual([0.5]);
  });
});
