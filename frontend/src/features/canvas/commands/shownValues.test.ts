import { beforeEach, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useShownValues } from '@/store/session/values/shown';
import { openProject } from '../../../../harness/testing';
import { valuesCommand } from './shownValues';

const chosen = () => [...useShownValues.getState().ports];

beforeEach(() => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 'b'] },
        a: { type: 'Go', ports: { speed: '{v}', goal: '{=}', way: 'left' } },
        b: { type: 'Go' },
      },
    },
    selected: ['a'],
  });
  onTestFinished(() => useShownValues.setState({ ports: new Set() }));
});

it('shows the values of all keys of the block, and hides them again', () => {
  useShownValues.setState({ ports: new Set(['Main/a/speed']) });
  valuesCommand.run();
  expect(chosen()).toEqual(['Main/a/speed', 'Main/a/goal']);
  valuesCommand.run();
  expect(chosen()).toEqual([]);
});

it('needs a block with a key', () => {
  expect(valuesCommand.enabled?.()).toBe(true);
  useProjectStore.getState().select('Main', ['b']);
  expect(valuesCommand.enabled?.()).toBe(false);
});
