import { expect, it, onTestFinished, vi } from 'vitest';
import { Trace, trace } from '@/store/session/trace/trace';
import * as looking from './looking';
import { followShownTrace, shownTrace, useShownTrace } from './shownTrace';

const node = {
  ...{ uid: 1, parent: 0, type: 'Sequence', kind: 'Control', name: 'root', path: 'root' },
  ...{ node_id: '', tree_id: '' },
};

it('is that of an open run while that is followed, with ids for the blocks of a log', () => {
  let told: Parameters<typeof looking.followTimeline>[0] = () => undefined;
  const stop = vi.fn();
  vi.spyOn(looking, 'followTimeline').mockImplementation((tell) => {
    told = tell;
    tell(null, true);
    return stop;
  });
  const end = followShownTrace();
  onTestFinished(end);
  expect(shownTrace()).toBe(trace);
  told(null, false);
  expect(shownTrace().nodes).toEqual([]);
  expect(shownTrace()).not.toBe(trace);

  const read = new Trace();
  read.start([node], 0);
  read.tick([[1, 'RUNNING']], [], 1);
  read.advance(700);
  told({ nodes: [node], now: 700, text: read.keep() }, false);
  expect(shownTrace().stretches(1, 0, 1000)).toEqual([{ start: 1, end: 700, mask: 1 }]);
  expect(useShownTrace.getState().nodes).toMatchObject([{ uid: 1, node_id: 'n1', tree_id: 'recorded' }]);
  told(null, true);
  expect(shownTrace()).toBe(trace);
  told({ nodes: [node], now: 700, text: read.keep() }, false);
  end();
  expect(stop).toHaveBeenCalled();
  expect(shownTrace()).toBe(trace);
});
