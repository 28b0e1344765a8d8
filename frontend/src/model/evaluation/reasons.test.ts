import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { reasonIn } from './reasons';

interface Row {
  readonly sentence: string;
  readonly key: string;
  readonly values: Readonly<Record<string, string>>;
}

const { sentences } = JSON.parse(readFileSync('../tests/shared/reasons.json', 'utf-8')) as {
  readonly sentences: readonly Row[];
};

it.each(sentences)('knows "$sentence"', ({ sentence, key, values }) => {
  expect(reasonIn(sentence)).toEqual({ key, values });
});

it('knows nothing else: the errors of actions stay as they are', () => {
  expect(reasonIn('actions/Go.py:3:1: ValueError: all items hold')).toBeNull();
  expect(reasonIn('')).toBeNull();
});

it('knows the sentence of old results that is no longer written', () => {
  expect(
    reasonIn(
      'launch/a.launch.py:1:1: a project with launch files cannot be evaluated: its nodes run in real time',
    ),
  ).toEqual({ key: 'launchFiles', values: { file: 'launch/a.launch.py' } });
});
