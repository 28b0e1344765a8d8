import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { hold, withTreeToHold } from '../../../harness/heldTree';
import { show } from '../../../harness/testing';
import { StopValues } from './StopValues';

withTreeToHold();

it('shows the ports and the status of the block at the stop', () => {
  hold('viewer');
  show(<StopValues tree="Main" node="a" />);
  expect(screen.getByTestId('stop-status')).toHaveTextContent(
    'The tree is held here, after its tick: it returned FAILURE, since a step ended.',
  );
  expect(screen.getByTestId('stop-msec')).toHaveTextContent('0.25 {v}');
  expect(screen.getByTestId('stop-x')).toHaveTextContent('1');
});
