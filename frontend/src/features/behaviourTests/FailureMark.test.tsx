import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import type { FailureAt } from '@/store/behaviourTests/failures';
import { show, user, watchNavigation } from '../../../harness/testing';
import { FailureMark } from './FailureMark';

const at = (more: object = {}): FailureAt => ({
  test: 'turns',
  file: 'tests/a.test.yaml',
  failure: {
    ...{ message: 'no', line: 9, tick: 6, time_s: 0.25, node: 'Turn', tree: 'Main', node_id: 'a' },
    ...{ wanted: 'RUNNING', got: 'IDLE', path: [] },
    ...more,
  },
});

it('says what was wanted and got, and leads to the line of the test', async () => {
  const { openFile } = watchNavigation();
  show(<FailureMark failures={[at(), at()]} />);
  const mark = screen.getByRole('button', {
    name: '2 failures of tests here turns, tick 6: wanted RUNNING, got IDLE',
  });
  await user.click(mark);
  expect(openFile).toHaveBeenCalledExactlyOnceWith('tests/a.test.yaml', 9);
});

it('has the sentence where nothing was wanted', () => {
  show(<FailureMark failures={[at({ wanted: '', got: '', message: 'it raised' })]} />);
  expect(screen.getByRole('button', { name: 'A test failed here turns, tick 6: it raised' })).toBeVisible();
});

it('is absent without a failure', () => {
  show(<FailureMark failures={[]} />);
  expect(screen.queryByRole('button')).toBeNull();
});
