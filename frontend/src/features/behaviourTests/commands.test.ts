import { afterEach, beforeEach, expect, it } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { useCoverage } from '@/store/behaviourTests/coverage';
import { fakeServer, openProject } from '../../../harness/testing';
import { useProjectStore } from '@/store/project';
import { registerTestCommands } from './commands';

let end = () => {};
beforeEach(() => {
  end = registerTestCommands();
});
afterEach(() => {
  end();
});

it('shows and hides the coverage by one key', () => {
  openProject({ trees: { Main: {} } });
  perform('tests.coverage');
  expect(useCoverage.getState().isShown).toBe(true);
  perform('tests.coverage');
  expect(useCoverage.getState().isShown).toBe(false);
});

it('runs the tests where there are some', () => {
  openProject({ trees: { Main: {} } });
  const isOffered = () => useCommandTable.getState().commands['tests.run']?.enabled?.();
  expect(isOffered()).toBe(false);
  useProjectStore.getState().addFile('tests/a.test.yaml', 'x');
  expect(isOffered()).toBe(true);
  fakeServer({});
  perform('tests.run');
});
