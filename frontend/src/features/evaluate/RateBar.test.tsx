import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { evaluation } from '../../../harness/evaluations';
import { show } from '../../../harness/testing';
import { RateBar } from './RateBar';

const side = evaluation().sides[0]!;

it('shows the rate with its interval, and the time that is left', () => {
  show(<RateBar evaluation={evaluation()} side={side} />);
  expect(screen.getByTestId('evaluation-rate')).toHaveTextContent(
    '50 % worked in 1 of 2; could be as low as 10 % (95 % interval 10 % to 90 %)',
  );
  expect(screen.getByRole('status')).toHaveTextContent('2 of 4 runs · about 1 min 15 s left · 1 failure');
  const bar = screen.getByRole('progressbar');
  expect(bar).toHaveAttribute('aria-valuenow', '50');
  expect(bar).not.toHaveAttribute('data-animated');
});

it('counts the runs that say something of the project alone', () => {
  const counts = { success: 3, crashed: 1, invalid: 2, lost: 1 };
  show(<RateBar evaluation={evaluation()} side={{ ...side, done: 7, counts }} />);
  expect(screen.getByTestId('evaluation-rate')).toHaveTextContent('worked in 3 of 4;');
});

it('shows no rate without runs, and no progress at the end', () => {
  show(<RateBar evaluation={evaluation({ state: 'done' })} side={{ ...side, done: 0, counts: {} }} />);
  expect(screen.queryByTestId('evaluation-rate')).toBeNull();
  expect(screen.queryByRole('progressbar')).toBeNull();
});

it.each([
  ['hours', 'processor hours'],
  ['users', 'users who work go first'],
  ['turn', 'a free place'],
  ['cluster', 'Ray cluster'],
] as const)('says that it waits for %s', (waits_for, text) => {
  show(<RateBar evaluation={evaluation({ state: 'waiting', waits_for })} side={side} />);
  expect(screen.getByRole('status')).toHaveTextContent(text);
});
