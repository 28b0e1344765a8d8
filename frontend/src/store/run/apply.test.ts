import { expect, it } from 'vitest';
import type { Applied } from '@/generated/messages';
import { useSessionStore } from '@/store/session/store';
import { agreesTo, asksFirst, nextPlan, useApplyQuestion } from './apply';

const plan = (more: Partial<Applied>): Applied => ({
  dry: true,
  kept: 3,
  renewed: [],
  added: [],
  removed: [],
  halted: [],
  late_ports: [],
  ...more,
});
const node = { path: 'Drive', node_id: 'd', tree_id: 'Main' };

it('asks only before something is halted or keeps an old text', async () => {
  expect(asksFirst(plan({ added: [node], removed: [node], renewed: [node] }))).toBe(false);
  expect(asksFirst(plan({ late_ports: [{ ...node, port: 'speed' }] }))).toBe(true);
  expect(await agreesTo(plan({ added: [node] }))).toBe(true);
  expect(useApplyQuestion.getState().plan).toBeNull();
});

it.each([true, false])('waits for the answer %s', async (agrees) => {
  const asked = agreesTo(plan({ halted: [node] }));
  expect(useApplyQuestion.getState().plan?.halted).toEqual([node]);
  useApplyQuestion.getState().answer(agrees);
  expect(await asked).toBe(agrees);
  expect(useApplyQuestion.getState().plan).toBeNull();
});

it('takes the next plan, not the last one', async () => {
  useSessionStore.setState({ applied: plan({ kept: 1 }) });
  const next = nextPlan();
  useSessionStore.setState({ simTime: 3 });
  useSessionStore.setState({ applied: plan({ kept: 2 }) });
  expect((await next).kept).toBe(2);
});

it('asks no more once the program or the session has ended', async () => {
  useSessionStore.setState({ executor: 'paused' });
  const asked = agreesTo(plan({ halted: [node] }));
  useSessionStore.setState({ simTime: 4 });
  expect(useApplyQuestion.getState().plan?.halted).toEqual([node]);
  useSessionStore.setState({ executor: 'idle' });
  expect(await asked).toBe(false);
  expect(useApplyQuestion.getState().plan).toBeNull();
});
