import { beforeEach, expect, it } from 'vitest';
import { oneBlock } from '@/store/testing';
import { openProject } from '../../../harness/testing';
import { useProjectStore } from '.';
import { isInsertedInto, planHere } from './bringing';

const TURN = 'actions/Turn.py';
const MAIN = 'trees/Main.json';

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence' } } },
    texts: { [TURN]: 'mine', 'actions/Turn2.py': 'mine too' },
  });
  useProjectStore.getState().setActiveTree('Main');
});

it('gives names that neither a file, a tree nor a type of the project has', () => {
  const plan = planHere({ needs: [TURN], sources: { [TURN]: 'theirs' } });
  expect(plan.places).toEqual({ [TURN]: 'actions/Turn3.py' });
});

it('lets the user choose otherwise, but not for the tree that is inserted into', () => {
  const sources = { [TURN]: 'theirs', [MAIN]: oneBlock('Main', 'AlwaysSuccess') };
  const plan = planHere({ needs: [TURN, MAIN], sources }, { [TURN]: 'keep', [MAIN]: 'replace' });
  expect(plan.arrivals.map(({ place, state }) => [place, state])).toEqual([
    [TURN, 'keep'],
    ['trees/Main2.json', 'rename'],
  ]);
  expect([isInsertedInto(MAIN), isInsertedInto(TURN)]).toEqual([true, false]);
});

it('takes even an equal tree under another name, since no tree contains itself', () => {
  const same = useProjectStore.getState().currentText(MAIN) ?? '';
  expect(planHere({ needs: [MAIN], sources: { [MAIN]: same } }).places[MAIN]).toBe('trees/Main2.json');
});
