import { fireEvent, screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { treeDifference } from '@/model/difference/changes';
import { show } from '../../../harness/testing';
import { ChangeList } from './ChangeList';

it('says what changed, and which block the pointer is at', () => {
  const before = { ...emptyDiagram('Main'), root: 'a', nodes: { a: { type: 'Go', ports: { speed: '1' } } } };
  const after = { ...before, nodes: { a: { type: 'Go', ports: { speed: '2' } } } };
  const onPoint = vi.fn();
  show(<ChangeList difference={treeDifference(before, after)} onPoint={onPoint} />);
  const row = screen.getByRole('listitem');
  expect(row).toHaveTextContent(/Go.*speed\s*1 → 2/);
  fireEvent.pointerEnter(row);
  fireEvent.pointerLeave(row);
  expect(onPoint.mock.calls).toEqual([['a'], [null]]);
});
