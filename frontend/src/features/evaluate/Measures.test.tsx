import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { outcome, rowsOf } from '../../../harness/evaluations';
import { show } from '../../../harness/testing';
import { Measures } from './Measures';

it('plots each measure, with its range in words', () => {
  show(<Measures rows={rowsOf(outcome(1), outcome(2), outcome(4))} />);
  expect(screen.getByRole('img', { name: 'From 1 to 4, median 2' })).toBeInTheDocument();
  expect(screen.getByText('1 to 4, median 2 (3 runs)')).toBeInTheDocument();
});

it('shows nothing without measures', () => {
  show(<Measures rows={rowsOf(outcome(1, { measures: {} }))} />);
  expect(screen.queryByRole('region')).toBeNull();
});
