import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import { BlockBadges } from './BlockBadges';

it('is absent for a block without conditions and comment', () => {
  show(<BlockBadges node={{ type: 'Sleep', conditions: {}, comment: '' }} />);
  expect(screen.queryByTitle(/./)).toBeNull();
  expect(document.querySelector('svg')).toBeNull();
});

it('shows the comment', () => {
  show(<BlockBadges node={{ type: 'Sleep', comment: 'Wait a bit.' }} />);
  expect(screen.getByTitle('Wait a bit.')).toBeInTheDocument();
  expect(document.querySelectorAll('svg')).toHaveLength(1);
});

it('shows the scripts, one on each line', () => {
  show(<BlockBadges node={{ type: 'Sleep', conditions: { _skipIf: 'x > 1', _post: 'y := 2' } }} />);
  expect(document.querySelector('[title]')).toHaveAttribute('title', '_skipIf: x > 1\n_post: y := 2');
  expect(document.querySelectorAll('svg')).toHaveLength(1);
});

it('shows what is silenced, with the reason', () => {
  show(<BlockBadges node={{ type: 'Sleep', silenced: { BT0119: 'it will fail later' } }} />);
  expect(screen.getByTestId('silenced')).toHaveAttribute('title', 'BT0119: it will fail later');
});
