import { describe, expect, it } from 'vitest';
import { readForm } from './form';
import { evaluationNames, evaluationPath, firstEvaluation, isEvaluationName } from './files';

describe('files of evaluations', () => {
  it('are those of their folder alone', () => {
    const paths = [
      'evaluations/b.yaml',
      'evaluations/a.yaml',
      'evaluations/x/c.yaml',
      'evaluations/judge.py',
    ];
    expect(evaluationNames(paths)).toEqual(['a', 'b']);
    expect(evaluationPath('a')).toBe('evaluations/a.yaml');
  });

  it.each([
    ['room', true],
    ['room-2_b', true],
    ['', false],
    ['../room', false],
    ['a b', false],
  ])('may be named %s: %s', (name, isPossible) => {
    expect(isEvaluationName(name)).toBe(isPossible);
  });

  it('begin with one that the form shows as a whole', () => {
    const form = readForm(firstEvaluation('walled_room'));
    expect(form).toMatchObject({ runs: 20, duration_s: 20, neverCollision: true, otherItems: 0 });
    expect(form?.vary).toEqual([{ address: 'ground.friction', from: 0.6, to: 1 }]);
  });
});
