import { beforeEach, expect, it } from 'vitest';
import { fakeServer } from '../../../harness/testing';
import { isLog, openNewLog } from './openNewLog';

const t = ((key: string) => key) as unknown as Parameters<typeof openNewLog>[1];

beforeEach(() => window.history.pushState(null, '', '/'));

it('knows the endings of logs', () => {
  const names = ['a.mcap', 'A.BTLOG', 'b.db3', 'b.btdb', 'tree.xml', 'mcap'];
  expect(names.filter((name) => isLog(new File([], name)))).toEqual(names.slice(0, 4));
});

it('goes to the run in the new project', async () => {
  fakeServer({ 'POST /runs/logs?filename=patrol.btlog': { id: 'r1', project: 'p7' } });
  await openNewLog(new File(['log'], 'patrol.btlog'), t);
  expect(window.location.pathname + window.location.search).toBe('/projects/p7?run=r1');
});
