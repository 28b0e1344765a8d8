import { expect, it } from 'vitest';
import { parse } from 'yaml';
import { workflowOf } from './workflow';

const commands = (text: string): string[] => {
  const { jobs } = parse(text) as { jobs: { trees: { steps: { run?: string }[] } } };
  return jobs.trees.steps.flatMap(({ run }) => run ?? []);
};

it('checks, tests and evaluates what the project has', () => {
  const text = workflowOf({ hasTests: true, evaluations: ['hall', 'room'] });
  expect(commands(text).map((command) => command.split(' ').slice(1, 4).join(' '))).toEqual([
    '-C bt-studio setup',
    'check project',
    'test project --junit',
    'evaluate project hall',
    'evaluate project room',
  ]);
  expect(commands(text)[4]).toContain("--gate 'success>=0.95' --junit room.xml --report results/room");
  expect(text).toContain('            results/room\n');
});

it('only checks a project without tests and evaluations', () => {
  const text = workflowOf({ hasTests: false, evaluations: [] });
  expect(commands(text)).toHaveLength(2);
  expect(text).not.toContain('upload-artifact');
});
