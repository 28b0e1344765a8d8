import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { DropOverlay } from './DropOverlay';

it('says what can be dropped', () => {
  show(<DropOverlay>Drop a robot</DropOverlay>);
  expect(screen.getByText('Drop a robot')).toBeInTheDocument();
});
