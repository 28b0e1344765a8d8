import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import { Picture3d } from './Picture3d';

it('is not there without WebGL', () => {
  show(<Picture3d label="Cart" near={0.1} stage={() => null} />);
  expect(screen.queryByRole('img', { name: 'Cart' })).toBeNull();
});
