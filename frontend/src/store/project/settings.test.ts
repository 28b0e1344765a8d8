import { expect, it } from 'vitest';
import { projectDetail } from '@/store/testing';
import { readSettings } from './settings';

const read = (settings: Record<string, unknown>) => readSettings({ ...projectDetail(1, []), settings });

it('keeps unknown settings', () => {
  const settings = {
    name: 'Mine',
    main_tree: 'Patrol',
    tick_hz: 50,
    license: 'MIT',
    maintainer: { name: 'A' },
  };
  expect(read(settings)).toEqual(settings);
});

it('leaves out a setting of a wrong type', () => {
  const wrong = {
    tick_hz: '20',
    universe: 7,
    robot: null,
    on_finish: 'never',
    on_error: 'failure',
    time: 'soon',
  };
  expect(read(wrong)).toEqual({ name: 'Test', main_tree: 'MainTree', on_error: 'failure' });
});

it('uses name and main tree of the project if the file has none', () => {
  expect(read({})).toEqual({ name: 'Test', main_tree: 'MainTree' });
});
