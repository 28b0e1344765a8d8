import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { ResultBadge } from './ResultBadge';

it.each([
  ['success', 'Success'],
  ['failure', 'Failure'],
  ['error', 'Fault'],
  ['running', 'No result'],
] as const)('says %s in words, with a mark', (result, words) => {
  show(<ResultBadge result={result} />);
  expect(screen.getByText(words).closest('[data-result]')?.querySelector('svg')).not.toBeNull();
});
