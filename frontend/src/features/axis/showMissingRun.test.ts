import { screen } from '@testing-library/react';
import { createElement } from 'react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { showMissingRun } from './showMissingRun';

it.each([
  [{ what: 'kept' } as const, /is not shared with you/],
  [{ what: 'session' } as const, /has ended/],
  [{ what: 'failed', reason: 'The server is asleep.' } as const, /The server is asleep/],
])('says why a run is not shown: %o', async (missing, text) => {
  show(createElement('main'));
  showMissingRun(missing);
  expect(await screen.findByText(text)).toBeInTheDocument();
});
