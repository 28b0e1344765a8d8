import { screen } from '@testing-library/react';
import type { NodeProps } from '@xyflow/react';
import { expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import type { BlockNode } from '../flow';
import { TinyBlock } from './TinyBlock';

it('is a place to press, with nothing in it', () => {
  const props = { id: 'a', data: { node: { type: 'Sleep' } } } as unknown as NodeProps<BlockNode>;
  show(<TinyBlock {...props} />);
  expect(screen.getByTestId('node-a')).toHaveAttribute('data-type', 'Sleep');
  expect(screen.getByTestId('node-a')).toBeEmptyDOMElement();
});
